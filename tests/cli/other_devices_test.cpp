// The program on devices that compute in another way: a Vulkan layer rewrites the kernels
// (layer/device_layer.cpp).
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <vector>

#include "tests/support/exr_reader.h"
#include "tests/support/run_program.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace trisect::test {
namespace {

struct OtherDevice {
  const char* name;
  const char* variable;  // of the layer's environment
  // By how many ulp the accelerations' Z may be apart. Vulkan promises the same results in all
  // kernels but where a device fuses, against NoContraction, other operations in each: roots of
  // Newton's method are then apart by the roundings of a few operations on numbers up to the
  // scene's distance. 28 were seen at most; a wrong root is thousands away.
  int64_t ulps_apart;
};

std::string name_of(const ::testing::TestParamInfo<OtherDevice>& device) {
  return device.param.name;
}

std::ostream& operator<<(std::ostream& out, const OtherDevice& device) {
  return out << device.name;
}

// The distance of two floats of the same sign in units of the last place.
int64_t ulps_between(float a, float b) {
  return std::abs(int64_t{std::bit_cast<int32_t>(a)} - int64_t{std::bit_cast<int32_t>(b)});
}

class OtherDevices : public ::testing::TestWithParam<OtherDevice> {
 protected:
  [[nodiscard]] static ProgramRun run(const std::vector<std::string>& arguments) {
    std::vector<std::string> environment = layer_environment("device");
    environment.emplace_back(GetParam().variable);
    return run_trisect(arguments, environment);
  }
};

TEST_P(OtherDevices, MakeTheSamePictureByEveryAcceleration) {
  const TemporaryFolder folder;
  for (const char* asset : {"sphere-320", "teapot"}) {
    const auto frame_by = [&](const std::string& accel) {
      const std::string file = folder / (std::string(asset) + accel + ".exr");
      const ProgramRun made =
          run({"render", asset_path(asset), "-o", file, "--accel", accel, "--size", "96x72"});
      EXPECT_EQ(made.exit_code, 0) << made.err;
      return read_exr(file);
    };
    const Frame list = frame_by("list");
    for (const char* accel : {"tiles", "bvh"}) {
      const Frame other = frame_by(accel);
      ASSERT_EQ(other.aovs.size(), list.aovs.size());
      int64_t apart = 0;
      for (std::size_t i = 0; i < list.aovs.size(); ++i) {
        ASSERT_EQ(other.aovs[i].triangle, list.aovs[i].triangle) << asset << ' ' << accel;
        apart = std::max(apart, ulps_between(other.aovs[i].normal_z.w, list.aovs[i].normal_z.w));
      }
      EXPECT_LE(apart, GetParam().ulps_apart) << asset << ' ' << accel;
    }
  }
}

TEST_P(OtherDevices, AreAsAccurateAsPromised) {
  const ProgramRun judged = run({"accuracy", asset_path("torus"), asset_path("saddle"), "--size",
                                 "60x45", "--shell", "normal"});
  EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
}

#ifdef TRISECT_SLOW
TEST_P(OtherDevices, PassTheHardCases) {
  const ProgramRun judged = run({"hardcases"});
  EXPECT_EQ(judged.exit_code, 0) << judged.out << judged.err;
}
#endif

INSTANTIATE_TEST_SUITE_P(
    All, OtherDevices,
    ::testing::Values(OtherDevice{"InexactDivision", "TRISECT_TEST_ULPS=1", 0},
                      OtherDevice{"FusedOperations", "TRISECT_TEST_FUSED=50", 32},
                      OtherDevice{"FewerLanesThanReported", "TRISECT_TEST_LANES=32", 0}),
    name_of);

}  // namespace
}  // namespace trisect::test
