// One Vulkan device for all GPU tests of a process, under the validation layer with
// synchronisation. With TRISECT_TEST_VALIDATION=0 in the environment there is no layer, for
// machines where none can be installed; without it a missing layer is a failure.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "app/bake/bake.h"
#include "app/dispatch/trace_settings.h"
#include "app/dispatch/tracer_kernels.h"
#include "app/frame/frame.h"
#include "vk/device.h"

namespace trisect::test {

// Whether tests run under the layer.
bool validates();

// Without a device, or without the layer, this throws: the test fails and does not pass by.
const gpu::Instance& validated_instance();
const gpu::Device& validated_device();

// A test on the device, which fails on any validation message.
class GpuTest : public ::testing::Test {
 protected:
  void TearDown() override {
    for (const std::string& message : validated_instance().log().messages()) {
      ADD_FAILURE() << "validation: " << message;
    }
  }
};

// The kernels on validated_device() for a scene, without a limit of buffers: made once in a process
// for all scenes of one plan, as a driver takes longer to make them than to trace a small image.
std::shared_ptr<const TracerKernels> shared_kernels(const BakedScene& scene,
                                                    const KernelChoice& choice);

// One frame with AOVs and counts.
Frame trace(const BakedScene& baked, const TraceSettings& settings);

// Expects hits, and that colours and AOVs have the same bits, but for the counts of work. what: for
// messages.
void expect_equal(const Frame& a, const Frame& b, const std::string& what);

// Settings for a small image of a model seen as `trisect render` sees it by default.
TraceSettings framed(const Mesh& mesh, const BakedScene& scene, uint32_t width, uint32_t height,
                     uint32_t rank);

}  // namespace trisect::test
