// Writes the project's models as OBJ files into a folder: make-assets FOLDER [NAME ...]; all, or
// those named.
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "assets/generator/shapes.h"
#include "assets/generator/teapot.h"

namespace {

using trisect::assets::Model;
namespace assets = trisect::assets;

const std::map<std::string, std::function<Model()>> kModels{
    {"sphere-20", [] { return assets::sphere(0); }},
    {"sphere-80", [] { return assets::sphere(1); }},
    {"sphere-320", [] { return assets::sphere(2); }},
    {"torus", assets::torus},
    {"relief", assets::relief},
    {"teapot", [] { return assets::teapot(assets::kTeapot304); }},
    {"teapot-1000", [] { return assets::teapot(assets::kTeapot1016); }},
    {"teapot-4000", [] { return assets::teapot(assets::kTeapot4000); }},
    {"capsule", assets::capsule},
    {"cube", assets::cube},
    {"saddle", assets::saddle},
};

int run(const std::vector<std::string>& arguments) {
  if (arguments.empty()) {
    std::fputs("usage: make-assets FOLDER [NAME ...]\n", stderr);
    return 2;
  }
  const std::filesystem::path folder(arguments.front());
  std::filesystem::create_directories(folder);
  std::vector<std::string> names(arguments.begin() + 1, arguments.end());
  if (names.empty()) {
    for (const auto& [name, make] : kModels) names.push_back(name);
  }
  for (const std::string& name : names) {
    const auto entry = kModels.find(name);
    if (entry == kModels.end()) throw std::runtime_error("there is no model called " + name);
    const std::filesystem::path path = folder / (name + ".obj");
    std::ofstream file(path, std::ios::binary);
    file << entry->second().obj();
    file.close();
    if (!file) throw std::runtime_error(path.string() + " cannot be written");
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run({argv + 1, argv + argc});
  } catch (const std::exception& error) {
    std::fprintf(stderr, "make-assets: %s\n", error.what());
    return 3;
  }
}
