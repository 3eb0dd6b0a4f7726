#include "app/report/columns.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstdlib>

namespace trisect::report {
namespace {

std::string unpadded(const std::string& format, const Value& value) {
  const auto formatted = [&](const auto& of) {
    return fmt::vformat(format, fmt::make_format_args(of));
  };
  if (value.is_null() || value.is_string()) {
    const std::string text = value.is_null() ? "" : value.get<std::string>();
    return format.substr(0, format.find('{')) + text + format.substr(format.find('}') + 1);
  }
  if (value.is_number_float()) return formatted(value.get<double>());
  if (value.is_number_unsigned()) return formatted(value.get<uint64_t>());
  return formatted(value.dump());
}

// RFC 4180: what has a comma, a quotation mark or a line's end in it stands in quotation marks, and
// those in it are doubled. Some columns have the marks in their format.
std::string quoted_for_csv(const std::string& cell) {
  const bool has_marks = cell.size() >= 2 && cell.front() == '"' && cell.back() == '"';
  const std::string text = has_marks ? cell.substr(1, cell.size() - 2) : cell;
  if (!has_marks && text.find_first_of(",\"\r\n") == std::string::npos) return cell;
  std::string result = "\"";
  for (const char c : text) result += c == '"' ? "\"\"" : std::string(1, c);
  return result + "\"";
}

}  // namespace

std::string cell_of(const CellFormat& format, const Value& value) {
  const std::string text = unpadded(format.format, value);
  return format.width < 0 ? fmt::format("{:<{}}", text, -format.width)
                          : fmt::format("{:>{}}", text, format.width);
}

void set_value(nlohmann::ordered_json& object, const std::string& path, const Value& value) {
  if (value.is_null()) return;
  const std::size_t dot = path.find('.');
  if (dot == std::string::npos) {
    object[path] = value;
  } else {
    set_value(object[path.substr(0, dot)], path.substr(dot + 1), value);
  }
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::vector<std::string> quoted;
  quoted.reserve(cells.size());
  for (const std::string& cell : cells) quoted.push_back(quoted_for_csv(cell));
  return fmt::format("{}\n", fmt::join(quoted, ","));
}

std::string text_line(const std::vector<std::string>& cells) {
  return fmt::format("{}\n", fmt::join(cells, " "));
}

}  // namespace trisect::report
