#include "app/json_text.h"

#include <nlohmann/json.hpp>

namespace trisect {

std::string json_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

}  // namespace trisect
