// The manual has every option of every command, and is well-formed roff.
#include "app/program/manual.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>

#include "app/program/command_line.h"

namespace trisect {
namespace {

// Of text that the manual shows: without fonts, and with the letters that escapes stand for.
std::string shown(const std::string& roff) {
  std::string text;
  for (std::size_t i = 0; i < roff.size(); ++i) {
    if (roff[i] != '\\') {
      text += roff[i];
    } else if (roff.compare(i, 2, "\\f") == 0) {
      i += 2;
    } else if (roff.compare(i, 4, "\\(aq") == 0) {
      text += '\'';
      i += 3;
    } else {
      ++i;
      text += roff[i] == 'e' ? '\\' : roff[i];
    }
  }
  return text;
}

TEST(Manual, NamesEveryOptionOfEveryCommand) {
  const CommandPage program = command_page(CommandLine().app());
  for (const CommandPage* page : all_pages(program)) {
    const std::string text = shown(manual_page(program, *page, "1.2.3", "2026-01-31"));
    for (const OptionPage& option : page->options) {
      std::string heading;
      for (const std::string& name : option.names) heading += (heading.empty() ? "" : ", ") + name;
      EXPECT_NE(text.find("\n.TP\n" + heading), std::string::npos) << page->path << ' ' << heading;
    }
    for (const char* section :
         {"NAME", "SYNOPSIS", "DESCRIPTION", "OPTIONS", "EXAMPLES", "EXIT STATUS", "SEE ALSO"}) {
      EXPECT_NE(text.find(std::string("\n.SH ") + section + '\n'), std::string::npos)
          << page->path << ' ' << section;
    }
  }
}

// roff takes a line that begins with . or ' for a request, and a bare - for a hyphen that cannot be
// copied. Only requests of man(7) that are meant begin a line.
TEST(Manual, EscapesWhatRoffWouldTakeForItsOwn) {
  CommandPage page;
  page.path = "trisect";
  page.summary = ".hidden files of a\\b it's a-b";
  page.usage = "trisect .";
  page.options = {{{"--dotted"}, "A-B", "Help", "'quoted' or .png -x", false, false, false, {}}};
  std::istringstream text(manual_page(page, page, "1.2.3", "2026-01-31"));
  std::string all;
  for (std::string line; std::getline(text, line);) {
    all += line + '\n';
    EXPECT_FALSE(line.starts_with('\'')) << line;
    if (!line.starts_with('.')) {
      for (std::size_t at = line.find('-'); at != std::string::npos; at = line.find('-', at + 1)) {
        EXPECT_TRUE(at > 0 && line[at - 1] == '\\') << line;
      }
    } else if (!line.starts_with(".\\\"")) {
      const std::string request = line.substr(1, line.find(' ') - 1);
      EXPECT_TRUE(request == "TH" || request == "SH" || request == "SS" || request == "TP" ||
                  request == "PP" || request == "BR" || request == "nf" || request == "fi" ||
                  request == "RS" || request == "RE")
          << line;
    }
  }
  EXPECT_NE(all.find("\n\\&.hidden files of a\\eb it\\(aqs a\\-b.\n"), std::string::npos) << all;
  EXPECT_NE(all.find("\\fB\\-\\-dotted\\fR \\fIA\\-B\\fR\n\\(aqquoted\\(aq or .png \\-x.\n"),
            std::string::npos)
      << all;
}

}  // namespace
}  // namespace trisect
