// The columns of a report, stated once for all of its outputs: CSV, JSON, tables in Markdown and
// HTML, and aligned text.
#pragma once

#include <functional>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/report/document.h"

namespace trisect::report {

// What a row has in a column: a number, a text, a truth value, or null if it has nothing there.
using Value = nlohmann::ordered_json;

template <typename T>
Value value_or_null(const std::optional<T>& value) {
  return value ? Value(*value) : Value();
}

// How an output titles a column and writes its cells.
struct CellFormat {
  std::string title;
  std::string format;  // a format string of fmt for one value; empty if the output lacks the column
  int width = 0;       // at least so many characters, aligned to the right, or if < 0 to the left
};

// The value by the format. Null leaves the place of the value empty, and a text, such as a word in
// a column of numbers, stands there as it is.
std::string cell_of(const CellFormat& format, const Value& value);

template <typename Row>
struct Column {
  CellFormat csv;
  // A path of keys: "ms.median" is the key "median" of the object "ms". Empty if JSON lacks it.
  std::string json;
  CellFormat table;
  std::function<Value(const Row&)> value;
  CellFormat text{};  // of aligned text
};

// Sets the value of a path of keys in an object, and makes the objects on the way. Null sets
// nothing.
void set_value(nlohmann::ordered_json& object, const std::string& path, const Value& value);

// Cells as a line of CSV. Text that needs quotation marks gets them, if its column's format has
// none.
std::string csv_line(const std::vector<std::string>& cells);

// Cells with a blank between them, and a newline.
std::string text_line(const std::vector<std::string>& cells);

// Columns in the order in which each output has them.
template <typename Row>
class Columns {
 public:
  Columns(std::initializer_list<Column<Row>> columns) : columns_(columns) {}

  // A line of titles, and one for each row.
  [[nodiscard]] std::string csv(const std::vector<Row>& rows) const {
    std::string text = csv_line(titles(&Column<Row>::csv));
    for (const Row& row : rows) text += csv_line(cells(&Column<Row>::csv, row));
    return text;
  }

  [[nodiscard]] nlohmann::ordered_json json(const Row& row) const {
    nlohmann::ordered_json object;
    for (const Column<Row>& column : columns_) {
      if (!column.json.empty()) set_value(object, column.json, column.value(row));
    }
    return object;
  }

  // An array of objects.
  [[nodiscard]] nlohmann::ordered_json json(const std::vector<Row>& rows) const {
    nlohmann::ordered_json array = nlohmann::ordered_json::array();
    for (const Row& row : rows) array.push_back(json(row));
    return array;
  }

  [[nodiscard]] Table table(const std::vector<Row>& rows) const {
    Table table{{titles(&Column<Row>::table)}};
    for (const Row& row : rows) table.rows.push_back(cells(&Column<Row>::table, row));
    return table;
  }

  // The lines of tables that are printed a row at a time.
  [[nodiscard]] std::string markdown_header() const {
    return markdown_of(std::vector<Block>{table({})});
  }
  [[nodiscard]] std::string markdown_row(const Row& row) const {
    return markdown_line(cells(&Column<Row>::table, row));
  }
  [[nodiscard]] std::string text_header() const { return text_line(titles(&Column<Row>::text)); }
  [[nodiscard]] std::string text_row(const Row& row) const {
    return text_line(cells(&Column<Row>::text, row));
  }

  [[nodiscard]] auto begin() const { return columns_.begin(); }
  [[nodiscard]] auto end() const { return columns_.end(); }

 private:
  [[nodiscard]] std::vector<std::string> titles(CellFormat Column<Row>::*output) const {
    std::vector<std::string> result;
    for (const Column<Row>& column : columns_) {
      const CellFormat& format = column.*output;
      if (!format.format.empty()) result.push_back(cell_of({"", "{}", format.width}, format.title));
    }
    return result;
  }

  [[nodiscard]] std::vector<std::string> cells(CellFormat Column<Row>::*output,
                                               const Row& row) const {
    std::vector<std::string> result;
    for (const Column<Row>& column : columns_) {
      const CellFormat& format = column.*output;
      if (!format.format.empty()) result.push_back(cell_of(format, column.value(row)));
    }
    return result;
  }

  std::vector<Column<Row>> columns_;
};

}  // namespace trisect::report
