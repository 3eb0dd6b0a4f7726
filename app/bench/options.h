// The command line's values for `trisect bench`, parsed.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/surface/shared.h"
#include "app/surface/surface_choice.h"

namespace trisect {

// Options of commands that time frames of models.
struct TimedModels {
  std::vector<std::string> models;
  uint32_t width = 400;
  uint32_t height = 300;
  uint32_t runs = 5;
  std::string device;
};

struct MeasuredModels : TimedModels {
  std::vector<uint> surfaces{SURFACE_PHONG, SURFACE_SPHERE};
};

struct BenchOptions : MeasuredModels {
  BenchOptions() {
    width = 800;
    height = 600;
  }

  // The most that Embree's flat triangles may be off the surface, over the scene's radius.
  double error = 1e-6;
  std::string json;
};

struct ParetoOptions : MeasuredModels {
  // Of the bisection. The report needs Rank 10.
  std::vector<uint32_t> ranks{4, 6, 8, 10, 12, 14, 18, 24, 30};
  // Flat triangles of a patch: each of its edges is cut into so many.
  std::vector<uint32_t> divisions{1, 2, 4, 8, 16, 32, 64};
  // Flat triangles are also measured as fine as this error demands, over the scene's radius.
  // 0: they are not.
  double finest_error = 1e-6;
  std::string output;  // a folder
  // What `trisect hardcases --json` wrote, for the report to show; empty: nothing.
  std::string hardcases;
  bool plots = true;   // by gnuplot
  bool opengl = true;  // whether OpenGL's tessellation shaders are measured too
};

struct AblationOptions : MeasuredModels {
  std::string output;  // a folder
};

struct ShapeOptions : TimedModels {
  ShapeOptions() {
    width = 800;
    height = 600;
  }

  std::string reference;           // a fine model of the shape
  std::vector<uint32_t> decimate;  // numbers of triangles to which it is decimated as well
  // The most that the triangles by which distances are measured may be off the curved surface, over
  // the shape's radius.
  double error = 1e-4;
  std::string output;  // a folder
  bool plots = true;   // by gnuplot
};

struct TerminatorOptions : TimedModels {
  TerminatorOptions() {
    width = 320;
    height = 240;
  }

  SurfaceChoice surface{SURFACE_PHONG};
  std::vector<double> lights{30.0, 60.0, 90.0, 120.0};  // degrees from the eye
  std::string output;                                   // a folder
  bool plots = true;                                    // by gnuplot
};

struct StabilityOptions {
  uint32_t rays = 100;  // for each value of the parameter that is varied
  std::string output;   // a folder
};

}  // namespace trisect
