#include "app/mesh/obj_file.h"

#include <fmt/format.h>
#include <tiny_obj_loader.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <streambuf>
#include <system_error>
#include <utility>

#include "app/base/error.h"
#include "app/base/folder_of.h"
#include "app/base/message.h"
#include "app/base/number_text.h"
#include "app/mesh/file_bytes.h"
#include "app/mesh/obj_materials.h"
#include "app/mesh/obj_text.h"

namespace trisect {
namespace {

// What is left out of a file, or read otherwise than written.
struct Counts {
  std::size_t points = 0;
  std::size_t lines = 0;
  std::size_t curves = 0;
  std::size_t surfaces = 0;
  std::size_t small_faces = 0;   // of one or two corners
  std::size_t weights = 0;       // fourth coordinates other than 1
  std::size_t lost_normals = 0;  // corners that name a normal, in a file that has none
};

// A file as tinyobjloader is to see it: "v", "vn" and "f" alone, one line each.
struct OrderedText {
  std::string text;
  std::vector<std::size_t> line_of;        // the number in the file of each line
  std::vector<uint32_t> smoothing_groups;  // of each face
  std::vector<PolygonGroup> objects;       // "o"
  std::vector<PolygonGroup> groups;        // "g"
  std::vector<PolygonGroup> materials;     // "usemtl"
  std::set<std::string> libraries;         // "mtllib"
  bool has_groups = false;
  Counts counts;
};

// The finite number that a word is; what is too small for double precision is 0.
std::optional<double> number_of(std::string_view word) {
  if (word.starts_with('+')) {
    word.remove_prefix(1);
    if (word.starts_with('-')) return std::nullopt;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || word.empty()) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    value = std::strtod(std::string(word).c_str(), nullptr);
  }
  if (error != std::errc() && error != std::errc::result_out_of_range) return std::nullopt;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<int> whole_number(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  return parse_number<int>(word);
}

// A corner of a face as the file writes it: v, v/vt, v//vn or v/vt/vn, where what follows v may be
// left out or 0.
struct WrittenCorner {
  int vertex;
  int normal;  // 0 without one
};

std::optional<WrittenCorner> corner_of(std::string_view word) {
  std::array<int, 3> index{};
  for (std::size_t field = 0; field < index.size(); ++field) {
    const std::string_view text = word.substr(0, word.find('/'));
    if (!text.empty()) {
      const auto number = whole_number(text);
      if (!number) return std::nullopt;
      index[field] = *number;
    }
    if (text.size() == word.size()) {
      if (index[0] == 0) return std::nullopt;
      return WrittenCorner{index[0], index[2]};
    }
    word.remove_prefix(text.size() + 1);
  }
  return std::nullopt;
}

// Throws for what tinyobjloader would accept in silence: it reads a number that it cannot parse as
// 0 and skips a face without corners.
OrderedText ordered(std::string_view text, const std::string& name) {
  OrderedText out;
  Counts& counts = out.counts;
  // Before the first "s" everything is smooth, as without any.
  uint32_t group = 1;
  Lines lines(text);
  const auto fail = [&](const std::string& what) {
    throw InputError(fmt::format("{}, line {}: {}.", name, lines.number(), what));
  };
  const auto begin_line = [&](std::string_view key) {
    out.text += key;
    out.line_of.push_back(lines.number());
  };
  while (lines.next()) {
    const std::string_view key = lines.key();
    std::string_view words = lines.words();
    if (key == "v" || key == "vn") {
      begin_line(key);
      for (int i = 0; i < 3; ++i) {
        const std::string_view word = take_word(words);
        if (word.empty()) fail(fmt::format("'{}' has fewer than three coordinates", key));
        if (!number_of(word)) fail(fmt::format("'{}' is not a finite number", word));
        out.text.append(" ").append(word);
      }
      out.text += '\n';
      // More than four are coordinates and a colour.
      const std::string_view weight = take_word(words);
      if (key == "v" && !weight.empty() && take_word(words).empty() && number_of(weight) != 1.0) {
        ++counts.weights;
      }
    } else if (key == "f" || key == "fo") {
      std::vector<WrittenCorner> corners;
      for (auto word = take_word(words); !word.empty(); word = take_word(words)) {
        const auto corner = corner_of(word);
        if (!corner) fail(fmt::format("'{}' is not a corner of a face", word));
        corners.push_back(*corner);
      }
      if (corners.size() < 3) {
        ++counts.small_faces;
        continue;
      }
      begin_line("f");
      for (const WrittenCorner& corner : corners) {
        fmt::format_to(std::back_inserter(out.text), " {}//{}", corner.vertex, corner.normal);
      }
      out.text += '\n';
      out.smoothing_groups.push_back(group);
    } else if (key == "s") {
      out.has_groups = true;
      const std::string_view word = take_word(words);
      const auto number = whole_number(word);
      if (word != "off" && word != "on" && (!number || *number < 0)) {
        fail(fmt::format("'{}' is not a smoothing group", word));
      }
      group = word == "off" ? 0 : word == "on" ? 1 : static_cast<uint32_t>(*number);
    } else if (key == "o" || key == "g") {
      add_group(name_in(words), out.smoothing_groups.size(), key == "o" ? out.objects : out.groups);
    } else if (key == "usemtl") {
      add_group(name_in(words), out.smoothing_groups.size(), out.materials);
    } else if (key == "mtllib") {
      out.libraries.insert(name_in(words));
    } else {
      counts.points += key == "p" ? 1 : 0;
      counts.lines += key == "l" ? 1 : 0;
      counts.curves += key == "curv" || key == "curv2" ? 1 : 0;
      counts.surfaces += key == "surf" ? 1 : 0;
    }
  }
  return out;
}

// A text in memory as a stream that counts the lines that have been read from it.
class CountingBuffer : public std::streambuf {
 public:
  explicit CountingBuffer(std::string_view text) : text_(text) {}

  [[nodiscard]] std::size_t lines_read() const { return lines_; }

 protected:
  int_type underflow() override {
    return at_ < text_.size() ? traits_type::to_int_type(text_[at_]) : traits_type::eof();
  }
  int_type uflow() override {
    if (at_ >= text_.size()) return traits_type::eof();
    const char c = text_[at_++];
    if (c == '\n') ++lines_;
    return traits_type::to_int_type(c);
  }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t lines_ = 0;
};

// The target of the parser's callbacks.
class Reader {
 public:
  Reader(const CountingBuffer& source, const std::vector<std::size_t>& line_of,
         const std::string& name)
      : source_(source), line_of_(line_of), name_(name) {}

  void add_position(double x, double y, double z) { model_.positions.emplace_back(x, y, z); }
  void add_normal(double x, double y, double z) { model_.normals.emplace_back(x, y, z); }

  void add_face(const tinyobj::index_t* indices, int count) {
    lines_.push_back(line_of_[source_.lines_read() - 1]);
    for (int i = 0; i < count; ++i) {
      const tinyobj::index_t& index = indices[i];
      model_.corners.push_back(
          {zero_based(index.vertex_index, model_.positions.size(), "vertex"),
           index.normal_index == 0
               ? PolygonCorner::no_normal
               : zero_based(index.normal_index, model_.normals.size(), "normal")});
    }
    model_.sizes.push_back(static_cast<uint32_t>(count));
  }

  // What was read. Faces may name what came after them, so only now it is known what they name.
  // lost_normals: counts corners whose normals do not exist, in a file without any.
  PolygonModel finish(std::size_t& lost_normals) {
    const bool has_normals = !model_.normals.empty();
    std::size_t first = 0;
    for (std::size_t face = 0; face < model_.sizes.size(); ++face) {
      for (std::size_t i = first; i < first + model_.sizes[face]; ++i) {
        PolygonCorner& corner = model_.corners[i];
        check(corner.position, model_.positions.size(), "vertex", lines_[face]);
        if (corner.normal == PolygonCorner::no_normal) continue;
        if (has_normals) {
          check(corner.normal, model_.normals.size(), "normal", lines_[face]);
        } else {
          corner.normal = PolygonCorner::no_normal;
          ++lost_normals;
        }
      }
      first += model_.sizes[face];
    }
    return std::move(model_);
  }

 private:
  // Turns an OBJ index, 1-based or negative and counted from the end so far, into a zero-based one.
  [[nodiscard]] uint32_t zero_based(int index, std::size_t count, const char* what) const {
    const long long result = index > 0 ? index - 1LL : static_cast<long long>(count) + index;
    if (result < 0) {
      throw InputError(fmt::format("{}, line {}: the face names {} {}, but there are {} so far.",
                                   name_, lines_.back(), what, index, count));
    }
    return static_cast<uint32_t>(result);
  }

  void check(uint32_t index, std::size_t count, const char* what, std::size_t line) const {
    if (index < count) return;
    throw InputError(fmt::format("{}, line {}: the face names {} {}, but there are {}.", name_,
                                 line, what, index + 1, count));
  }

  const CountingBuffer& source_;
  const std::vector<std::size_t>& line_of_;
  const std::string& name_;
  PolygonModel model_;
  std::vector<std::size_t> lines_;  // of the faces
};

std::vector<std::string> notes_of(const Counts& counts) {
  std::vector<std::string> notes;
  const auto note = [&](std::size_t count, const char* one, const char* many, const char* what) {
    if (count > 0) notes.push_back(fmt::format("{} {} {}", count, count == 1 ? one : many, what));
  };
  note(counts.points, "point element", "point elements", "left out");
  note(counts.lines, "line element", "line elements", "left out");
  note(counts.curves, "curve", "curves", "left out");
  note(counts.surfaces, "free-form surface", "free-form surfaces", "left out");
  note(counts.small_faces, "face", "faces", "of one or two corners left out");
  note(counts.weights, "vertex", "vertices", "with a weight, which does not count");
  note(counts.lost_normals, "corner names", "corners name", "a normal in a file that has none");
  return notes;
}

// Gives polygons the colours of their materials.
void add_material_colors(const OrderedText& text, const std::filesystem::path& folder,
                         PolygonModel& model) {
  const std::map<std::string, glm::vec3> colors = material_colors(text.libraries, folder, model);
  if (colors.empty()) return;
  model.colors.assign(model.sizes.size(), PolygonModel::no_color);
  for (std::size_t i = 0; i < text.materials.size(); ++i) {
    const std::size_t end =
        i + 1 < text.materials.size() ? text.materials[i + 1].first : model.sizes.size();
    const auto found = colors.find(text.materials[i].name);
    if (found == colors.end()) continue;
    std::fill(model.colors.begin() + static_cast<std::ptrdiff_t>(text.materials[i].first),
              model.colors.begin() + static_cast<std::ptrdiff_t>(end),
              polygon_color(found->second));
  }
}

}  // namespace

PolygonModel parse_obj(std::string_view file_text, const std::string& name,
                       const std::filesystem::path& folder) {
  std::string converted;
  file_text = plain_text(file_text, converted);
  OrderedText text = ordered(file_text, name);

  CountingBuffer buffer(text.text);
  std::istream stream(&buffer);
  // The callbacks may throw through the parser: it holds nothing that an exception would leak.
  Reader reader(buffer, text.line_of, name);
  tinyobj::callback_t callbacks;
  callbacks.vertex_cb = [](void* user, double x, double y, double z, double /*w*/) {
    static_cast<Reader*>(user)->add_position(x, y, z);
  };
  callbacks.normal_cb = [](void* user, double x, double y, double z) {
    static_cast<Reader*>(user)->add_normal(x, y, z);
  };
  callbacks.index_cb = [](void* user, tinyobj::index_t* indices, int count) {
    static_cast<Reader*>(user)->add_face(indices, count);
  };
  std::string warning;
  std::string error;
  if (!tinyobj::LoadObjWithCallback(stream, callbacks, &reader, nullptr, &warning, &error)) {
    throw InputError(fmt::format("{}: {}.", name, reason_of(error)));
  }
  PolygonModel model = reader.finish(text.counts.lost_normals);
  model.notes = notes_of(text.counts);
  // Objects are made of groups.
  model.groups = std::move(text.objects.empty() ? text.groups : text.objects);
  close_groups(model.sizes.size(), model.groups);
  if (text.has_groups) model.smoothing_groups = std::move(text.smoothing_groups);
  if (model.sizes.empty()) {
    throw InputError(name + ": the file has no faces" + notes_after_semicolon(model) + ".");
  }
  if (!folder.empty() && !text.materials.empty()) add_material_colors(text, folder, model);
  return model;
}

std::string model_name(const std::filesystem::path& path) {
  return path.stem().string();
}

PolygonModel read_obj(const std::filesystem::path& path) {
  return parse_obj(read_bytes(path), path.string(), folder_of(path));
}

}  // namespace trisect
