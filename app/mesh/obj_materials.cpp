#include "app/mesh/obj_materials.h"

#include <fmt/format.h>

#include <optional>
#include <string_view>

#include "app/base/error.h"
#include "app/base/number_text.h"
#include "app/mesh/file_bytes.h"
#include "app/mesh/obj_text.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

// tinyobjloader takes a material without Kd for a black one: so read here what there is of them.
void read_materials(std::string_view file_text, std::map<std::string, glm::vec3>& colors) {
  std::string converted;
  std::string material;
  std::set<std::string> textured;
  for (Lines lines(plain_text(file_text, converted)); lines.next();) {
    std::string_view words = lines.words();
    if (lines.key() == "newmtl") {
      material = name_in(words);
    } else if (lines.key() == "map_Kd") {
      textured.insert(material);
    } else if (lines.key() == "Kd" && !material.empty()) {
      const std::optional<float> red = parse_number<float>(take_word(words));
      if (!red) continue;
      // The others are the same if they are left out.
      const float green = parse_number<float>(take_word(words)).value_or(*red);
      colors[material] = {*red, green, parse_number<float>(take_word(words)).value_or(*red)};
    }
  }
  for (const std::string& name : textured) colors.erase(name);
}

// A file by this name, and whether it is outside the folder.
struct Found {
  std::optional<fs::path> file;
  bool is_outside = false;
};

Found found(const fs::path& folder, const std::string& name) {
  const auto file = file_below(folder, name);
  std::error_code unused;
  if (!file) return {std::nullopt, !name.empty()};
  return {fs::is_regular_file(*file, unused) ? file : std::nullopt};
}

}  // namespace

std::map<std::string, glm::vec3> material_colors(const std::set<std::string>& libraries,
                                                 const fs::path& folder, PolygonModel& model) {
  std::map<std::string, glm::vec3> colors;
  std::size_t outside = 0;
  std::size_t absent = 0;
  const auto read = [&](const Found& library) {
    if (!library.file) {
      ++(library.is_outside ? outside : absent);
      return;
    }
    try {
      read_materials(read_bytes(*library.file), colors);
      model.files.push_back(*library.file);
    } catch (const InputError&) {
      ++absent;
    }
  };
  for (const std::string& line : libraries) {
    const Found whole = found(folder, line);
    std::string_view words = line;
    const std::string first(take_word(words));
    if (whole.file || first == line) {
      read(whole);
      continue;
    }
    words = line;
    for (auto word = take_word(words); !word.empty(); word = take_word(words)) {
      read(found(folder, std::string(word)));
    }
  }
  const auto note = [&](std::size_t count, const char* what) {
    if (count == 0) return;
    model.notes.push_back(
        fmt::format("{} material {} {}", count, count == 1 ? "file" : "files", what));
  };
  note(outside, "outside the model's folder not read");
  note(absent, "not found, or not readable");
  return colors;
}

}  // namespace trisect
