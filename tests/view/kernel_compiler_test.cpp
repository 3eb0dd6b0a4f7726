// The window compiles the kernels of a frame, from the sources that the build has them from.
#include "app/view/kernel_compiler.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "app/buffers/kernels.h"

namespace trisect {
namespace {

TEST(KernelCompiler, CompilesTheFrameKernelsOfTheList) {
  const KernelCode code = view::compile_kernels(TRISECT_SOURCES "/shaders");
  std::set<std::string> compiled;
  for (const auto& [name, spirv] : code) {
    compiled.insert(name);
    // The same kernel for the same version of SPIR-V. Beyond that the two compilers may differ.
    ASSERT_GT(spirv.size(), 5U) << name;
    EXPECT_EQ(spirv[1], spirv_of(name)[1]) << name;
  }
  std::set<std::string> listed;
  for (const KernelSource& source : kernel_sources()) {
    if (source.interface == Interface::frame) listed.insert(source.name);
  }
  EXPECT_EQ(compiled, listed);
  // The preamble is there: these two differ in nothing else.
  EXPECT_NE(code.at("trace_bvh"), code.at("trace_bvh_at"));
}

}  // namespace
}  // namespace trisect
