// The command line's values, parsed.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "app/buffers/kernel_choice.h"
#include "app/crosscheck/tolerance.h"
#include "app/dispatch/backend.h"
#include "app/dispatch/trace_settings.h"
#include "app/frame/image_part.h"
#include "app/mesh/mesh_builder.h"
#include "app/picture/image_file.h"
#include "app/surface/shared.h"

namespace trisect {

// Frames of a sequence, counted from 0, the last one among them.
struct FrameRange {
  uint32_t first = 0;
  uint32_t last = 0;

  bool operator==(const FrameRange&) const = default;
};

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
  std::optional<Accel> accel;  // chosen by the program if not given
  bool evals = false;
  std::optional<glm::dvec3> eye;
  std::optional<glm::dvec3> target;
  glm::dvec3 up{0.0, 1.0, 0.0};
  std::optional<glm::dvec3> light;
  bool shadows = false;
  std::optional<uint> shading;           // SHADING_...; if not given plain
  std::optional<Background> background;  // if not given the sky behind what is lit, else black
  glm::dvec3 background_color{0.0};
  std::optional<glm::dvec3> color;
  double fov = 45.0;
  MeshOptions mesh;
  Backend backend = Backend::vulkan;
  GlPath gl_path = GlPath::compute;
  std::string device;
  bool validation = false;
  std::vector<Aov> aovs;              // of an EXR or PFM; empty: those that each has
  std::optional<ImagePart> tile;      // the part of the image that is rendered; if not given all
  std::optional<uint32_t> turntable;  // frames in which the camera goes around the target
  std::string camera_path;            // a file of keyframes; empty: none
  std::optional<FrameRange> frames;   // those of a sequence that are rendered; if not given all
  bool resume = false;                // leave out the frames whose files are there
  std::string from;                   // a picture whose options come before these; empty: none
  std::optional<uint32_t> runs;  // frames to time, after a warm-up; if not given one without it
  uint32_t spp = 1;              // rays per pixel, a square number
  std::string stats;

  bool operator==(const RenderOptions&) const = default;
};

struct StitchOptions {
  std::vector<std::string> parts;
  std::string output;
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

struct InfoOptions {
  std::string model;
  MeshOptions mesh;
  uint surface = SURFACE_PHONG;
  std::string json;
};

struct ExportOptions {
  std::string model;
  std::string output;
  MeshOptions mesh;
  uint surface = SURFACE_PHONG;
  double alpha = 0.65;
  std::optional<uint32_t> subdivide;  // one of the two is given
  std::optional<double> error;
  std::string json;
};

struct DevicesOptions {
  std::string device;  // empty: all of them
  bool floats = false;
  std::string json;
};

struct HardcasesOptions {
  std::string json;
  Backend backend = Backend::vulkan;
  std::string device;
};

// A model whose numbers are taken in single precision, as other programs hold them.
struct SingleModel {
  std::string file;
  MeshOptions mesh;
  uint surface = SURFACE_PHONG;
  uint shell = SHELL_NORMAL;
  double alpha = 0.65;
};

struct RaysOptions {
  SingleModel model;
  std::string output;
  std::string kind = "all";
  uint32_t count = 1000;  // of each kind
  uint32_t seed = 1;
};

struct CastOptions {
  std::string rays;
  SingleModel model;
  std::string output;
  Backend backend = Backend::vulkan;
  std::string device;
};

struct JudgeOptions {
  std::string rays;
  std::string hits;
  SingleModel model;
  std::string json;
  std::string wrong;
};

struct CrosscheckOptions {
  RenderOptions render;  // output, backend, runs and stats are not used
  std::vector<Backend> backends{Backend::vulkan, Backend::opengl};
  std::string json;
  std::string diff;
};

struct CertifyOptions {
  RenderOptions render;  // output, runs and stats are not used, nor what changes colours alone
  std::string picture;
  std::string json;
};

struct CompareOptions {
  std::string a;
  std::string b;
  Tolerance tolerance{
      .hit_mismatches = 0.0, .patch_mismatches = 0.0, .color_max = 1.0, .alpha_max = 1.0};
  bool exact = false;
  std::string json;
  std::string diff;
};

// "800x600". Throws UsageError, naming the option, for anything else.
void parse_size(const std::string& option, const std::string& text, uint32_t& width,
                uint32_t& height);

// "1,-2.5,3e2". Throws UsageError, naming the option, for anything but three numbers of at most
// 1e12.
glm::dvec3 parse_triple(const std::string& option, const std::string& text);

// The same, not all 0.
glm::dvec3 parse_direction(const std::string& option, const std::string& text);

// "0.5,0.7,1": a colour. Throws UsageError, naming the option, for anything but three numbers from
// 0 to 1.
// or_else: what else the option takes, for the message.
glm::dvec3 parse_color(const std::string& option, const std::string& text,
                       const std::string& or_else = "");

// A background as --background has it.
std::string background_text(Background background, const glm::dvec3& color);

// "color,Z": what an image file has of each pixel. Throws UsageError, naming the option, for
// anything but names of color, Z, N, G, patch, uv, P, evals, none of them twice.
std::vector<Aov> parse_aovs(const std::string& option, const std::string& text);

// The names as --aov has them.
std::string aovs_text(const std::vector<Aov>& aovs);

// "0:59" or "7". Throws UsageError, naming the option, for anything else.
FrameRange parse_frames(const std::string& option, const std::string& text);

// "0,0,100,50": x and y of the top left pixel, width and height. Throws UsageError, naming the
// option, for anything else and for a part that is not in an image of that size.
ImagePart parse_part(const std::string& option, const std::string& text, uint32_t image_width,
                     uint32_t image_height);

// The part as parse_part() reads it.
std::string part_text(const ImagePart& part);

// The back end of that name. Throws UsageError, naming the option, if there is none.
Backend backend_named(const std::string& option, std::string_view name);

// "vulkan,opengl": two or more, none twice. Throws UsageError, naming the option, for anything
// else.
std::vector<Backend> parse_backends(const std::string& option, const std::string& text);

// "color_rmse=0.5": changes that member. Throws UsageError, naming the option, for anything else.
void parse_threshold(const std::string& option, const std::string& text, Tolerance& tolerance);

}  // namespace trisect
