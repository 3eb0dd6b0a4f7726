// Frames are compared with small frames in the repository. scripts/update-golden.sh makes these
// anew, for a change that is meant to change the pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "app/base/srgb.h"
#include "app/cli/data_folder.h"
#include "app/picture/image_file.h"
#include "tests/support/exr_reader.h"
#include "tests/support/frame_difference.h"
#include "tests/support/gpu.h"
#include "tests/support/scenes.h"

namespace trisect {
namespace {

struct Golden {
  const char* model;
  uint surface;
  const char* surface_name;
};

class GoldenFrame : public test::GpuTest, public ::testing::WithParamInterface<Golden> {};

// As `trisect render --preset thesis --size 48x36 --rank 24` makes it.
Frame fresh(const Golden& golden) {
  const Mesh mesh = test::load_asset(golden.model);
  const BakedScene scene = bake(mesh, {golden.surface, 0.65, SHELL_HEIGHT});
  TraceSettings settings = test::framed(mesh, scene, 48, 36, 24);
  settings.shading = SHADING_GRID;
  settings.color = standard_color(SHADING_GRID);
  return test::trace(scene, settings);
}

// A message about the first difference of a frame from a golden one, or nothing. `kept` is from a
// file, so its colours are linear light.
std::string complaint(const Frame& kept, Frame frame) {
  for (vec4& color : frame.colors) {
    for (int k = 0; k < 3; ++k) color[k] = linear_from_srgb(color[k]);
  }
  const test::FrameDifference d = test::difference(kept, frame);
  if (!d.same_size) return "size";
  if (d.hit_mismatches > 0) return "hits";
  if (d.patch_mismatches > 0) return "patches";
  // Another driver may round differently: in single precision at depths of up to 12, and at rank 24
  // the bisection's last steps depend on the field's rounding errors of about 1e-6.
  if (!(d.depth <= 2e-5)) return "depth";
  if (!(d.weights <= 2e-4)) return "weights";
  if (!(d.normal_degrees <= 0.02)) return "normals";
  // One of 256 steps of a colour: at the border of a grid line a change of depth of 2e-5 changes
  // the colour by 1e-3.
  if (!(d.color <= 4e-3)) return "colour";
  return "";
}

TEST_P(GoldenFrame, IsReproduced) {
  const Golden& golden = GetParam();
  const std::string name = std::string(golden.model) + "-" + golden.surface_name + ".exr";
  EXPECT_EQ(complaint(test::read_exr(data_folder("golden", TRISECT_GOLDEN) / name), fresh(golden)),
            "");
}

INSTANTIATE_TEST_SUITE_P(Assets, GoldenFrame,
                         ::testing::Values(Golden{"sphere-20", SURFACE_PHONG, "phong"},
                                           Golden{"sphere-20", SURFACE_SPHERE, "sphere"},
                                           Golden{"torus", SURFACE_PHONG, "phong"},
                                           Golden{"saddle", SURFACE_FLAT, "flat"}),
                         [](const ::testing::TestParamInfo<Golden>& golden) {
                           std::string name =
                               std::string(golden.param.model) + "_" + golden.param.surface_name;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// The comparison notices a difference of any kind in a single pixel.
class GoldenComparison : public test::GpuTest {};

TEST_F(GoldenComparison, NoticesOnePixel) {
  const Golden golden{"sphere-20", SURFACE_PHONG, "phong"};
  const Frame kept = test::read_exr(data_folder("golden", TRISECT_GOLDEN) / "sphere-20-phong.exr");
  const Frame rendered = fresh(golden);
  const std::size_t middle = 18 * 48 + 24;
  ASSERT_NE(rendered.aovs[middle].triangle, NO_TRIANGLE);
  const auto changed = [&](auto change) {
    Frame frame = rendered;
    change(frame.colors[middle], frame.aovs[middle]);
    return complaint(kept, frame);
  };
  EXPECT_EQ(complaint(kept, rendered), "");
  EXPECT_EQ(changed([](vec4&, PixelAovs& aov) { aov.triangle = NO_TRIANGLE; }), "hits");
  EXPECT_EQ(changed([](vec4& color, PixelAovs&) { color.w = 0.0F; }), "hits");
  EXPECT_EQ(changed([](vec4&, PixelAovs& aov) { ++aov.triangle; }), "patches");
  EXPECT_EQ(changed([](vec4&, PixelAovs& aov) { aov.normal_z.w += 1e-4F; }), "depth");
  EXPECT_EQ(changed([](vec4&, PixelAovs& aov) { aov.normal_z.x += 0.001F; }), "normals");
  EXPECT_EQ(changed([](vec4&, PixelAovs& aov) { aov.geometric_u.y += 0.001F; }), "normals");
  EXPECT_EQ(changed([](vec4&, PixelAovs& aov) { aov.geometric_u.w += 0.001F; }), "weights");
  EXPECT_EQ(changed([](vec4&, PixelAovs& aov) { aov.v += 0.001F; }), "weights");
  EXPECT_EQ(changed([](vec4& color, PixelAovs&) { color.y -= 0.01F; }), "colour");
  const float nan = std::nanf("");
  EXPECT_EQ(changed([&](vec4&, PixelAovs& aov) { aov.normal_z.w = nan; }), "depth");
  EXPECT_EQ(changed([&](vec4& color, PixelAovs&) { color.x = nan; }), "colour");
  Frame narrow = rendered;
  narrow.width -= 1;
  EXPECT_EQ(complaint(kept, narrow), "size");
}

}  // namespace
}  // namespace trisect
