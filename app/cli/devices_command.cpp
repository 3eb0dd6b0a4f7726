#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "app/base/error.h"
#include "app/cli/commands.h"
#include "app/cli/floats_report.h"
#include "app/cli/interrupt.h"
#include "app/cli/json_text.h"
#include "app/cli/output.h"
#include "vk/instance.h"

namespace trisect {
namespace {

nlohmann::ordered_json json_of(std::size_t number, const gpu::DeviceReport& report,
                               const gpu::Capabilities& device) {
  const gpu::SubgroupSupport& subgroups = device.subgroups;
  const gpu::FloatControls& floats = device.floats;
  return {{"number", number},
          {"device", report.name},
          {"driver", report.driver},
          {"type", report.type},
          {"vulkan", report.api},
          {"usable", report.usable()},
          {"lacks", report.lacks},
          {"subgroups",
           {{"size", subgroups.size}, {"sizes", subgroups.sizes()}, {"full", subgroups.full}}},
          {"float_controls",
           {{"rounding_mode_rte", floats.rounds_to_nearest_even},
            {"signed_zero_inf_nan_preserve", floats.preserves_signed_zero_inf_nan},
            {"denorm_preserve", floats.preserves_denormals}}},
          {"buffer_addresses", device.buffer_addresses},
          {"ray_queries", device.ray_queries},
          {"maximal_reconvergence", device.lists("VK_KHR_shader_maximal_reconvergence")}};
}

std::string yes_or_no(bool is_so) {
  return is_so ? "yes" : "no";
}

// Measures a device and prints the table.
FloatReport measure(const gpu::Instance& instance, std::size_t number) {
  const gpu::Device device(instance, std::to_string(number));
  const FloatReport report = measure_floats(device);
  const gpu::Capabilities& capabilities = device.capabilities();
  const gpu::FloatControls& floats = capabilities.floats;
  const std::vector<uint32_t> sizes = capabilities.subgroups.sizes();
  say("\nSubgroups: {} invocations; kernels can ask for {}.\n", device.subgroup_size(),
      sizes.empty() ? "no size" : fmt::format("{}", fmt::join(sizes, ", ")));
  say("Kernels can declare RoundingModeRTE: {}, SignedZeroInfNanPreserve: {}, ",
      yes_or_no(floats.rounds_to_nearest_even), yes_or_no(floats.preserves_signed_zero_inf_nan));
  say("DenormPreserve: {}.\n", yes_or_no(floats.preserves_denormals));
  say("The largest errors and shares of {} inputs; \"if declared\": by one of these.\n\n{}",
      report.items, float_columns().markdown_header());
  for (const FloatRow& row : float_rows(report)) {
    say("{}", float_columns().markdown_row(row));
  }
  say("\n");
  return report;
}

}  // namespace

int list_devices(const DevicesOptions& options) {
  begin_outputs({}, {options.json});
  const gpu::Instance instance(false);
  const std::vector<gpu::DeviceReport> reports = instance.reports();
  std::optional<std::size_t> chosen;
  if (reports.empty() || !options.device.empty()) {
    chosen = gpu::choose_device(reports, options.device);  // throws if there is none
  }
  OptionalOutput file(options.json);
  nlohmann::ordered_json json{{"program", "trisect"}, {"version", TRISECT_VERSION}};
  json["devices"] = nlohmann::ordered_json::array();
  bool any_usable = false;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    if (chosen && *chosen != i) continue;
    const gpu::DeviceReport& report = reports[i];
    any_usable = any_usable || report.usable();
    say("{}  {} ({}), Vulkan {}, driver {}: {}\n", i, report.name, report.type, report.api,
        report.driver,
        report.usable() ? "usable" : fmt::format("lacks {}", fmt::join(report.lacks, ", ")));
    json["devices"].push_back(json_of(i, report, instance.devices()[i]));
    if (options.floats && report.usable()) {
      json["devices"].back()["floats"] = float_figures(measure(instance, i));
      stop_if_interrupted();
    }
  }
  file.write(json_text(json));
  file.commit();
  return any_usable ? exit_done : exit_no_device;
}

}  // namespace trisect
