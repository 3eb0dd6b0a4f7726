// The list of shaders in shaders/CMakeLists.txt has everything that the program asks for by name.
#include "app/buffers/kernels.h"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>
#include <string>

#include "app/dispatch/accel.h"
#include "app/dispatch/ray_caster.h"
#include "app/dispatch/tracer_kernels.h"

namespace trisect {
namespace {

std::set<std::string> listed(Interface interface) {
  std::set<std::string> names;
  for (const KernelSource& source : kernel_sources()) {
    if (source.interface == interface) names.insert(source.name);
  }
  return names;
}

TEST(Kernels, OfFramesAreThoseThatTheTracerAsksFor) {
  std::set<std::string> asked{TracerKernels::kProject, TracerKernels::kBin, TracerKernels::kSky,
                              TracerKernels::kBegin, TracerKernels::kNext};
  for (const Accel accel : {Accel::list, Accel::tiles, Accel::bvh, Accel::rayquery}) {
    for (const uint32_t subgroup_size : {0U, 4U, 8U, 32U}) {
      for (const bool by_address : {false, true}) {
        for (const char* name : tracing_kernels(accel, 1, subgroup_size, by_address)) {
          asked.insert(name);
        }
      }
    }
  }
  EXPECT_EQ(asked, listed(Interface::frame));
}

TEST(Kernels, OfCastRaysAreThoseThatTheCasterAsksFor) {
  EXPECT_EQ((std::set<std::string>{RayCaster::kernel_name(false), RayCaster::kernel_name(true)}),
            listed(Interface::cast));
}

TEST(Kernels, HaveSpirvUnderNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const KernelSource& source : kernel_sources()) {
    EXPECT_TRUE(names.insert(source.name).second) << source.name;
    const std::span<const uint32_t> spirv = spirv_of(source.name);
    EXPECT_EQ(spirv.data(), source.spirv.data()) << source.name;
    ASSERT_GT(spirv.size(), 5U) << source.name;
    EXPECT_EQ(spirv[0], 0x07230203U) << source.name;
    EXPECT_EQ(spirv[1], source.ray_queries ? 0x00010400U : 0x00010300U) << source.name;
  }
}

TEST(Kernels, AreThoseCompiledAnewIfThereAreSuch) {
  const KernelCode code{{"trace_tiles", {1U, 2U, 3U}}};
  EXPECT_EQ(spirv_of("trace_tiles", &code).size(), 3U);
  EXPECT_EQ(spirv_of("trace_list", &code).data(), spirv_of("trace_list").data());
}

TEST(Kernels, OfUnknownNamesAreMistakes) {
  EXPECT_THROW(spirv_of("trace_nothing"), std::logic_error);
  EXPECT_THROW(interface_of("trace_nothing"), std::logic_error);
  EXPECT_THROW(glsl_of("trace_nothing.comp"), std::logic_error);
}

TEST(Kernels, OfOpenGlAreThoseThatItsBackEndAsksFor) {
  for (const char* file :
       {"trace_list.comp", "trace_list.frag", "full_screen.vert", "sky.frag", "tessellated.vert",
        "tessellated.tesc", "tessellated.tese", "tessellated.frag"}) {
    EXPECT_NE(std::string(glsl_of(file)).find("void main()"), std::string::npos) << file;
  }
}

}  // namespace
}  // namespace trisect
