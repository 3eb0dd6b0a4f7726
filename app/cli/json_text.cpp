#include "app/cli/json_text.h"

#include <nlohmann/json.hpp>

namespace trisect {

std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

nlohmann::ordered_json json_of(const Quantiles& quantiles) {
  return {{"p50", quantiles.p50}, {"p99", quantiles.p99}, {"max", quantiles.max}};
}

}  // namespace trisect
