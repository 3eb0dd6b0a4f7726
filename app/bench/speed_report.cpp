#include "app/bench/speed_report.h"

#include "app/mesh/obj_file.h"
#include "app/surface/surface_choice.h"

namespace trisect::bench {

// A column stands twice where the outputs have it in different places or show different values.
const report::Columns<SpeedRow>& speed_columns() {
  using report::value_or_null;
  // clang-format off
  static const report::Columns<SpeedRow> columns{
      {{}, "model", {}, [](auto& r) { return r.model; }},
      {{}, "", {"model", "{}"}, [](auto& r) { return model_name(r.model); }},
      {{}, "surface", {"surface", "{}"}, [](auto& r) { return surface_name(r.surface); }},
      {{}, "patches", {}, [](auto& r) { return r.patches; }},
      {{}, "contender", {"contender", "{}"}, [](auto& r) { return r.contender; }},
      {{}, "ms.min", {}, [](auto& r) { return r.ms.min; }},
      {{}, "ms.median", {"ms", "{:.1f}"}, [](auto& r) { return r.ms.median; }},
      {{}, "", {"least", "{:.1f}"}, [](auto& r) { return r.ms.min; }},
      {{}, "ms.max", {"most", "{:.1f}"}, [](auto& r) { return r.ms.max; }},
      {{}, "cpu_ms.min", {}, [](auto& r) { return r.cpu_ms.min; }},
      {{}, "cpu_ms.median", {"CPU ms", "{:.1f}"}, [](auto& r) { return r.cpu_ms.median; }},
      {{}, "cpu_ms.max", {}, [](auto& r) { return r.cpu_ms.max; }},
      {{}, "", {"of the thesis", "{:.3f}"}, [](auto& r) { return r.ms.median / r.thesis_ms; }},
      {{}, "", {"of the image", "{:.1f}"}, [](auto& r) { return r.ms.median / r.floor_ms; }},
      {{}, "", {"wrong", "{}"}, [](auto& r) { return value_or_null(r.wrong_pixels); }},
      {{}, "checked_pixels", {"of", "{}"}, [](auto& r) { return value_or_null(r.checked_pixels); }},
      {{}, "wrong_pixels", {}, [](auto& r) { return value_or_null(r.wrong_pixels); }},
      {{}, "bytes", {}, [](auto& r) { return r.bytes; }},
      {{}, "", {"KB", "{}"}, [](auto& r) { return r.bytes / 1024; }},
      {{}, "build_ms", {"build ms", "{:.0f}"}, [](auto& r) { return value_or_null(r.build_ms); }},
      {{}, "flat_triangles", {}, [](auto& r) { return value_or_null(r.flat_triangles); }},
      {{}, "flat_error", {}, [](auto& r) { return value_or_null(r.flat_error); }},
  };
  // clang-format on
  return columns;
}

}  // namespace trisect::bench
