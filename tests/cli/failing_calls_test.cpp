// The program on a driver whose calls fail, one at a time: VK_LAYER_TRISECT_fault is put between.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/program.h"

namespace trisect {
namespace {

// A run with one call failing, see tests/layer/fault_layer.cpp.
class FailingCalls : public test::Program {
 protected:
  test::ProgramRun render(const std::string& fault) {
    std::vector<std::string> environment = test::layer_environment("fault");
    environment.push_back("TRISECT_TEST_FAIL=" + fault);
    return test::run_trisect(
        {"render", test::asset_path("sphere-20"), "--size", "32x24", "-o", folder_ / "a.png"},
        environment);
  }
};

TEST_F(FailingCalls, AreComplainedOf) {
  expect_complaint(render("vkCreateInstance:1:VK_ERROR_OUT_OF_HOST_MEMORY"), 4, "vkCreateInstance");
  expect_complaint(render("vkAllocateMemory:3:VK_ERROR_OUT_OF_DEVICE_MEMORY"), 4, "buffer");
}

TEST_F(FailingCalls, AreNoneIfTheProgramMakesFewer) {
  EXPECT_EQ(render("vkCreateInstance:2:VK_ERROR_OUT_OF_HOST_MEMORY").exit_code, 0);
}

}  // namespace
}  // namespace trisect
