// Everything that a user can get wrong: bad_inputs.json says for each how it is made, what the
// program is told, the exit code, and words of the message.
//
// A row's "run" is a command line. In it @model is a model that is well, @picture a picture, @file
// the row's own file, @out the name of a file that is there before, @new one of a folder that is
// not, @missing one that is not there, @dir a folder (@dir.png too), @long a word of 100000
// letters. "file" is the name of the row's file, which has its "text", the bytes of "hex", or what
// "make" or "cut" names. For each of "with" {} is replaced in the run, the words and the text; for
// each of "parts" so much is left of the file that "cut" names.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "app/base/message.h"
#include "tests/support/file_content.h"
#include "tests/support/program.h"
#include "tests/support/run_program.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct BadInput {
  std::string run;
  std::string words;
  int code = 0;
  std::string file;     // its name, empty without one
  std::string content;  // of the file
};

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(what, at)) != std::string::npos; at += by.size()) {
    text.replace(at, what.size(), by);
  }
  return text;
}

std::string bytes_of_hex(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes.push_back(static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

// Words between spaces; what is between ' is one, empty or not.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  bool is_word = false;
  bool is_quoted = false;
  for (const char c : line) {
    if (c == '\'') {
      is_quoted = !is_quoted;
      is_word = true;
    } else if (c == ' ' && !is_quoted) {
      if (is_word) words.push_back(word);
      word.clear();
      is_word = false;
    } else {
      word += c;
      is_word = true;
    }
  }
  if (is_word) words.push_back(word);
  return words;
}

// Files that are well, which rows name or take parts of.
class GoodFiles {
 public:
  GoodFiles() {
    const std::string cube = test::asset_path("cube");
    fs::copy_file(cube, folder_ / "cube.obj");
    for (const char* ending : {"ply", "stl", "glb"}) {
      make({"export", cube, "--subdivide", "2", "-o", folder_ / fmt::format("cube.{}", ending)});
    }
    for (const char* ending : {"png", "exr", "pfm"}) {
      make({"render", cube, "--size", "16x16", "--backend", "cpu", "-o",
            folder_ / fmt::format("picture.{}", ending)});
    }
    make({"render", cube, "--size", "16x16", "--tile", "0,0,16,16", "--backend", "cpu", "-o",
          folder_ / "part.png"});
  }

  [[nodiscard]] fs::path path(const std::string& name) const { return folder_ / name; }

  [[nodiscard]] std::string part(const std::string& name, double part) const {
    const std::string bytes = test::content_of(folder_ / name);
    return bytes.substr(0, static_cast<std::size_t>(static_cast<double>(bytes.size()) * part));
  }

 private:
  static void make(const std::vector<std::string>& words) {
    const test::ProgramRun run = test::run_trisect(words);
    EXPECT_EQ(run.exit_code, 0) << run.err;
  }

  test::TemporaryFolder folder_;
};

void add_row(const json& row, const GoodFiles& good, std::vector<BadInput>& inputs) {
  const std::vector<std::string> values = row.value("with", std::vector<std::string>{"{}"});
  const std::vector<double> parts = row.value("parts", std::vector<double>{1.0});
  for (const std::string& value : values) {
    for (const double part : parts) {
      BadInput input;
      const std::string quoted = value == "{}" ? value : "'" + value + "'";
      input.run = replaced(row.at("run"), "{}", quoted);
      input.words = replaced(row.at("words"), "{}", value);
      input.code = row.at("code");
      input.file = row.value("file", "");
      input.content = replaced(row.value("text", ""), "{}", value);
      if (row.contains("hex")) input.content = bytes_of_hex(row.at("hex"));
      if (row.contains("cut")) input.content = good.part(row.at("cut"), part);
      if (row.value("make", "") == "long word") {
        input.content = "v " + std::string(1000000, 'x') + "\xC3\xA9 0 0\n";
      }
      inputs.push_back(std::move(input));
    }
  }
}

constexpr const char* kOld = "was here before";

// Runs one and says what is not as it is to be; empty if all is.
std::string fault_of(const BadInput& input, const GoodFiles& good) {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "dir");
  for (const char* ending : {"png", "exr", "ply"}) {
    fs::create_directories(folder / fmt::format("dir.{}", ending));
  }
  for (const char* name : {"out", "out.png", "out.exr", "out.ply", "out.bmp", "out.xyz"}) {
    std::ofstream(folder / name) << kOld;
  }
  if (!input.file.empty()) std::ofstream(folder / input.file, std::ios::binary) << input.content;
  const auto files_in = [&] {
    std::vector<std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
      files.push_back(entry.path().string());
    }
    return files;
  };
  const std::size_t before = files_in().size();

  std::vector<std::string> words = words_of(input.run);
  for (std::string& word : words) {
    word = replaced(word, "@model", good.path("cube.obj"));
    word = replaced(word, "@picture", good.path("picture"));
    word = replaced(word, "@file", folder / input.file);
    word = replaced(word, "@long", std::string(100000, 'a'));
    for (const char* name : {"out", "new", "missing", "dir"}) {
      word = replaced(word, fmt::format("@{}", name), folder / name);
    }
  }
  const test::ProgramRun run = test::run_trisect(words, {}, 60);

  std::string fault;
  const auto expect = [&](bool holds, const std::string& otherwise) {
    if (!holds) fault += otherwise + "; ";
  };
  expect(run.exit_code == input.code, fmt::format("code {}, not {}", run.exit_code, input.code));
  expect(run.err.starts_with("trisect: "), "it does not begin with the program's name");
  expect(run.err.find(input.words) != std::string::npos, "there is no '" + input.words + "'");
  const bool is_line = run.err.ends_with("\n") && run.err.size() <= kMessageBytes + 1;
  expect(is_line, fmt::format("{} bytes are not one short line", run.err.size()));
  const std::string line = run.err.substr(0, run.err.size() - (run.err.empty() ? 0 : 1));
  expect(escaped(line) == line, "it has bytes that are not to be shown");
  expect(!line.ends_with(".."), "it ends with two full stops");
  expect(files_in().size() == before, "a file was left");
  for (const char* name : {"out", "out.png", "out.exr", "out.ply"}) {
    expect(test::content_of(folder / name) == kOld, fmt::format("{} is another", name));
  }
  return fault.empty() ? fault : escaped(fmt::format("{}: {}{}", input.run, fault, line));
}

TEST(BadInputs, AreRefusedInASentenceWithTheirCode) {
  const GoodFiles good;
  std::ifstream file(TRISECT_SOURCES "/tests/program/bad_inputs.json");
  std::vector<BadInput> inputs;
  for (const json& row : json::parse(file)) add_row(row, good, inputs);
  EXPECT_GT(inputs.size(), 400U);
  std::atomic<std::size_t> next = 0;
  std::mutex mutex;
  const auto work = [&] {
    for (std::size_t i = next++; i < inputs.size(); i = next++) {
      const std::string fault = fault_of(inputs[i], good);
      const std::scoped_lock lock(mutex);
      EXPECT_EQ(fault, "");
    }
  };
  std::thread other(work);
  work();
  other.join();
}

// What it prints goes nowhere: each command says so.
TEST(BadInputs, WhatCannotBePrintedIsCode3) {
  const GoodFiles good;
  const test::TemporaryFolder folder;
  const std::string model = good.path("cube.obj").string();
  const std::string picture = good.path("picture.png").string();
  for (const std::string& command :
       {std::string("--help"), std::string("render --help"), std::string("bench speed --help"),
        std::string("--version"), std::string("devices"), std::string("devices --json -"),
        "info " + model, "info --json - " + model, "info -q --json - " + model,
        "render -o - --size 8x8 --backend cpu " + model,
        "render -o a.png --stats - --size 8x8 --backend cpu " + model,
        "export -o a.ply --subdivide 2 --json - " + model, "export -o a.ply --subdivide 2 " + model,
        fmt::format("compare {0} {0}", picture), fmt::format("compare --json - {0} {0}", picture),
        "crosscheck --backends cpu,oracle --size 8x8 " + model,
        "certify --backend cpu --size 8x8 --json - " + model,
        "stitch -o a.png " + good.path("part.png").string()}) {
    for (const char* closed : {">/dev/full", ">&-"}) {
      const std::string line = fmt::format("cd {} && {} {} {} 2>err", folder.path().string(),
                                           test::program_path(), command, closed);
      const int status = std::system(line.c_str());
      const std::string err = test::content_of(folder / "err");
      EXPECT_EQ(WEXITSTATUS(status), 3) << command << closed << err;
      EXPECT_NE(err.find("trisect: standard output: cannot be written: "), std::string::npos)
          << command << closed << err;
    }
  }
}

}  // namespace
}  // namespace trisect
