#include "app/view/flags.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>

#include "app/base/error.h"

namespace trisect::view {
namespace {

uint64_t bits(double value) {
  return std::bit_cast<uint64_t>(value);
}

void expect_same(const glm::dvec3& a, const glm::dvec3& b) {
  for (int i = 0; i < 3; ++i) EXPECT_EQ(bits(a[i]), bits(b[i])) << a[i] << " and " << b[i];
}

void expect_same(const std::optional<glm::dvec3>& a, const std::optional<glm::dvec3>& b) {
  ASSERT_EQ(a.has_value(), b.has_value());
  if (a) expect_same(*a, *b);
}

// Compares what flags_of() writes, bit for bit.
void expect_same(const RenderOptions& a, const RenderOptions& b) {
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.surface, b.surface);
  EXPECT_EQ(a.shell, b.shell);
  EXPECT_EQ(bits(a.alpha), bits(b.alpha)) << a.alpha;
  EXPECT_EQ(a.solver, b.solver);
  EXPECT_EQ(a.rank, b.rank);
  EXPECT_EQ(a.accel, b.accel);
  expect_same(a.eye, b.eye);
  expect_same(a.target, b.target);
  expect_same(a.up, b.up);
  expect_same(a.light, b.light);
  EXPECT_EQ(a.shadows, b.shadows);
  EXPECT_EQ(a.shading, b.shading);
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.background, b.background);
  EXPECT_EQ(a.background_color, b.background_color);
  EXPECT_EQ(bits(a.fov), bits(b.fov)) << a.fov;
  ASSERT_EQ(a.mesh.crease_degrees.has_value(), b.mesh.crease_degrees.has_value());
  if (a.mesh.crease_degrees) {
    EXPECT_EQ(bits(*a.mesh.crease_degrees), bits(*b.mesh.crease_degrees));
  }
  EXPECT_EQ(bits(a.mesh.weld), bits(b.mesh.weld)) << a.mesh.weld;
  EXPECT_EQ(a.mesh.repair, b.mesh.repair);
  EXPECT_EQ(a.spp, b.spp);
}

void expect_round_trip(const RenderOptions& options) {
  const std::string text = flags_of(options);
  SCOPED_TRACE(text);
  expect_same(with_flags(RenderOptions{}, text), options);
}

// The message of the error, empty if there is none.
std::string refusal(const std::string& text, const RenderOptions& base = {}) {
  try {
    with_flags(base, text);
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

// A value other than the default for every option of the robust solver.
RenderOptions all_options() {
  RenderOptions options;
  options.width = 1;
  options.height = 16384;
  options.surface = SURFACE_SPHERE;
  options.alpha = 1.0 / 3.0;
  options.shell = SHELL_HEIGHT;
  options.accel = Accel::bvh;
  options.eye = glm::dvec3(-1.0 / 3.0, 0.1, 1e-300);
  options.target = glm::dvec3(-0.0, -1e12, 5e-324);
  options.up = glm::dvec3(-0.1, -0.2, 0.1 + 0.2);
  options.light = glm::dvec3(-1.0, 2.0, -3.0);
  options.shadows = true;
  options.shading = SHADING_GRID;
  options.color = glm::dvec3(0.1, 0.0, 1.0);
  options.background = Background::color;
  options.background_color = glm::dvec3(1.0 / 3.0, 0.5, 1.0);
  options.fov = 100.0 / 3.0;
  options.mesh = {0.1, 1e-7, true};
  options.spp = 16;
  return options;
}

TEST(Flags, OfTheDefaultsAreFew) {
  EXPECT_EQ(flags_of(RenderOptions{}),
            "--size 800x600 --surface phong --alpha 0.65 --shell normal --solver robust --fov 45");
}

TEST(Flags, AreShort) {
  EXPECT_EQ(flags_of(all_options()),
            "--size 1x16384 --surface sphere --alpha 0.3333333333333333 --shell height "
            "--solver robust --accel bvh --eye -0.3333333333333333,0.1,1e-300 "
            "--target -0,-1000000000000,5e-324 --up -0.1,-0.2,0.30000000000000004 "
            "--fov 33.333333333333336 --light -1,2,-3 --shadows --shading grid --color 0.1,0,1 "
            "--background 0.3333333333333333,0.5,1 --spp 16 --crease 0.1 --weld 1e-07 "
            "--repair");
}

TEST(Flags, ReadBackBitForBit) {
  expect_round_trip(RenderOptions{});
  expect_round_trip(all_options());
  RenderOptions options;
  options.surface = SURFACE_FLAT;
  options.solver = SOLVER_BISECT;
  options.rank = 60;
  expect_round_trip(options);
  options.accel = Accel::list;
  expect_round_trip(options);
  // flags_of() writes no Rank for the robust solver.
  options.solver = SOLVER_ROBUST;
  options.rank = RenderOptions{}.rank;
  for (const Accel accel : {Accel::tiles, Accel::bvh}) {
    options.accel = accel;
    expect_round_trip(options);
  }
  for (const double alpha : {-0.0, -1.0 / 3.0, 1e-300, -5e-324, 999.9999999999999, 1e-5}) {
    options.alpha = alpha;
    expect_round_trip(options);
  }
  options.up = glm::dvec3(-0.0, 1.0, 0.0);  // equal to the default, but not the same
  expect_round_trip(options);
}

// Numbers whose shortest texts become other doubles if they are rounded to long double first.
TEST(Flags, ReadBackWhatIsRoundedTwice) {
  RenderOptions options;
  options.alpha = 0.4286789683249492;
  options.fov = 5.359060314708882;
  options.mesh.crease_degrees = 5.359060314708882;
  expect_round_trip(options);
}

TEST(Flags, ReadBackAnyNumbers) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> from_0_to_1(0.0, 1.0);
  const auto point = [&] {
    const double size = std::exp2(40.0 * from_0_to_1(random) - 20.0);
    const double x = from_0_to_1(random) - 0.5;
    const double y = from_0_to_1(random) - 0.5;
    const double z = from_0_to_1(random) - 0.5;
    return size * glm::dvec3(x, y, z);
  };
  for (int i = 0; i < 300; ++i) {
    RenderOptions options;
    options.alpha = 2000.0 * from_0_to_1(random) - 1000.0;
    options.eye = point();
    options.target = point();
    options.up = point();
    options.light = point();
    options.fov = 1.0 + 169.0 * from_0_to_1(random);
    options.mesh.crease_degrees = 180.0 * from_0_to_1(random);
    expect_round_trip(options);
  }
}

TEST(WithFlags, TakesTheLineOfACommand) {
  const RenderOptions options = with_flags(
      RenderOptions{},
      "trisect render m.obj -o a.png --eye 1,-2,3 \n\t --target -4,5,-6.5 --light=-1,0,1 "
      "--alpha -0.5 --up 0,0,1 --solver bisect --rank 12 --accel list --size 64x48 --fov 30\n");
  RenderOptions expected;
  expected.eye = glm::dvec3(1.0, -2.0, 3.0);
  expected.target = glm::dvec3(-4.0, 5.0, -6.5);
  expected.light = glm::dvec3(-1.0, 0.0, 1.0);
  expected.alpha = -0.5;
  expected.up = glm::dvec3(0.0, 0.0, 1.0);
  expected.solver = SOLVER_BISECT;
  expected.rank = 12;
  expected.accel = Accel::list;
  expected.width = 64;
  expected.height = 48;
  expected.fov = 30.0;
  expect_same(options, expected);
  EXPECT_EQ(options.model, "");
  EXPECT_EQ(options.output, "");
}

TEST(WithFlags, IgnoresModelAndOutput) {
  RenderOptions base;
  base.model = "base.obj";
  base.output = "base.png";
  for (const char* text :
       {"--fov 30", "m.obj --fov 30", "--fov 30 m.obj", "--output a.png --fov 30",
        "build/release/trisect render m.obj --fov 30 -o a.exr", "trisect render --fov 30"}) {
    const RenderOptions options = with_flags(base, text);
    EXPECT_EQ(options.fov, 30.0) << text;
    EXPECT_EQ(options.model, "base.obj") << text;
    EXPECT_EQ(options.output, "base.png") << text;
  }
}

TEST(WithFlags, KeepsWhatIsNotSaid) {
  const RenderOptions base = all_options();
  for (const char* text : {"", " \n", "trisect render m.obj"}) {
    RenderOptions expected = base;
    expected.shadows = false;
    expected.spp = 1;
    expected.accel.reset();
    expected.shading.reset();
    expected.color.reset();
    expected.background.reset();
    expected.background_color = glm::dvec3(0.0);
    expect_same(with_flags(base, text), expected);
  }
  RenderOptions bisecting;
  bisecting.solver = SOLVER_BISECT;
  bisecting.rank = 20;
  expect_same(with_flags(bisecting, ""), bisecting);
}

TEST(WithFlags, GoesBackToWhatIsTheDefault) {
  RenderOptions base = all_options();
  base.solver = SOLVER_BISECT;
  const RenderOptions options =
      with_flags(base, "--accel auto --solver robust --shell normal --surface phong");
  EXPECT_EQ(options.accel, std::nullopt);
  EXPECT_EQ(options.solver, SOLVER_ROBUST);
  EXPECT_EQ(options.shell, SHELL_NORMAL);
  EXPECT_EQ(options.surface, SURFACE_PHONG);
}

TEST(WithFlags, PresetSetsTheRank) {
  RenderOptions base;
  base.rank = 20;
  const RenderOptions thesis = with_flags(base, "--preset thesis");
  EXPECT_EQ(thesis.shell, SHELL_HEIGHT);
  EXPECT_EQ(thesis.solver, SOLVER_BISECT);
  EXPECT_EQ(thesis.rank, 10U);
  EXPECT_EQ(with_flags(base, "--rank 12 --preset thesis").rank, 12U);
}

TEST(WithFlags, OfTwoTakesTheLast) {
  const RenderOptions options =
      with_flags(RenderOptions{},
                 "--fov 30 --spp 4 --rank 5 --eye 1,2,3 --fov 40 --spp 9 --rank 6 --eye 4,5,6");
  EXPECT_EQ(options.fov, 40.0);
  EXPECT_EQ(options.spp, 9U);
  EXPECT_EQ(options.rank, 6U);
  EXPECT_EQ(options.eye, glm::dvec3(4.0, 5.0, 6.0));
}

TEST(WithFlags, NamesWhatIsWrong) {
  EXPECT_EQ(refusal("--fov 45"), "");
  EXPECT_EQ(refusal("--fov 200"), "--fov: '200' is not a number from 1 to 170");
  EXPECT_EQ(refusal("--surface round"), "--surface: 'round' is not one of: flat, phong, sphere");
  EXPECT_EQ(refusal("--eye 1,2"),
            "--eye: '1,2' is not three numbers such as 1,2.5,-3 of at most 1e+12.");
  EXPECT_EQ(refusal("--eye"), "--eye: 1 required X,Y,Z missing");
  EXPECT_EQ(refusal("--light 0,0,0"), "--light: 0,0,0 is no direction.");
  EXPECT_EQ(refusal("--size 0x5"),
            "--size: '0x5' is not a size such as 800x600 (1 to 16384 pixels a side).");
  EXPECT_NE(refusal("--spp 2").find("--spp"), std::string::npos);
  EXPECT_EQ(refusal("--fow 45"), "The following argument was not expected: --fow");
  for (const char* word : {"--help", "-h", "--version", "--evals", "--validation", "-x"}) {
    EXPECT_EQ(refusal(word), std::string("The following argument was not expected: ") + word);
  }
  EXPECT_EQ(refusal("a.obj b.obj"), "The following argument was not expected: b.obj");
}

TEST(WithFlags, RefusesShadowsOfTheBisection) {
  const char* message = "--shadows: it needs --solver robust.";
  EXPECT_EQ(refusal("--solver bisect --shadows"), message);
  EXPECT_EQ(refusal("--shadows --preset thesis"), message);
  RenderOptions base;
  base.solver = SOLVER_BISECT;
  EXPECT_EQ(refusal("--shadows", base), message);
  EXPECT_EQ(refusal("--shadows --solver robust", base), "");
}

}  // namespace
}  // namespace trisect::view
