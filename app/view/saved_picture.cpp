#include "app/view/saved_picture.h"

#include <utility>

#include "app/base/atomic_file.h"
#include "app/cli/load_scene.h"
#include "app/cli/picture_contents.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/vulkan_tracer.h"
#include "app/frame/supersampling.h"
#include "app/picture/image_file.h"

namespace trisect::view {

void save_picture(const gpu::Device& device, const LoadedModel& model, const RenderOptions& options,
                  const std::string& file) {
  const ImageFormat format = image_format(file);
  const PictureContents picture(format, options);
  AtomicFile target(file);
  const BakedScene& scene = model.scene();
  const AccelRequest request = accel_request(options, device.subgroup_size() != 0);
  const TraceSettings settings = settings_of(options, model.mesh(), scene);
  const TraceParams params = make_params(scene, settings);
  const Accel accel = accel_at_hand(request, scene);
  VulkanTracer tracer(device, scene, params.width, params.height,
                      {.solver = options.solver,
                       .aovs = picture.needs_aovs(),
                       .accel = accel,
                       .shadows = options.shadows});
  Frame frame;
  tracer.render(params, frame);
  frame = averaged(std::move(frame), samples_across(options.spp));
  const PictureSource source{settings, accel, model.file().sha256, device.report().name,
                             device.report().driver};
  write_image(frame, format, target, picture.of(frame, options, source));
  target.commit();
}

}  // namespace trisect::view
