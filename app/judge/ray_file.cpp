#include "app/judge/ray_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <optional>
#include <string_view>

#include "app/base/error.h"
#include "app/base/memory.h"
#include "app/base/number_text.h"
#include "app/base/read_file.h"
#include "app/base/trimmed.h"

namespace trisect {
namespace {

namespace fs = std::filesystem;

static_assert(std::endian::native == std::endian::little, "the files are little-endian");

// Records of the binary files.
struct RayRecord {
  std::array<float, 3> origin;
  float t_min;
  std::array<float, 3> direction;
  float t_max;
};
struct HitRecord {
  float t;
  float u;
  float v;
  uint32_t triangle;
};
static_assert(sizeof(RayRecord) == 32 && sizeof(HitRecord) == 16);

constexpr std::string_view kRayColumns = "ox,oy,oz,t_min,dx,dy,dz,t_max";
constexpr std::string_view kHitColumns = "t,u,v,triangle";

bool is_text(const fs::path& path) {
  return path.extension() == ".csv";
}

[[noreturn]] void refuse(const fs::path& path, std::size_t line, std::string_view cell,
                         const char* what) {
  throw InputError(fmt::format("{}, line {}: '{}' is not {}.", path.string(), line, cell, what));
}

double number_of_cell(const fs::path& path, std::size_t line, std::string_view cell) {
  const std::optional<double> number = parse_number<double>(cell);
  if (!number) refuse(path, line, cell, "a number");
  return *number;
}

// Calls use(cells, line) for each line of a text that is not empty, but for one that names the
// columns. Throws InputError if it has another number of cells than there are columns.
template <std::size_t count, typename Use>
void for_lines(const fs::path& path, std::string_view columns, Use&& use) {
  const std::string text = read_file(path);
  std::string_view rest = text;
  for (std::size_t line = 1; !rest.empty(); ++line) {
    const std::string_view row = trimmed(rest.substr(0, rest.find('\n')));
    rest.remove_prefix(std::min(rest.size(), rest.find('\n')));
    if (!rest.empty()) rest.remove_prefix(1);
    if (row.empty() || row == columns) continue;
    std::array<std::string_view, count> cells;
    std::size_t found = 0;
    for (std::string_view left = row;; left.remove_prefix(left.find(',') + 1)) {
      if (found < count) cells[found] = trimmed(left.substr(0, left.find(',')));
      ++found;
      if (left.find(',') == std::string_view::npos) break;
    }
    if (found != count) {
      throw InputError(fmt::format("{}, line {}: there are {} cells, not {} ({}).", path.string(),
                                   line, found, count, columns));
    }
    use(cells, line);
  }
}

// Calls use(record, number) for each record of a binary file, numbers from 0 on.
template <typename Record, typename Use>
void for_records(const fs::path& path, Use&& use) {
  const std::string bytes = read_file(path);
  if (bytes.size() % sizeof(Record) != 0) {
    throw InputError(
        fmt::format("{}: {} bytes are not records of {}; if it is a text its name "
                    "must end in .csv.",
                    path.string(), bytes.size(), sizeof(Record)));
  }
  expect_memory(2.0 * static_cast<double>(bytes.size()), path.string());
  Record record;
  for (std::size_t i = 0; i < bytes.size() / sizeof(Record); ++i) {
    std::memcpy(&record, bytes.data() + i * sizeof(Record), sizeof(Record));
    use(record, i);
  }
}

// A ray that is one. where: "line 3" or "ray 2" of the file.
void expect_ray(const FileRay& ray, const fs::path& path, const std::string& where) {
  const auto fail = [&](const char* what) {
    throw InputError(fmt::format("{}, {}: {}.", path.string(), where, what));
  };
  for (int k = 0; k < 3; ++k) {
    if (!std::isfinite(ray.origin[k])) fail("the origin is not finite");
    if (!std::isfinite(ray.direction[k])) fail("the direction is not finite");
  }
  const double length = glm::length(ray.direction);
  if (!(length > 1e-30 && length < 1e30)) {
    fail("the direction is longer than 1e30 or shorter than 1e-30");
  }
  if (!std::isfinite(ray.t_min)) fail("t_min is not finite");
  if (!(ray.t_max >= ray.t_min)) fail("t_max is less than t_min");
}

template <typename Record>
void append(const Record& record, std::string& bytes) {
  bytes.append(reinterpret_cast<const char*>(&record), sizeof(Record));
}

float single(double value) {
  return static_cast<float>(value);
}

// From which single and double precision read the same number.
std::string digits(float value) {
  return fmt::format("{}", static_cast<double>(value));
}

std::array<float, 3> single(const glm::dvec3& v) {
  return {single(v.x), single(v.y), single(v.z)};
}

}  // namespace

std::vector<FileRay> read_rays(const fs::path& path) {
  std::vector<FileRay> rays;
  const auto add = [&](const std::array<double, 8>& x, const std::string& where) {
    rays.push_back({{x[0], x[1], x[2]}, x[3], {x[4], x[5], x[6]}, x[7]});
    expect_ray(rays.back(), path, where);
  };
  if (is_text(path)) {
    for_lines<8>(path, kRayColumns, [&](const auto& cells, std::size_t line) {
      std::array<double, 8> x{};
      for (std::size_t k = 0; k < 8; ++k) {
        x[k] = number_of_cell(path, line, cells[k]);
      }
      add(x, fmt::format("line {}", line));
    });
  } else {
    for_records<RayRecord>(path, [&](const RayRecord& r, std::size_t number) {
      add({r.origin[0], r.origin[1], r.origin[2], r.t_min, r.direction[0], r.direction[1],
           r.direction[2], r.t_max},
          fmt::format("ray {}", number));
    });
  }
  if (rays.empty()) throw InputError(path.string() + ": there are no rays.");
  return rays;
}

std::vector<FileHit> read_hits(const fs::path& path) {
  std::vector<FileHit> hits;
  if (!is_text(path)) {
    for_records<HitRecord>(path, [&](const HitRecord& r, std::size_t) {
      hits.push_back({r.t, r.u, r.v, r.triangle});
    });
    return hits;
  }
  for_lines<4>(path, kHitColumns, [&](const auto& cells, std::size_t line) {
    FileHit hit;
    if (cells[3] == "-1") {
      hits.push_back(hit);
      return;
    }
    hit.triangle = kSomeTriangle;
    if (!cells[3].empty()) {
      const auto number = parse_number<double>(cells[3]);
      if (!number || !(*number >= 0.0 && *number < kSomeTriangle) ||
          *number != std::floor(*number)) {
        refuse(path, line, cells[3], "the number of a triangle");
      }
      hit.triangle = static_cast<uint32_t>(*number);
    }
    const std::array<double*, 3> numbers{&hit.t, &hit.u, &hit.v};
    for (std::size_t k = 0; k < 3; ++k) {
      if (k > 0 && cells[k].empty()) continue;
      *numbers[k] = number_of_cell(path, line, cells[k]);
    }
    hits.push_back(hit);
  });
  return hits;
}

std::string rays_for(const std::string& name, std::span<const FileRay> rays) {
  std::string content;
  if (is_text(name)) content.append(kRayColumns).append("\n");
  for (const FileRay& ray : rays) {
    const RayRecord r{single(ray.origin), single(ray.t_min), single(ray.direction),
                      single(ray.t_max)};
    if (is_text(name)) {
      const std::array<float, 8> numbers{r.origin[0],    r.origin[1],    r.origin[2],    r.t_min,
                                         r.direction[0], r.direction[1], r.direction[2], r.t_max};
      for (std::size_t k = 0; k < 8; ++k) {
        content += digits(numbers[k]) + (k < 7 ? ',' : '\n');
      }
    } else {
      append(r, content);
    }
  }
  return content;
}

std::string hits_for(const std::string& name, std::span<const FileHit> hits) {
  std::string content;
  if (is_text(name)) content.append(kHitColumns).append("\n");
  for (const FileHit& hit : hits) {
    const HitRecord r{single(hit.t), single(hit.u), single(hit.v), hit.triangle};
    if (!is_text(name)) {
      append(r, content);
    } else if (hit.triangle == NO_TRIANGLE) {
      content += ",,,-1\n";
    } else {
      const auto cell = [](float x) { return std::isnan(x) ? std::string() : digits(x); };
      content += fmt::format("{},{},{},{}\n", digits(r.t), cell(r.u), cell(r.v),
                             hit.triangle == kSomeTriangle ? "" : std::to_string(hit.triangle));
    }
  }
  return content;
}

}  // namespace trisect
