#include <fmt/format.h>

#include <vector>

#include "app/base/error.h"
#include "app/cli/commands.h"
#include "vk/instance.h"

namespace trisect {

int list_devices() {
  const gpu::Instance instance(false);
  const std::vector<gpu::DeviceReport> reports = instance.reports();
  if (reports.empty()) gpu::choose_device(reports, "");  // throws: there is no device
  bool any_usable = false;
  for (std::size_t i = 0; i < reports.size(); ++i) {
    const gpu::DeviceReport& report = reports[i];
    any_usable = any_usable || report.usable();
    fmt::print("{}  {} ({}), Vulkan {}, driver {}: {}\n", i, report.name, report.type, report.api,
               report.driver,
               report.usable() ? "usable" : fmt::format("lacks {}", fmt::join(report.lacks, ", ")));
  }
  return any_usable ? exit_done : exit_no_device;
}

}  // namespace trisect
