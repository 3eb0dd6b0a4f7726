// Includes go one way: from a room to itself and to the rooms before it, in the order that
// app/CMakeLists.txt has.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/file_content.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

const fs::path kSources(TRISECT_SOURCES);

std::vector<std::string> rooms() {
  std::istringstream text(TRISECT_ROOMS);
  std::vector<std::string> names;
  for (std::string name; text >> name;) names.push_back(name);
  return names;
}

// C++ and GLSL files of a folder and the folders in it, relative to the source tree.
std::vector<fs::path> sources_in(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(kSources / folder)) {
    const std::string ending = entry.path().extension().string();
    if (ending == ".h" || ending == ".cpp" || ending == ".glsl" || ending == ".comp") {
      files.push_back(fs::relative(entry.path(), kSources));
    }
  }
  return files;
}

// What a file includes in quotes, but for headers that are made at build time.
std::vector<fs::path> includes_of(const fs::path& file) {
  std::istringstream text(test::content_of(kSources / file));
  const std::string include = "#include \"";
  std::vector<fs::path> included;
  for (std::string line; std::getline(text, line);) {
    if (!line.starts_with(include)) continue;
    included.emplace_back(line.substr(include.size(), line.rfind('"') - include.size()));
  }
  return included;
}

// "bake" of app/bake/bvh.h; empty for a file that is in no room.
std::string room_of(const fs::path& file) {
  auto part = file.begin();
  if (part == file.end() || *part != "app" || ++part == file.end()) return {};
  const std::string room = part->string();
  return ++part == file.end() ? std::string() : room;
}

TEST(Rooms, IncludeOnlyThoseBeforeThem) {
  const std::vector<std::string> order = rooms();
  const auto place = [&](const std::string& room) {
    return std::find(order.begin(), order.end(), room) - order.begin();
  };
  std::size_t seen = 0;
  for (const fs::path& file : sources_in("app")) {
    const std::string room = room_of(file);
    if (room.empty()) continue;
    ASSERT_LT(place(room), static_cast<std::ptrdiff_t>(order.size()))
        << file << " is in a folder that app/CMakeLists.txt does not name as a room";
    for (const fs::path& included : includes_of(file)) {
      if (*included.begin() == "tests") ADD_FAILURE() << file << " includes " << included;
      const std::string other = room_of(included);
      if (*included.begin() != "app") continue;
      ++seen;
      EXPECT_FALSE(other.empty()) << file << " includes " << included << ", which is in no room";
      EXPECT_LE(place(other), place(room))
          << file << " includes " << included << " against the order of the rooms";
    }
  }
  EXPECT_GT(seen, 300U) << "the includes were not found";
}

// The layer over Vulkan and the shaders stand below all rooms.
TEST(Rooms, VulkanLayerAndShadersIncludeNothingOfTheProgram) {
  for (const fs::path& file : sources_in("vk")) {
    for (const fs::path& included : includes_of(file)) {
      EXPECT_EQ(*included.begin(), "vk") << file << " includes " << included;
    }
  }
  for (const fs::path& file : sources_in("shaders")) {
    for (const fs::path& included : includes_of(file)) {
      EXPECT_FALSE(included.has_parent_path()) << file << " includes " << included;
    }
  }
}

// What belongs to the program: printing, the environment, signals, the terminal.
TEST(Rooms, LibraryIsQuiet) {
  const std::vector<std::string> loud{"fmt::print",  "puts(",     "printf(", "std::cout",
                                      "std::cerr",   "std::clog", "getenv",  "sigaction",
                                      "std::signal", "isatty"};
  std::istringstream names(TRISECT_LIBRARY_ROOMS);
  std::size_t files = 0;
  for (std::string room; names >> room;) {
    for (const fs::path& file : sources_in("app/" + room)) {
      ++files;
      const std::string text = test::content_of(kSources / file);
      for (const std::string& word : loud) {
        EXPECT_EQ(text.find(word), std::string::npos) << file << " has " << word;
      }
    }
  }
  EXPECT_GT(files, 80U);
}

TEST(Rooms, ReadmeHasTheirOrder) {
  EXPECT_NE(test::content_of(kSources / "README.md").find("`" TRISECT_ROOMS "`"), std::string::npos)
      << "README does not have the order `" << TRISECT_ROOMS << "`";
}

}  // namespace
}  // namespace trisect
