// A report as a list of blocks, written as Markdown or as an HTML page that embeds its pictures.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace trisect::report {

struct Heading {
  int level;  // 1 to 6
  std::string text;
};
struct Paragraph {
  std::string text;
};
struct Items {
  std::vector<std::string> texts;
};
struct Table {
  std::vector<std::vector<std::string>> rows;  // the first one the header
};
struct Picture {
  std::string file;  // .svg or .png, relative to the report's folder
  std::string text;  // what it shows
};
using Block = std::variant<Heading, Paragraph, Items, Table, Picture>;

std::string markdown_of(const std::vector<Block>& blocks);

// A row of a table in Markdown, with a newline.
std::string markdown_line(const std::vector<std::string>& cells);

// Pictures are read from `folder`. Throws InputError if one cannot be.
std::string html_of(const std::string& title, const std::vector<Block>& blocks,
                    const std::filesystem::path& folder);

// RFC 4648, with padding.
std::string base64_of(const std::string& bytes);

}  // namespace trisect::report
