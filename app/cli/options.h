// The command line's values, parsed.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/kernel_choice.h"
#include "app/shared.h"
#include "app/tolerance.h"

namespace trisect {

// Who traces.
enum class Backend { vulkan, opengl, cpu, oracle };

// How OpenGL traces: the kernel of Vulkan, or the thesis's full-screen quad.
enum class GlPath { compute, fragment };

// The most pixels of an image's side, and rays in a row of them.
constexpr uint32_t kLargestSide = 16384;

struct RenderOptions {
  std::string model;
  std::string output;
  uint32_t width = 800;
  uint32_t height = 600;
  uint surface = SURFACE_PHONG;
  uint shell = SHELL_NORMAL;
  double alpha = 0.65;
  uint solver = SOLVER_ROBUST;
  uint32_t rank = 10;
  std::optional<Accel> accel;  // by itself if not given
  bool evals = false;
  std::optional<glm::dvec3> eye;
  std::optional<glm::dvec3> target;
  glm::dvec3 up{0.0, 1.0, 0.0};
  std::optional<glm::dvec3> light;
  bool shadows = false;
  double fov = 45.0;
  std::optional<double> crease;
  Backend backend = Backend::vulkan;
  GlPath gl_path = GlPath::compute;
  std::string device;
  bool validation = false;
  uint32_t runs = 1;
  uint32_t spp = 1;  // rays a pixel: a square number
  std::string stats;

  bool operator==(const RenderOptions&) const = default;
};

struct ViewOptions {
  RenderOptions
      render;          // width and height are the window's; its output, runs and stats mean nothing
  std::string assets;  // folder of the models to choose from
  std::string shaders;             // folder of the shaders' sources
  bool watch = false;              // recompiles them when they change
  double frame_ms = 33.0;          // that a frame may take while something moves
  std::optional<uint64_t> frames;  // ends after so many
  std::string screenshot;          // written at the end
  std::string script;
  std::string stats;
};

struct AccuracyOptions {
  std::vector<std::string> models;
  std::vector<uint> surfaces{SURFACE_PHONG, SURFACE_SPHERE};
  std::vector<uint> shells{SHELL_NORMAL, SHELL_HEIGHT};
  uint32_t width = 800;
  uint32_t height = 600;
  double alpha = 0.65;
  std::string device;
  std::string json;
};

// What commands have that time frames of models.
struct MeasuredModels {
  std::vector<std::string> models;
  std::vector<uint> surfaces{SURFACE_PHONG, SURFACE_SPHERE};
  uint32_t width = 400;
  uint32_t height = 300;
  uint32_t runs = 5;
  std::string device;
};

struct BenchOptions : MeasuredModels {
  BenchOptions() {
    width = 800;
    height = 600;
  }

  // That Embree's flat triangles may be off the surface, over the scene's radius.
  double error = 1e-6;
  std::string json;
};

struct ParetoOptions : MeasuredModels {
  std::vector<uint32_t> ranks{4, 6, 8, 10, 12, 14, 18, 24, 30};  // of the bisection; 10 among them
  std::vector<uint32_t> divisions{1, 2, 4, 8, 16, 32, 64};       // of flat triangles' edges
  // Flat triangles are tried as fine as this error asks for, too; 0: they are not.
  double finest_error = 1e-6;
  std::string output;  // a folder
  // What `trisect hardcases --json` wrote, for the report to show; empty: nothing.
  std::string hardcases;
};

struct AblationOptions : MeasuredModels {
  std::string output;  // a folder
};

struct StabilityOptions {
  uint32_t rays = 100;  // for every value of what is varied
  std::string output;   // a folder
};

struct HardcasesOptions {
  std::string json;
  Backend backend = Backend::vulkan;
  std::string device;
};

struct CrosscheckOptions {
  RenderOptions render;  // of which output, backend, runs and stats mean nothing
  std::vector<Backend> backends{Backend::vulkan, Backend::opengl};
  std::string json;
  std::string diff;
};

struct CompareOptions {
  std::string a;
  std::string b;
  Tolerance tolerance{0.0, 0.0, Tolerance::kAny, Tolerance::kAny, 1.0};
  std::string json;
  std::string diff;
};

// The names that the command line and the JSON use.
const char* surface_name(uint surface);
const char* shell_name(uint shell);
const char* solver_name(uint solver);
const char* backend_name(Backend backend);

// "800x600". Throws UsageError, naming the option, for anything else.
void parse_size(const std::string& option, const std::string& text, uint32_t& width,
                uint32_t& height);

// "1,-2.5,3e2". Throws UsageError, naming the option, for anything but three numbers of at most
// 1e12.
glm::dvec3 parse_triple(const std::string& option, const std::string& text);

// The same, not all 0.
glm::dvec3 parse_direction(const std::string& option, const std::string& text);

// The back end of that name. Throws UsageError, naming the option, if there is none.
Backend backend_named(const std::string& option, std::string_view name);

// "vulkan,opengl": two or more, none twice. Throws UsageError, naming the option, for anything
// else.
std::vector<Backend> parse_backends(const std::string& option, const std::string& text);

// "color_rmse=0.5": changes that member. Throws UsageError, naming the option, for anything else.
void parse_threshold(const std::string& option, const std::string& text, Tolerance& tolerance);

}  // namespace trisect
