#include "app/bench/pareto_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/cli/json_text.h"

namespace trisect::bench {
namespace {

std::string label_of(const Measurement& one) {
  return one.number.empty() ? one.family : one.family + ", " + one.number;
}

bool is_thesis(const Measurement& one) {
  return one.family.starts_with("thesis");
}

bool is_robust(const Measurement& one) {
  return one.family.starts_with("robust");
}

bool is_embree(const Measurement& one) {
  return one.family.starts_with("Embree");
}

// The fastest of the measurements that `of` accepts; null if there is none.
template <typename Of>
const Measurement* fastest(const Scene& scene, Of&& of) {
  const Measurement* best = nullptr;
  for (const Measurement& one : scene.measurements) {
    if (of(one) && (best == nullptr || one.ms.median < best->ms.median)) best = &one;
  }
  return best;
}

std::string joined(const std::vector<std::string>& texts) {
  return fmt::format("{}", fmt::join(texts, "; "));
}

}  // namespace

std::string name_of(const Scene& scene) {
  return scene.model + "-" + surface_name(scene.surface);
}

std::string csv_of(const std::vector<Scene>& scenes) {
  std::string text =
      "model,surface,patches,family,number,ms_median,ms_min,ms_max,rms,off_p50,off_p99,off_max,"
      "ulp_p50,ulp_p99,ulp_max,normal_p50,normal_p99,normal_max,wrong,missed,undecidable,nans,"
      "outline_mean,outline_max,color_rmse,psnr,evaluations,candidates,bytes_read,bytes,dominated_"
      "by\n";
  for (const Scene& scene : scenes) {
    for (const Measurement& m : scene.measurements) {
      const FrameErrors& e = m.errors;
      const std::string by =
          m.dominated_by ? label_of(scene.measurements[*m.dominated_by]) : std::string();
      text += fmt::format(
          "{},{},{},\"{}\",\"{}\",{:.3f},{:.3f},{:.3f},{:.4e},{:.4e},{:.4e},{:.4e},{:.3g},{:.3g},"
          "{:.3g},{:.3e},{:.3e},{:.3e},{},{},{},{},{:.4f},{:.3f},{:.5g},{:.4g},{},{},{},{},\"{}"
          "\"\n",
          scene.model, surface_name(scene.surface), scene.patches, m.family, m.number, m.ms.median,
          m.ms.min, m.ms.max, e.rms, e.off.p50, e.off.p99, e.off.max, e.depth_ulp.p50,
          e.depth_ulp.p99, e.depth_ulp.max, e.normal_degrees.p50, e.normal_degrees.p99,
          e.normal_degrees.max, e.wrong, e.missed, e.undecidable, e.nans, e.outline_mean,
          e.outline_max, e.color_rmse, e.psnr, m.work.evaluations, m.work.candidates,
          m.work.bytes_read, m.bytes, by);
    }
  }
  return text;
}

nlohmann::ordered_json json_of(const std::vector<Scene>& scenes) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const Scene& scene : scenes) {
    nlohmann::ordered_json of_scene{{"model", scene.model},
                                    {"surface", surface_name(scene.surface)},
                                    {"patches", scene.patches},
                                    {"measurements", nlohmann::ordered_json::array()}};
    for (const Measurement& m : scene.measurements) {
      const FrameErrors& e = m.errors;
      nlohmann::ordered_json one;
      one["family"] = m.family;
      one["number"] = m.number;
      one["ms"] = json_of(m.ms);
      one["rms"] = e.rms;
      one["off_surface"] = json_of(e.off);
      one["depth_ulp"] = json_of(e.depth_ulp);
      one["normal_degrees"] = json_of(e.normal_degrees);
      one["wrong_hits"] = e.wrong;
      one["missed"] = e.missed;
      one["undecidable"] = e.undecidable;
      one["nans"] = e.nans;
      one["outline"] = {{"mean", e.outline_mean}, {"max", e.outline_max}};
      one["color_rmse"] = e.color_rmse;
      // Infinite if nothing differs, which JSON does not know.
      if (std::isfinite(e.psnr)) one["psnr"] = e.psnr;
      one["evaluations"] = m.work.evaluations;
      one["candidates"] = m.work.candidates;
      one["bytes_read"] = m.work.bytes_read;
      one["bytes"] = m.bytes;
      one["on_front"] = !m.dominated_by.has_value();
      if (m.dominated_by) one["dominated_by"] = label_of(scene.measurements[*m.dominated_by]);
      of_scene["measurements"].push_back(one);
    }
    all.push_back(of_scene);
  }
  return all;
}

std::vector<std::string> findings_of(const Scene& scene) {
  std::vector<std::string> findings;
  const Measurement* robust = fastest(scene, is_robust);
  if (robust == nullptr) return findings;
  findings.push_back(fmt::format(
      "{}: {:.1f} ms at an error of {:.1e}, {} wrong or missed pixels; it is {} the Pareto front.",
      label_of(*robust), robust->ms.median, robust->errors.rms, wrong_pixels(*robust),
      robust->dominated_by
          ? "not on (" + label_of(scene.measurements[*robust->dominated_by]) + " is before it)"
          : "on"));
  std::vector<std::string> faster;
  for (const Measurement& one : scene.measurements) {
    if (is_thesis(one) && one.ms.median < robust->ms.median) faster.push_back(label_of(one));
  }
  findings.push_back(faster.empty() ? "No Rank of the thesis is faster, at any error."
                                    : "Faster, with larger errors, are " + joined(faster) + ".");
  const Measurement* thesis = fastest(
      scene, [](const Measurement& one) { return is_thesis(one) && one.number == "Rank 10"; });
  if (thesis != nullptr) {
    findings.push_back(fmt::format(
        "The thesis at Rank 10 takes {:.1f} times as long and has {} wrong or missed pixels.",
        thesis->ms.median / robust->ms.median, wrong_pixels(*thesis)));
  }
  // Missed pixels aside: an outline of flat triangles misses some however fine it is.
  const Measurement* fine = fastest(
      scene, [](const Measurement& one) { return is_embree(one) && one.errors.off.p99 <= 1e-5; });
  if (fine != nullptr) {
    findings.push_back(fmt::format(
        "Of Embree's, {} is the fastest that is off by at most 1e-5 at 99 of 100 pixels that it "
        "hits "
        "({:.1e}; {} wrong or missed): {:.1f} ms, {:.2f} times as long as {}, with {} times the "
        "memory.",
        label_of(*fine), fine->errors.off.p99, wrong_pixels(*fine), fine->ms.median,
        fine->ms.median / robust->ms.median, label_of(*robust),
        fine->bytes / std::max<std::size_t>(robust->bytes, 1)));
  } else {
    findings.emplace_back("None of Embree's is off by 1e-5 or less at 99 of 100 pixels.");
  }
  std::vector<std::string> coarse;
  for (const Measurement& one : scene.measurements) {
    if (one.dominated_by || is_robust(one) || one.ms.median >= robust->ms.median) continue;
    coarse.push_back(fmt::format("{}: {:.1f} times as fast at {:.1e}", label_of(one),
                                 robust->ms.median / one.ms.median, one.errors.rms));
  }
  if (!coarse.empty()) {
    findings.push_back("On the front before it, at larger errors: " + joined(coarse) + ".");
  }
  return findings;
}

report::Table table_of(const Scene& scene) {
  report::Table table{{{"contender", "ms", "least", "most", "error", "wrong", "missed", "off p50",
                        "off p99", "off max", "ulp p99", "normal p99", "outline", "RMSE", "PSNR",
                        "evaluations", "MB read", "KB", "front"}}};
  for (const Measurement& m : scene.measurements) {
    const FrameErrors& e = m.errors;
    table.rows.push_back(
        {label_of(m), fmt::format("{:.1f}", m.ms.median), fmt::format("{:.1f}", m.ms.min),
         fmt::format("{:.1f}", m.ms.max), fmt::format("{:.1e}", e.rms), fmt::to_string(e.wrong),
         fmt::to_string(e.missed), fmt::format("{:.1e}", e.off.p50),
         fmt::format("{:.1e}", e.off.p99), fmt::format("{:.1e}", e.off.max),
         fmt::format("{:.2g}", e.depth_ulp.p99), fmt::format("{:.2g}", e.normal_degrees.p99),
         fmt::format("{:.2f}", e.outline_mean), fmt::format("{:.2g}", e.color_rmse),
         fmt::format("{:.0f}", e.psnr),
         m.work.evaluations > 0 ? fmt::to_string(m.work.evaluations) : "",
         m.work.bytes_read > 0 ? fmt::to_string(m.work.bytes_read >> 20U) : "",
         fmt::to_string(m.bytes / 1024), m.dominated_by ? "" : "yes"});
  }
  return table;
}

std::string plot_script(const Scene& scene, const std::string& terminal, const std::string& file) {
  std::vector<std::string> families;
  for (const Measurement& one : scene.measurements) {
    if (std::find(families.begin(), families.end(), one.family) == families.end()) {
      families.push_back(one.family);
    }
  }
  std::string script = fmt::format("set terminal {}\nset output \"{}\"\n", terminal, file);
  // An error of nothing, and no wrong pixel, have a place on a logarithmic axis too.
  for (std::size_t k = 0; k < families.size(); ++k) {
    script += fmt::format("$family{} << EOD\n", k);
    for (const Measurement& one : scene.measurements) {
      if (one.family != families[k]) continue;
      script += fmt::format("{} {} {}\n", std::max(one.errors.rms, 1e-9), one.ms.median,
                            std::max(static_cast<double>(wrong_pixels(one)), 0.5));
    }
    script += "EOD\n";
  }
  std::vector<const Measurement*> front;
  for (const Measurement& one : scene.measurements) {
    if (!one.dominated_by) front.push_back(&one);
  }
  std::sort(front.begin(), front.end(), [](const Measurement* a, const Measurement* b) {
    return a->errors.rms < b->errors.rms;
  });
  script += "$front << EOD\n";
  for (const Measurement* one : front) {
    script += fmt::format("{} {}\n", std::max(one->errors.rms, 1e-9), one->ms.median);
  }
  script += "EOD\n";
  script += fmt::format(
      "set multiplot layout 1,2 title \"{}, {} patches, {}\"\n"
      "set logscale xy\nset grid\nset format x \"10^{{%L}}\"\n"
      "set ylabel \"milliseconds a frame\"\n"
      "set key outside bottom center horizontal maxcols 2\n"
      "set xlabel \"error: RMS distance off the surface / radius, a wrong pixel counts 1\"\n",
      scene.model, scene.patches, surface_name(scene.surface));
  const auto curves = [&](const char* columns) {
    std::vector<std::string> parts;
    for (std::size_t k = 0; k < families.size(); ++k) {
      parts.push_back(
          fmt::format("$family{0} using {1} with linespoints pt {2} lc {2} title \"{3}\"", k,
                      columns, k + 1, families[k]));
    }
    return fmt::format("{}", fmt::join(parts, ", "));
  };
  script += "plot " + curves("1:2") +
            ", $front using 1:2 with steps lw 2 lc rgb \"black\" title \"Pareto front\"\n";
  script +=
      "set xlabel \"wrong or missed pixels (none: drawn at 0.5)\"\nset format x \"%g\"\n"
      "plot " +
      curves("3:2") + "\nunset multiplot\n";
  return script;
}

}  // namespace trisect::bench
