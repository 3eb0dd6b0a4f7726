// One Vulkan device for all GPU tests of a process, under the validation layer with
// synchronisation. With TRISECT_TEST_VALIDATION=0 in the environment there is no layer, for
// machines where none can be installed; without it a missing layer is a failure.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <string>

#include "app/bake/bake.h"
#include "app/buffers/buffer_limits.h"
#include "app/dispatch/trace_settings.h"
#include "app/dispatch/vulkan_tracer.h"
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

// A tracer of a scene. On validated_device(), and without a limit of buffers, all scenes of one
// plan share their kernels while the process lives: a driver takes longer to make them than to
// trace a small image.
VulkanTracer tracer_of(const BakedScene& scene, uint32_t width, uint32_t height,
                       const KernelChoice& choice, std::size_t buffer_limit = kNoLimit,
                       const gpu::Device& device = validated_device());

// One frame with AOVs and counts.
Frame trace(const BakedScene& baked, const TraceSettings& settings);

// Expects hits, and that colours and AOVs have the same bits, but for the counts of work. what: for
// messages.
void expect_equal(const Frame& a, const Frame& b, const std::string& what);

// Settings for a small image of a model seen as `trisect render` sees it by default.
TraceSettings framed(const Mesh& mesh, const BakedScene& scene, uint32_t width, uint32_t height,
                     uint32_t rank);

}  // namespace trisect::test
