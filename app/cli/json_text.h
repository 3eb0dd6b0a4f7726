// JSON as the text of a file.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "app/base/quantiles.h"

namespace trisect {

// Indented, with a newline at the end; bytes that are not UTF-8, of a file's name, are replaced.
std::string json_text(const nlohmann::ordered_json& json);

// Its members under their names.
nlohmann::ordered_json json_of(const Quantiles& quantiles);

}  // namespace trisect
