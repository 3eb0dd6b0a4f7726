#include "app/view/saved_picture.h"

#include <utility>

#include "app/base/atomic_file.h"
#include "app/cli/load_scene.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/frame/supersampling.h"
#include "app/picture/image_file.h"

namespace trisect::view {

void save_picture(const gpu::Device& device, const Mesh& mesh, const BakedScene& scene,
                  const RenderOptions& options, const std::string& file) {
  const ImageFormat format = image_format(file);
  AtomicFile target(file);
  const AccelRequest request = accel_request(options, device.subgroup_size() != 0);
  const TraceParams params = make_params(scene, settings_of(options, mesh, scene));
  VulkanTracer tracer(device, scene, params.width, params.height,
                      {.solver = options.solver,
                       .aovs = format == ImageFormat::exr,
                       .accel = accel_at_hand(request, scene),
                       .shadows = options.shadows});
  Frame frame;
  tracer.render(params, frame);
  frame = averaged(std::move(frame), samples_across(options.spp));
  write_image(frame, format, target, {.alpha = options.background == Background::none});
  target.commit();
}

}  // namespace trisect::view
