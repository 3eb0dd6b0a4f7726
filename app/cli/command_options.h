// Options that several commands have, and what their values may be.
#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <optional>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

#include "app/surface/shared.h"

namespace trisect {

// Accepts a number from low to high, a whole one if Number is int, and no NaN.
template <typename Number>
CLI::Validator number_from_to(Number low, Number high) {
  return CLI::Validator(
      [low, high](const std::string& text) -> std::string {
        Number value{};
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        const bool parsed = error == std::errc() && end == text.data() + text.size();
        if (parsed && value >= low && value <= high) return {};
        return fmt::format("'{}' is not a {}number from {} to {}", text,
                           std::is_integral_v<Number> ? "whole " : "", low, high);
      },
      "");
}

CLI::Validator not_empty();

CLI::Validator one_of(const std::vector<std::string>& names);

// What the names of the command line stand for.
uint surface_of(const std::string& name);
uint shell_of(const std::string& name);

// MODEL ...
void add_models(CLI::App& command, std::vector<std::string>& models);

// --size, of which help says that `standard` is the default.
void add_size(CLI::App& command, std::optional<std::string>& size, const std::string& standard);

// --surface, of commands that take both of the curved ones without it.
void add_surfaces(CLI::App& command, std::optional<std::string>& surface);

// --device.
void add_device(CLI::App& command, std::string& device);

// --json, of commands that print a table.
void add_table_json(CLI::App& command, std::string& json);

}  // namespace trisect
