// Writes the manual and the completions into a folder, laid out as share/ of an installed program:
//   make-manual FOLDER DATE
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "app/program/command_line.h"
#include "app/program/command_page.h"
#include "app/program/completions.h"
#include "app/program/manual.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

void write_text(const fs::path& path, const std::string& text) {
  fs::create_directories(path.parent_path());
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
}

void write_all(const fs::path& folder, const std::string& date) {
  const CommandLine command_line;
  const CommandPage program = command_page(command_line.app());
  for (const CommandPage* page : all_pages(program)) {
    write_text(folder / "man" / "man1" / (manual_name(*page) + ".1"),
               manual_page(program, *page, TRISECT_VERSION, date));
  }
  write_text(folder / "bash-completion" / "completions" / "trisect", bash_completions(program));
  write_text(folder / "zsh" / "vendor-completions" / "_trisect", zsh_completions(program));
  write_text(folder / "fish" / "vendor_completions.d" / "trisect.fish", fish_completions(program));
}

}  // namespace
}  // namespace trisect

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: make-manual FOLDER DATE\n", stderr);
    return 2;
  }
  try {
    trisect::write_all(argv[1], argv[2]);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make-manual: %s\n", error.what());
    return 1;
  }
}
