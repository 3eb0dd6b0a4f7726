// Writes the project's models as OBJ files into a folder: make-assets FOLDER [NAME ...]; all, or
// those named. Large ones are made by name only: sphere-1280 to sphere-5242880, each of four times
// the triangles of the one before, so torus-1024 to torus-1048576, relief-320 to relief-327680 and
// saddle-128 to saddle-131072; capsule-960 to capsule-1046528, each with edges half as long; and
// teapot-16k, -65k, -260k, -1m and -4m.
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
    {"torus", [] { return assets::torus(); }},
    {"relief", [] { return assets::relief(); }},
    {"teapot", [] { return assets::teapot(assets::kTeapot304); }},
    {"teapot-1000", [] { return assets::teapot(assets::kTeapot1016); }},
    {"teapot-4000", [] { return assets::teapot(assets::kTeapot4000); }},
    {"capsule", [] { return assets::capsule(); }},
    {"cube", assets::cube},
    {"saddle", [] { return assets::saddle(); }},
};

// Those that are only made by name.
std::map<std::string, std::function<Model()>> large_models() {
  std::map<std::string, std::function<Model()>> models;
  int triangles = 1280;
  for (int divisions = 3; divisions <= 9; ++divisions, triangles *= 4) {
    models["sphere-" + std::to_string(triangles)] = [=] { return assets::sphere(divisions); };
  }
  for (int finer = 2; finer <= 64; finer *= 2) {
    const auto add = [&](const char* name, int count, Model (*make)(int)) {
      models[name + std::to_string(count)] = [=] { return make(finer); };
    };
    add("torus-", 256 * finer * finer, assets::torus);
    add("capsule-", 256 * finer * finer - 32 * finer, assets::capsule);
    add("relief-", 80 * finer * finer, assets::relief);
    add("saddle-", 32 * finer * finer, assets::saddle);
  }
  int finer = 4;
  for (const char* name : {"teapot-16k", "teapot-65k", "teapot-260k", "teapot-1m", "teapot-4m"}) {
    models[name] = [=] { return assets::teapot(assets::divided(assets::kTeapot1016, finer)); };
    finer *= 2;
  }
  return models;
}

const std::function<Model()>& maker_of(const std::string& name) {
  static const std::map<std::string, std::function<Model()>> large = large_models();
  for (const auto* models : {&kModels, &large}) {
    const auto entry = models->find(name);
    if (entry != models->end()) return entry->second;
  }
  throw std::runtime_error("there is no model called " + name);
}

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
    const std::function<Model()>& make = maker_of(name);
    const std::filesystem::path path = folder / (name + ".obj");
    std::ofstream file(path, std::ios::binary);
    file << make().obj();
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
