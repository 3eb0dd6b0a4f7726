#include "app/report/document.h"

#include <fmt/format.h>

#include <cctype>
#include <cstdint>
#include <cstring>

#include "app/base/read_file.h"

namespace trisect::report {
namespace {

template <typename... F>
struct Overloaded : F... {
  using F::operator()...;
};
template <typename... F>
Overloaded(F...) -> Overloaded<F...>;

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

// A file's name as a link has it: what could end the link is a percent sign and the byte's number.
std::string link_to(const std::string& file) {
  std::string link;
  for (const char c : file) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = std::isalnum(byte) != 0 || std::strchr("-_./", c) != nullptr;
    link += is_plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
  }
  return link;
}

std::string markdown_of(const Table& table) {
  std::string text;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    text += markdown_line(table.rows[i]);
    if (i > 0) continue;
    text += "|";
    for (std::size_t k = 0; k < table.rows[0].size(); ++k) text += "---|";
    text += "\n";
  }
  return text;
}

std::string html_of(const Table& table) {
  std::string text = "<table>\n";
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const char* tag = i == 0 ? "th" : "td";
    text += "<tr>";
    for (const std::string& cell : table.rows[i]) {
      text += fmt::format("<{0}>{1}</{0}>", tag, escaped(cell));
    }
    text += "</tr>\n";
  }
  return text + "</table>\n";
}

std::string content_of(const std::filesystem::path& path) {
  return read_file(path);
}

std::string html_of(const Picture& picture, const std::filesystem::path& folder) {
  const std::string type = picture.file.ends_with(".svg") ? "svg+xml" : "png";
  return fmt::format("<p><img alt=\"{}\" src=\"data:image/{};base64,{}\"></p>\n",
                     escaped(picture.text), type, base64_of(content_of(folder / picture.file)));
}

}  // namespace

std::string markdown_line(const std::vector<std::string>& cells) {
  std::string line = "|";
  for (const std::string& cell : cells) {
    line += ' ';
    for (const char c : cell) line += c == '|' ? "\\|" : std::string(1, c);
    line += " |";
  }
  return line + "\n";
}

std::string base64_of(const std::string& bytes) {
  constexpr const char* digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      group = group << 8U | (i + k < bytes.size() ? static_cast<uint8_t>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool padding = i + k > bytes.size();
      text += padding ? '=' : digits[(group >> (18U - 6U * k)) & 63U];
    }
  }
  return text;
}

std::string markdown_of(const std::vector<Block>& blocks) {
  std::string text;
  for (const Block& block : blocks) {
    if (!text.empty()) text += "\n";
    text += std::visit(
        Overloaded{[](const Heading& heading) {
                     return std::string(static_cast<std::size_t>(heading.level), '#') + " " +
                            heading.text + "\n";
                   },
                   [](const Paragraph& paragraph) { return paragraph.text + "\n"; },
                   [](const Items& items) {
                     std::string list;
                     for (const std::string& item : items.texts) {
                       list += "- " + item + "\n";
                     }
                     return list;
                   },
                   [](const Table& table) { return markdown_of(table); },
                   [](const Picture& picture) {
                     return fmt::format("![{}]({})\n", picture.text, link_to(picture.file));
                   }},
        block);
  }
  return text;
}

std::string html_of(const std::string& title, const std::vector<Block>& blocks,
                    const std::filesystem::path& folder) {
  std::string text = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<title>{}</title>\n"
      "<style>body{{font:15px/1.4 sans-serif;max-width:1100px;margin:2em auto;padding:0 1em}}"
      "table{{border-collapse:collapse;font-size:13px}}"
      "td,th{{border:1px solid #ccc;padding:2px 6px;text-align:right}}"
      "td:first-child,th:first-child{{text-align:left}}img{{max-width:100%}}</style>\n</head>\n"
      "<body>\n",
      escaped(title));
  for (const Block& block : blocks) {
    text += std::visit(Overloaded{[](const Heading& heading) {
                                    return fmt::format("<h{0}>{1}</h{0}>\n", heading.level,
                                                       escaped(heading.text));
                                  },
                                  [](const Paragraph& paragraph) {
                                    return fmt::format("<p>{}</p>\n", escaped(paragraph.text));
                                  },
                                  [](const Items& items) {
                                    std::string list = "<ul>\n";
                                    for (const std::string& item : items.texts) {
                                      list += fmt::format("<li>{}</li>\n", escaped(item));
                                    }
                                    return list + "</ul>\n";
                                  },
                                  [](const Table& table) { return html_of(table); },
                                  [&](const Picture& picture) { return html_of(picture, folder); }},
                       block);
  }
  return text + "</body>\n</html>\n";
}

}  // namespace trisect::report
