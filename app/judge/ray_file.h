// Rays and hits as files, for any program to write and to read: docs/formats.md describes them. A
// name that ends in .csv is text, any other binary, of single precision.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "app/surface/shared.h"

namespace trisect {

// origin + t direction with t_min <= t <= t_max, in the model's coordinates. The direction has any
// length but 0, and t counts in it.
struct FileRay {
  glm::dvec3 origin{0.0};
  double t_min = 0.0;
  glm::dvec3 direction{0.0, 0.0, 1.0};
  double t_max = std::numeric_limits<double>::infinity();
};

// Of a hit whose triangle is not told.
inline constexpr uint32_t kSomeTriangle = NO_TRIANGLE - 1;

// The first hit of a ray.
struct FileHit {
  double t = 0.0;
  // Weights of the triangle's second and third vertex; NaN if they are not told.
  double u = std::numeric_limits<double>::quiet_NaN();
  double v = std::numeric_limits<double>::quiet_NaN();
  uint32_t triangle = NO_TRIANGLE;  // NO_TRIANGLE: the ray hits nothing
};

// Each throws InputError, naming the file and the ray or the line, for what is none. A hit's t may
// be any number, NaN too.
std::vector<FileRay> read_rays(const std::filesystem::path& path);
std::vector<FileHit> read_hits(const std::filesystem::path& path);

// The content of a file of this name. Numbers are rounded to single precision.
std::string rays_for(const std::string& name, std::span<const FileRay> rays);
std::string hits_for(const std::string& name, std::span<const FileHit> hits);

}  // namespace trisect
