// Contenders that are timed in turns, and whose frames are compared with the oracle's.
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

// A baked model with its subpatch bounds, its camera, and the oracle's frame.
struct View {
  BakedScene scene;
  TraceParams params{};
  OracleFrame truth{};
  Frame shown;  // frame_of(truth)
};

// A model with one surface, in both shells.
struct Subject {
  // Reads and bakes the model, and traces it with the oracle. Throws InputError.
  Subject(const std::string& file, uint surface_choice, const ImageSize& image_size);

  std::string model;  // its short name
  uint surface;
  ImageSize size;
  Mesh mesh;
  View height;  // without a tree
  View normal;  // with a tree
};

// The model framed as `trisect render` does. rank: of the bisection.
TraceParams params_of(const Mesh& mesh, const BakedScene& scene, const ImageSize& size, uint solver,
                      uint32_t rank);

// What is measured of one contender.
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
  // view: its truth judges the contender. It must outlive this object.
  void add(const std::string& family, const std::string& number, const View& view,
           std::unique_ptr<Contender> contender);

  // Renders the contender of this family and number, with AOVs, into `frame`.
  void inspect(const std::string& family, const std::string& number, Frame& frame);

  // Measures all contenders, in the order in which they were added. runs: timed frames of each,
  // after a warm-up. The contenders take turns, so that other load on the machine affects all
  // alike.
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
