#include "app/mesh/gltf_data.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <limits>
#include <system_error>
#include <utility>

#include "app/base/error.h"
#include "app/base/folder_of.h"
#include "app/base/word_at.h"
#include "app/mesh/file_bytes.h"

namespace trisect::gltf {
namespace {

using nlohmann::json;

// The specification's numbers.
enum ComponentType : uint32_t {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126,
};

// The value of each of base64's digits, -1 for what is none.
constexpr std::array<int, 256> base64_values() {
  constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::array<int, 256> values{};
  for (int& value : values) value = -1;
  int value = 0;
  for (const char digit : digits) values[static_cast<unsigned char>(digit)] = value++;
  return values;
}

// Up to the padding.
std::string decoded_base64(std::string_view text) {
  constexpr std::array<int, 256> values = base64_values();
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3);
  uint32_t bits = 0;
  unsigned count = 0;
  for (const char c : text) {
    const int value = values[static_cast<unsigned char>(c)];
    if (value < 0) break;
    bits = bits << 6U | static_cast<uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<char>(bits >> count));
  }
  return bytes;
}

std::string decoded_percent(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_code = text[i] == '%' && i + 2 < text.size() && std::isxdigit(text[i + 1]) != 0 &&
                         std::isxdigit(text[i + 2]) != 0;
    if (is_code) {
      plain.push_back(static_cast<char>(std::stoi(text.substr(i + 1, 2), nullptr, 16)));
      i += 2;
    } else {
      plain.push_back(text[i]);
    }
  }
  return plain;
}

// EXT_meshopt_compression packs no more than so many bytes into one: 16 equal bytes into 2 bits.
constexpr std::size_t kMostPacked = 64;

std::size_t size_of(uint32_t component_type) {
  switch (component_type) {
    case kByte:
    case kUnsignedByte:
      return 1;
    case kShort:
    case kUnsignedShort:
      return 2;
    case kUnsignedInt:
    case kFloat:
      return 4;
    default:
      return 0;
  }
}

template <typename T>
double read_as(const char* at) {
  T value{};
  std::memcpy(&value, at, sizeof(value));
  return static_cast<double>(value);
}

// Table::step of components.
double step_of(uint32_t type, bool normalised) {
  if (type == kFloat) return 0.0;
  if (!normalised) return 1.0;
  switch (type) {
    case kByte:
      return 1.0 / 127.0;
    case kUnsignedByte:
      return 1.0 / 255.0;
    case kShort:
      return 1.0 / 32767.0;
    default:
      return 1.0 / 65535.0;
  }
}

// A component as a number; normalised ones are from -1 or 0 to 1.
double component_at(const char* at, uint32_t type, bool normalised) {
  switch (type) {
    case kByte:
      return normalised ? std::max(read_as<int8_t>(at) / 127.0, -1.0) : read_as<int8_t>(at);
    case kUnsignedByte:
      return read_as<uint8_t>(at) / (normalised ? 255.0 : 1.0);
    case kShort:
      return normalised ? std::max(read_as<int16_t>(at) / 32767.0, -1.0) : read_as<int16_t>(at);
    case kUnsignedShort:
      return read_as<uint16_t>(at) / (normalised ? 65535.0 : 1.0);
    case kUnsignedInt:
      return read_as<uint32_t>(at);
    default:
      return read_as<float>(at);
  }
}

}  // namespace

const json* extension_of(const json& object, const char* name) {
  const auto extensions = object.find("extensions");
  if (extensions == object.end()) return nullptr;
  const auto found = extensions->find(name);
  return found == extensions->end() ? nullptr : &*found;
}

std::string shown(const json& value) {
  return value.is_number() ? value.dump() : value.type_name();
}

std::size_t whole(const json& number) {
  if (!number.is_number_unsigned()) {
    throw json::other_error::create(500, "a whole number was expected, not " + shown(number),
                                    &number);
  }
  return number.get<std::size_t>();
}

std::size_t whole_or(const json& object, const char* key, std::size_t otherwise) {
  const auto found = object.find(key);
  return found == object.end() ? otherwise : whole(*found);
}

// Binary glTF: a header of twelve bytes, then chunks of a length, a type and bytes.
Data::Data(std::string_view bytes, std::filesystem::path path)
    : path_(std::move(path)), size_(bytes.size()) {
  if (!bytes.starts_with("glTF")) {
    root_ = json::parse(bytes);
    return;
  }
  constexpr uint32_t type_json = 0x4E4F534A;
  constexpr uint32_t type_binary = 0x004E4942;
  if (bytes.size() < 20) fail("is cut off");
  if (const uint32_t version = word_at(bytes, 4); version != 2) {
    fail(fmt::format("is glTF {}; only glTF 2 is read", version));
  }
  for (std::size_t at = 12; at + 8 <= bytes.size();) {
    const std::size_t size = word_at(bytes, at);
    const uint32_t type = word_at(bytes, at + 4);
    if (size > bytes.size() - at - 8) fail("is cut off");
    const std::string_view chunk = bytes.substr(at + 8, size);
    if (type == type_json && root_.is_null()) root_ = json::parse(chunk);
    if (type == type_binary && binary_.empty()) binary_ = chunk;
    at += 8 + (size + 3) / 4 * 4;
  }
}

void Data::fail(const std::string& what) const {
  throw InputError(path_.string() + ": " + what + ".");
}

const json& Data::element(const char* key, std::size_t index) const {
  const auto array = root_.find(key);
  const std::size_t size = array == root_.end() ? 0 : array->size();
  if (index >= size) {
    fail(fmt::format("names number {} of its {}, of which there are {}", index, key, size));
  }
  return (*array)[index];
}

std::string_view Data::view(std::size_t index) {
  const json& view = element("bufferViews", index);
  if (const json* packed = extension_of(view, "EXT_meshopt_compression")) {
    return unpacked(index, *packed);
  }
  return part(whole(view.at("buffer")), whole_or(view, "byteOffset", 0),
              whole(view.at("byteLength")));
}

Table Data::table(std::size_t index) {
  const json& accessor = element("accessors", index);
  static const std::map<std::string, std::size_t> columns{
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  const auto column = columns.find(accessor.at("type").get<std::string>());
  const auto type = static_cast<uint32_t>(whole(accessor.at("componentType")));
  if (column == columns.end() || size_of(type) == 0) {
    fail(fmt::format("accessor {} has an unknown type", index));
  }
  const bool normalised = accessor.value("normalized", false);
  Table table{column->second, {}, step_of(type, normalised)};
  const std::size_t rows = whole(accessor.at("count"));
  if (rows > 0xffffffffU) fail(fmt::format("accessor {} has too many elements", index));
  Place place{0, 0, 0, type, normalised};
  if (accessor.contains("bufferView")) {
    place.view = whole(accessor.at("bufferView"));
    place.offset = whole_or(accessor, "byteOffset", 0);
    const json& view = element("bufferViews", place.view);
    place.stride = whole_or(view, "byteStride", 0);
    const json* packed = extension_of(view, "EXT_meshopt_compression");
    if (packed != nullptr && packed->value("filter", std::string("NONE")) != "NONE") {
      table.step = std::numeric_limits<double>::infinity();
    }
    read(place, rows, table, index);
  } else {
    if (rows > most_rows_without_view()) {
      fail(fmt::format("accessor {} has too many elements for a file of this size", index));
    }
    table.numbers.assign(rows * table.columns, 0.0);
  }
  if (accessor.contains("sparse")) replace_some(accessor.at("sparse"), place, table, index);
  return table;
}

std::string_view Data::buffer(std::size_t index) {
  const auto known = buffers_.find(index);
  if (known != buffers_.end()) return known->second;
  const json& buffer = element("buffers", index);
  if (buffer.contains("uri")) {
    std::string bytes = read_uri(buffer.at("uri").get<std::string>(), index);
    return buffers_.emplace(index, std::move(bytes)).first->second;
  }
  if (index != 0 || binary_.empty()) fail(fmt::format("buffer {} has no bytes", index));
  return binary_;
}

// The zeros of an accessor without a view take no room in the file, but other numbers of the same
// vertices do: a file has more than one byte for so many elements.
std::size_t Data::most_rows_without_view() const {
  std::size_t bytes = size_;
  const std::size_t buffers = root_.contains("buffers") ? root_.at("buffers").size() : 0;
  for (std::size_t i = 0; i < buffers; ++i) {
    const auto file = file_of(element("buffers", i).value("uri", std::string()));
    std::error_code error;
    const std::uintmax_t size = file ? std::filesystem::file_size(*file, error) : 0;
    if (!error) bytes += size;
  }
  return kMostPacked * bytes;
}

// The file that a URI names, if it is in the model's folder or below.
std::optional<std::filesystem::path> Data::file_of(const std::string& uri) const {
  if (uri.starts_with("data:")) return std::nullopt;
  return file_below(folder_of(path_), decoded_percent(uri));
}

std::string Data::read_uri(const std::string& uri, std::size_t index) {
  if (uri.starts_with("data:")) {
    constexpr std::string_view mark = ";base64,";
    const std::size_t begin = uri.find(mark);
    if (begin == std::string::npos) fail(fmt::format("buffer {} has no base64 data", index));
    return decoded_base64(std::string_view(uri).substr(begin + mark.size()));
  }
  const auto file = file_of(uri);
  if (!file) fail("names a buffer outside its folder");
  std::string bytes = read_bytes(*file);
  files_.push_back(*file);
  return bytes;
}

std::string_view Data::part(std::size_t index, std::size_t offset, std::size_t size) {
  const std::string_view bytes = buffer(index);
  if (offset > bytes.size() || size > bytes.size() - offset) {
    fail(fmt::format("buffer {} ends before what is named of it", index));
  }
  return bytes.substr(offset, size);
}

std::string_view Data::unpacked(std::size_t index, const json& packed) {
  const auto known = unpacked_.find(index);
  if (known != unpacked_.end()) return known->second;
  const std::string_view bytes = part(whole(packed.at("buffer")), whole_or(packed, "byteOffset", 0),
                                      whole(packed.at("byteLength")));
  const std::size_t stride = whole(packed.at("byteStride"));
  const std::size_t count = whole(packed.at("count"));
  const auto mode = packed.at("mode").get<std::string>();
  const auto filter = packed.value("filter", std::string("NONE"));
  const bool is_vertex_stride = stride > 0 && stride <= 256 && stride % 4 == 0;
  const bool is_index_stride = stride == 2 || stride == 4;
  if (count > 0xffffffffU || !(mode == "ATTRIBUTES" ? is_vertex_stride : is_index_stride)) {
    fail(fmt::format("buffer view {} is packed in an unknown way", index));
  }
  if (count * stride > kMostPacked * bytes.size()) {
    fail(fmt::format("buffer view {} cannot be unpacked", index));
  }
  std::string plain(count * stride, '\0');
  const auto* from = reinterpret_cast<const unsigned char*>(bytes.data());
  int result = -1;
  if (mode == "ATTRIBUTES") {
    result = meshopt_decodeVertexBuffer(plain.data(), count, stride, from, bytes.size());
  } else if (mode == "TRIANGLES" && count % 3 == 0) {
    result = meshopt_decodeIndexBuffer(plain.data(), count, stride, from, bytes.size());
  } else if (mode == "INDICES") {
    result = meshopt_decodeIndexSequence(plain.data(), count, stride, from, bytes.size());
  }
  if (result != 0) fail(fmt::format("buffer view {} cannot be unpacked", index));
  if (filter == "OCTAHEDRAL" && (stride == 4 || stride == 8)) {
    meshopt_decodeFilterOct(plain.data(), count, stride);
  } else if (filter == "QUATERNION" && stride == 8) {
    meshopt_decodeFilterQuat(plain.data(), count, stride);
  } else if (filter == "EXPONENTIAL") {
    meshopt_decodeFilterExp(plain.data(), count, stride);
  } else if (filter != "NONE") {
    fail(fmt::format("buffer view {} has an unknown filter", index));
  }
  return unpacked_.emplace(index, std::move(plain)).first->second;
}

void Data::read(const Place& place, std::size_t rows, Table& table, std::size_t accessor) {
  const std::string_view bytes = view(place.view);
  const std::size_t component = size_of(place.component_type);
  const std::size_t element_size = component * table.columns;
  const std::size_t stride = place.stride == 0 ? element_size : place.stride;
  const std::size_t offset = place.offset;
  const bool fits = rows == 0 || (offset <= bytes.size() && bytes.size() - offset >= element_size &&
                                  (bytes.size() - offset - element_size) / stride >= rows - 1);
  if (!fits) fail(fmt::format("accessor {} goes beyond its buffer view", accessor));
  table.numbers.resize(rows * table.columns);
  for (std::size_t row = 0; row < rows; ++row) {
    const char* at = bytes.data() + offset + row * stride;
    for (std::size_t i = 0; i < table.columns; ++i) {
      table.numbers[row * table.columns + i] =
          component_at(at + i * component, place.component_type, place.normalised);
    }
  }
}

// A sparse accessor: some rows have other values.
void Data::replace_some(const json& sparse, const Place& like, Table& table, std::size_t accessor) {
  const std::size_t rows = whole(sparse.at("count"));
  const auto place_of = [](const json& object, uint32_t component_type, bool normalised) {
    return Place{whole(object.at("bufferView")), whole_or(object, "byteOffset", 0), 0,
                 component_type, normalised};
  };
  const json& indices = sparse.at("indices");
  const auto index_type = static_cast<uint32_t>(whole(indices.at("componentType")));
  if (size_of(index_type) == 0) fail(fmt::format("accessor {} has an unknown type", accessor));
  Table places{1, {}, 0.0};
  read(place_of(indices, index_type, false), rows, places, accessor);
  Table others{table.columns, {}, 0.0};
  read(place_of(sparse.at("values"), like.component_type, like.normalised), rows, others, accessor);
  for (std::size_t row = 0; row < rows; ++row) {
    const double place = places.numbers[row];
    if (!(place >= 0.0 && place < static_cast<double>(table.rows()))) {
      fail(fmt::format("accessor {} replaces an element that it does not have", accessor));
    }
    for (std::size_t i = 0; i < table.columns; ++i) {
      table.numbers[static_cast<std::size_t>(place) * table.columns + i] =
          others.numbers[row * table.columns + i];
    }
  }
}

}  // namespace trisect::gltf
