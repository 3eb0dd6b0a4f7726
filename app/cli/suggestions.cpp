#include "app/cli/suggestions.h"

#include <fmt/format.h>

#include <sstream>

namespace trisect {
namespace {

// The name of a validator, which CLI11 shows nowhere, holds the kind and the words, a space between
// each.
constexpr const char* kNames = "names";
constexpr const char* kFiles = "files";
constexpr const char* kFolders = "folders";

CLI::Validator accepting(const char* kind, const std::vector<std::string>& words) {
  return CLI::Validator([](const std::string&) -> std::string { return {}; }, "")
      .name(fmt::format("{} {}", kind, fmt::join(words, " ")));
}

}  // namespace

CLI::Validator suggest_names(const std::vector<std::string>& names) {
  return accepting(kNames, names);
}

CLI::Validator suggest_files(const std::vector<std::string>& endings) {
  return accepting(kFiles, endings);
}

CLI::Validator suggest_models() {
  return suggest_files({".obj", ".gltf", ".glb", ".ply", ".stl", ".fbx", ".obj.gz", ".gltf.gz",
                        ".glb.gz", ".ply.gz", ".stl.gz", ".fbx.gz"});
}

CLI::Validator suggest_images() {
  return suggest_files({".png", ".exr"});
}

CLI::Validator suggest_folders() {
  return accepting(kFolders, {});
}

CLI::Validator suggesting(CLI::Validator check, const std::vector<std::string>& names) {
  check.name(fmt::format("{} {}", kNames, fmt::join(names, " ")));
  return check;
}

Suggestions suggestions_of(const CLI::Option& option) {
  // get_validator() changes nothing, but has no const twin; it throws after the last one.
  auto& validators = const_cast<CLI::Option&>(option);
  try {
    for (int i = 0;; ++i) {
      std::istringstream text(validators.get_validator(i)->get_name());
      std::string word;
      text >> word;
      Suggestions found;
      if (word == kNames) found.kind = Suggestions::Kind::names;
      if (word == kFiles) found.kind = Suggestions::Kind::files;
      if (word == kFolders) found.kind = Suggestions::Kind::folders;
      if (found.kind == Suggestions::Kind::nothing) continue;
      while (text >> word) found.words.push_back(word);
      return found;
    }
  } catch (const CLI::OptionNotFound&) {
    return {};
  }
}

}  // namespace trisect
