// The JSON and the numbers of a glTF 2.0 file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trisect::gltf {

// An extension of an object, or null.
const nlohmann::json* extension_of(const nlohmann::json& object, const char* name);

// What a message shows of a value: a number as it is, of anything else its type. json::dump() calls
// itself for each array within an array, for which a file may have no end of them.
std::string shown(const nlohmann::json& value);

// A number that must be whole and not negative. Throws json::exception otherwise.
std::size_t whole(const nlohmann::json& number);
std::size_t whole_or(const nlohmann::json& object, const char* key, std::size_t otherwise);

// The numbers of an accessor or of an attribute, row by row.
struct Table {
  std::size_t columns = 0;
  std::vector<double> numbers;
  // The step between the numbers that it can have: 0 for floats, infinite if a compression has
  // rounded them: how far is not read.
  double step = 0.0;

  [[nodiscard]] std::size_t rows() const { return columns == 0 ? 0 : numbers.size() / columns; }
  [[nodiscard]] glm::dvec3 vector(std::size_t row) const {
    return {numbers[row * columns], numbers[row * columns + 1], numbers[row * columns + 2]};
  }
};

// The functions throw InputError with the file's name for what names nothing or goes beyond what is
// there, json::exception for what has not the type that it should have.
class Data {
 public:
  // bytes: of the file, JSON or binary, which must outlive the data; path: beside which its buffers
  // are, in its folder and below.
  Data(std::string_view bytes, std::filesystem::path path);

  [[nodiscard]] const nlohmann::json& root() const { return root_; }

  // Throws InputError with the file's name.
  [[noreturn]] void fail(const std::string& what) const;

  // Element `index` of the array `key` of the root.
  [[nodiscard]] const nlohmann::json& element(const char* key, std::size_t index) const;

  // The bytes of a buffer view, unpacked if EXT_meshopt_compression has packed them.
  std::string_view view(std::size_t index);

  // The files of the buffers that have been read.
  [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return files_; }

  // An accessor. Normalised components are from -1 or 0 to 1.
  Table table(std::size_t index);

 private:
  std::string_view buffer(std::size_t index);
  [[nodiscard]] std::size_t most_rows_without_view() const;
  [[nodiscard]] std::optional<std::filesystem::path> file_of(const std::string& uri) const;
  std::string read_uri(const std::string& uri, std::size_t index);
  std::string_view part(std::size_t index, std::size_t offset, std::size_t size);
  std::string_view unpacked(std::size_t index, const nlohmann::json& packed);
  // Where numbers lie: in a view, `stride` apart or, if that is 0, side by side.
  struct Place {
    std::size_t view;
    std::size_t offset;
    std::size_t stride;
    uint32_t component_type;
    bool normalised;
  };
  // accessor: for messages.
  void read(const Place& place, std::size_t rows, Table& table, std::size_t accessor);
  void replace_some(const nlohmann::json& sparse, const Place& like, Table& table,
                    std::size_t accessor);

  std::filesystem::path path_;
  std::size_t size_;  // of the file
  nlohmann::json root_;
  std::string_view binary_;                     // the bytes in a binary file
  std::map<std::size_t, std::string> buffers_;  // those with a URI
  std::vector<std::filesystem::path> files_;    // of buffers
  std::map<std::size_t, std::string> unpacked_;
};

}  // namespace trisect::gltf
