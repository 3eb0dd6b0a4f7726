// Contenders that are measured together: in turns, and each against what the oracle sees.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/bench/contender.h"
#include "app/bench/frame_errors.h"
#include "app/cli/statistics.h"
#include "app/mesh/mesh.h"
#include "app/oracle/oracle.h"
#include "app/surface/surface_choice.h"

namespace trisect::bench {

// In pixels.
struct ImageSize {
  uint32_t width;
  uint32_t height;
};

// A baked model with its cages, seen, and what the oracle sees.
struct View {
  BakedScene scene;
  TraceParams params{};
  OracleFrame truth{};
  Frame shown;  // frame_of(truth)
};

// A model with one surface, in both shells.
struct Subject {
  // Reads the model, and has the oracle look at it. Throws InputError.
  Subject(const std::string& file, uint surface_choice, const ImageSize& image_size);

  std::string model;  // its short name
  uint surface;
  ImageSize size;
  Mesh mesh;
  View height;
  View normal;
  // normal's; apart, so that the memory of the others has no tree in it.
  BakedScene with_tree;
};

// The model framed as `trisect render` does. rank: of the bisection.
TraceParams params_of(const Mesh& mesh, const BakedScene& scene, const ImageSize& size, uint solver,
                      uint32_t rank);

// One contender's.
struct Measurement {
  std::string family;  // contenders that differ in one number only
  std::string number;  // such as "Rank 10"; empty if there is none
  Spread ms;
  FrameErrors errors;
  std::size_t bytes = 0;
  WorkCounts work;  // of a frame; 0 if it is not counted
  std::optional<std::size_t> dominated_by;
};

std::size_t wrong_pixels(const Measurement& one);

class Comparison {
 public:
  // The view, by which it is judged, must outlive the field.
  void add(const std::string& family, const std::string& number, const View& view,
           std::unique_ptr<Contender> contender);

  // The frame of one of them, with AOVs.
  void inspect(const std::string& family, const std::string& number, Frame& frame);

  // runs: timed frames of each, after a warm-up. The order is that in which they were added.
  std::vector<Measurement> measure(const std::string& model, uint32_t runs);

 private:
  struct Entry {
    Measurement measurement;
    const View* view;
    std::unique_ptr<Contender> contender;
    std::vector<double> times;
  };
  std::vector<Entry> entries_;
};

}  // namespace trisect::bench
