// Options that several commands share, and checks of their values.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "app/base/number_text.h"
#include "app/surface/shared.h"

namespace trisect {

// Accepts a number from low to high, a whole one if Number is int, and no NaN.
template <typename Number>
CLI::Validator number_from_to(Number low, Number high) {
  return CLI::Validator(
      [low, high](const std::string& text) -> std::string {
        const std::optional<Number> value = parse_number<Number>(text);
        if (value && *value >= low && *value <= high) return {};
        return fmt::format("'{}' is not a {}number from {} to {}", text,
                           std::is_integral_v<Number> ? "whole " : "", low, high);
      },
      "");
}

CLI::Validator not_empty();

// What is wrong with words that an app could not parse, which it threw. CLI11 names the words that
// it does not know from the last to the first; here they are in the order in which they were given.
std::string fault_of(const CLI::App& app, const CLI::ParseError& error);

// Accepts these names only, and has shells offer them.
CLI::Validator one_of(const std::vector<std::string>& names);

// The constants for the names of --surface and --shell, which one_of() has checked.
uint surface_of(const std::string& name);
uint shell_of(const std::string& name);

// Adds MODEL ..., one or more files.
void add_models(CLI::App& command, std::vector<std::string>& models);

// Adds --size. Its help names `standard` as the default.
void add_size(CLI::App& command, std::optional<std::string>& size, const std::string& standard);

// Adds --surface; what it says goes into `surface`.
void add_surface(CLI::App& command, uint& surface);

// Adds --surface to a command whose default is both curved surfaces.
void add_surfaces(CLI::App& command, std::optional<std::string>& surface);

// Adds --alpha.
void add_alpha(CLI::App& command, double& alpha);

// Adds --device.
void add_device(CLI::App& command, std::string& device);

// Adds --json to a command that prints a table.
void add_table_json(CLI::App& command, std::string& json);

// Adds --json. what: its help.
void add_json(CLI::App& command, std::string& json, const std::string& what);

// Adds --validation.
void add_validation(CLI::App& command, bool& validation);

}  // namespace trisect
