#include "tests/support/command_in_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <vector>

#include "app/judge/cast_files.h"
#include "app/judge/hard_rays.h"
#include "app/judge/ray_file.h"
#include "tests/support/file_content.h"
#include "tests/support/run_program.h"
#include "tests/support/scenes.h"

namespace trisect::test {

namespace fs = std::filesystem;

std::vector<std::string> in_folder(const std::vector<std::string>& words, const fs::path& folder) {
  const std::string prefix = "FOLDER/";
  std::vector<std::string> placed = words;
  for (std::string& word : placed) {
    if (word.starts_with(prefix)) word = folder / word.substr(prefix.size());
  }
  return placed;
}

void prepare_outputs(const CommandInFolder& command, const fs::path& folder) {
  for (const std::string& name : command.outputs) std::ofstream(folder / name) << kBefore;
}

std::map<std::string, std::string> files_in(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file()) continue;
    files[fs::relative(entry.path(), folder)] = content_of(entry.path());
  }
  return files;
}

TwoParts::TwoParts(int size) {
  for (const int y : {0, size / 2}) {
    names_.push_back(folder_ / fmt::format("{}.png", y));
    const ProgramRun run = run_trisect(
        {"render", asset_path("cube"), "--size", fmt::format("{}x{}", size, size), "--tile",
         fmt::format("0,{},{},{}", y, size, size / 2), "--backend", "cpu", "-o", names_.back()});
    EXPECT_EQ(run.exit_code, 0) << run.err;
  }
}

CommandInFolder TwoParts::stitched() const {
  return {{"stitch", names_[0], names_[1], "-o", "FOLDER/a.png"}, {"a.png"}};
}

CommandInFolder TwoParts::compared() const {
  return {{"compare", names_[0], names_[0], "--diff", "FOLDER/d.png", "--json", "FOLDER/c.json"},
          {"d.png", "c.json"}};
}

RayLists::RayLists(const std::string& asset, std::size_t count)
    : model_(asset_path(asset)), rays_(folder_ / "a.rays"), hits_(folder_ / "a.hits") {
  const BakedScene scene = bake_about(load_asset(asset), SurfaceChoice{}, glm::dvec3(0.0));
  std::vector<FileRay> rays;
  for (const RayKind& kind : kRayKinds) {
    for (const FileRay& ray : hard_rays(scene, kind.name, count, 1)) rays.push_back(ray);
  }
  std::ofstream(rays_, std::ios::binary) << rays_for(rays_, rays);
  std::ofstream(hits_, std::ios::binary) << hits_for(hits_, *cast_by_oracle(scene, rays, {}));
}

CommandInFolder RayLists::cast() const {
  return {{"cast", rays_, model_, "--backend", "cpu", "-o", "FOLDER/a.hits"}, {"a.hits"}};
}

CommandInFolder RayLists::judged() const {
  return {{"judge", rays_, hits_, model_, "--json", "FOLDER/j.json", "--wrong", "FOLDER/w.csv"},
          {"j.json", "w.csv"}};
}

}  // namespace trisect::test
