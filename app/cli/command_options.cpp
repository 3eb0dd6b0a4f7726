#include "app/cli/command_options.h"

#include <algorithm>

#include "app/base/message.h"
#include "app/cli/option_groups.h"
#include "app/cli/suggestions.h"

namespace trisect {

CLI::Validator not_empty() {
  return CLI::Validator(
      [](const std::string& text) -> std::string { return text.empty() ? "is empty" : ""; }, "");
}

std::string fault_of(const CLI::App& app, const CLI::ParseError& error) {
  const std::vector<std::string> words = app.remaining(true);
  const bool is_of_words = dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr ||
                           dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
  // Words that are not known may be what is missing, misspelt.
  if (!is_of_words || words.empty()) return reason_of(error.what());
  return fmt::format("The following argument{} not expected: {}",
                     words.size() == 1 ? " was" : "s were", fmt::join(words, " "));
}

CLI::Validator one_of(const std::vector<std::string>& names) {
  return suggesting(CLI::Validator(
                        [names](const std::string& text) -> std::string {
                          if (std::find(names.begin(), names.end(), text) != names.end()) return {};
                          return fmt::format("'{}' is not one of: {}", text,
                                             fmt::join(names, ", "));
                        },
                        ""),
                    names);
}

uint surface_of(const std::string& name) {
  return name == "flat" ? SURFACE_FLAT : name == "phong" ? SURFACE_PHONG : SURFACE_SPHERE;
}

uint shell_of(const std::string& name) {
  return name == "height" ? SHELL_HEIGHT : SHELL_NORMAL;
}

void add_models(CLI::App& command, std::vector<std::string>& models) {
  command.add_option("MODEL", models, "OBJ, glTF, PLY, STL or FBX files")
      ->group(option_group::kModel)
      ->required()
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->check(not_empty())
      ->check(suggest_models());
}

void add_size(CLI::App& command, std::optional<std::string>& size, const std::string& standard) {
  command.add_option("--size", size, "Image size in pixels, default " + standard)
      ->group(option_group::kPicture)
      ->type_name("WxH");
}

void add_surface(CLI::App& command, uint& surface) {
  command
      .add_option_function<std::string>(
          "--surface", [&surface](const std::string& name) { surface = surface_of(name); },
          "How triangles are curved: flat, phong or sphere, default phong")
      ->group(option_group::kSurface)
      ->check(one_of({"flat", "phong", "sphere"}))
      ->type_name("NAME");
}

void add_surfaces(CLI::App& command, std::optional<std::string>& surface) {
  command
      .add_option("--surface", surface,
                  "How triangles are curved: flat, phong or sphere, default phong and sphere")
      ->group(option_group::kSurface)
      ->check(one_of({"flat", "phong", "sphere"}))
      ->type_name("NAME");
}

void add_alpha(CLI::App& command, double& alpha) {
  command
      .add_option("--alpha", alpha,
                  "phong: from 0 (flat) to 1 (full projection) and beyond, default 0.65")
      ->group(option_group::kSurface)
      ->check(number_from_to(-1000.0, 1000.0))
      ->type_name("A");
}

void add_device(CLI::App& command, std::string& device) {
  command
      .add_option("--device", device,
                  "Vulkan device: its number in `trisect devices` or a part of its name")
      ->group(option_group::kTracing)
      ->check(not_empty())
      ->type_name("D");
}

void add_table_json(CLI::App& command, std::string& json) {
  add_json(command, json, "Write the table as JSON");
}

void add_json(CLI::App& command, std::string& json, const std::string& what) {
  command.add_option("--json", json, what)
      ->group(option_group::kOutput)
      ->check(not_empty())
      ->check(suggest_files({".json"}))
      ->type_name("FILE");
}

void add_validation(CLI::App& command, bool& validation) {
  command
      .add_flag("--validation", validation,
                "Run under the Vulkan validation layer, fail on any message")
      ->group(option_group::kTracing);
}

}  // namespace trisect
