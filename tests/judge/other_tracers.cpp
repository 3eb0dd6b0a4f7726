// Ray tracers of others, for `trisect judge` to judge, and an example of how to let it judge one's
// own:
//   other-tracers embree RAYS MODEL HITS          Embree's triangles
//   other-tracers embree-robust RAYS MODEL HITS   the same with RTC_SCENE_FLAG_ROBUST
//   other-tracers opengl MODEL RAYS HITS          OpenGL's rasteriser: writes the rays of an image,
//                                                 from the eye, and what it drew there
// The triangles are flat.
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/bake/bake.h"
#include "app/dispatch/trace_settings.h"
#include "app/judge/ray_file.h"
#include "app/mesh/mesh_builder.h"
#include "app/mesh/model_file.h"
#include "app/opengl/context.h"
#include "app/opengl/rasterizer.h"
#include "app/oracle/oracle_tracer.h"

namespace {

using namespace trisect;  // NOLINT(google-build-using-namespace): a program that uses the library
using glm::dvec3;

// With positions of single precision.
Mesh read_mesh(const std::string& file) {
  Mesh mesh = build_mesh(read_model(file), file).mesh;
  for (dvec3& position : mesh.positions) position = dvec3(glm::vec3(position));
  return mesh;
}

void write(const std::string& file, const std::string& content) {
  std::ofstream out(file, std::ios::binary);
  out << content;
  if (!out.flush()) throw std::runtime_error(file + " cannot be written");
}

RTCScene embree_scene(RTCDevice device, const Mesh& mesh, bool robust) {
  RTCScene scene = rtcNewScene(device);
  if (robust) rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<glm::vec3*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                              sizeof(glm::vec3), mesh.positions.size()));
  for (const dvec3& position : mesh.positions) *positions++ = glm::vec3(position);
  auto* triangles = static_cast<glm::uvec3*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              sizeof(glm::uvec3), mesh.triangles.size()));
  for (const MeshTriangle& t : mesh.triangles) {
    *triangles++ = {t.vertex[0], t.vertex[1], t.vertex[2]};
  }
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene);
  return scene;
}

FileHit cast_by_embree(RTCScene scene, const FileRay& ray) {
  RTCRayHit one{};
  one.ray.org_x = static_cast<float>(ray.origin.x);
  one.ray.org_y = static_cast<float>(ray.origin.y);
  one.ray.org_z = static_cast<float>(ray.origin.z);
  one.ray.dir_x = static_cast<float>(ray.direction.x);
  one.ray.dir_y = static_cast<float>(ray.direction.y);
  one.ray.dir_z = static_cast<float>(ray.direction.z);
  one.ray.tnear = static_cast<float>(ray.t_min);
  one.ray.tfar = static_cast<float>(ray.t_max);
  one.ray.mask = ~0U;
  one.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &one);
  if (one.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
  return {one.ray.tfar, one.hit.u, one.hit.v, one.hit.primID};
}

void by_embree(bool robust, const std::string& rays_file, const std::string& model,
               const std::string& hits_file) {
  RTCDevice device = rtcNewDevice("threads=1");
  RTCScene scene = embree_scene(device, read_mesh(model), robust);
  std::vector<FileHit> hits;
  for (const FileRay& ray : read_rays(rays_file)) hits.push_back(cast_by_embree(scene, ray));
  write(hits_file, hits_for(hits_file, hits));
  rtcReleaseScene(scene);
  rtcReleaseDevice(device);
}

void by_opengl(const std::string& model, const std::string& rays_file,
               const std::string& hits_file) {
  const Mesh mesh = read_mesh(model);
  const BakedScene scene = bake(mesh, {SURFACE_FLAT, 0.0});
  const TraceSettings settings = framed_settings(mesh, scene, 400, 300);
  const TraceParams params = make_params(scene, settings);
  const opengl::Context context;
  Frame frame;
  opengl::Rasterizer(scene, params, 1, true).render(frame);
  std::vector<FileRay> rays;
  std::vector<FileHit> hits;
  for (uint32_t y = 0; y < frame.height; ++y) {
    for (uint32_t x = 0; x < frame.width; ++x) {
      const OraclePixelRay pixel = oracle_pixel_ray(params, x, y);
      FileRay ray;
      ray.direction = pixel.ray.direction;
      ray.origin = scene.origin + pixel.ray.origin - ray.direction * pixel.anchor_distance;
      rays.push_back(ray);
      const PixelAovs& aovs = frame.aovs[std::size_t{y} * frame.width + x];
      FileHit hit;
      if (aovs.triangle != NO_TRIANGLE) {
        hit = {aovs.normal_z.w, aovs.geometric_u.w, aovs.v, aovs.triangle};
      }
      hits.push_back(hit);
    }
  }
  write(rays_file, rays_for(rays_file, rays));
  write(hits_file, hits_for(hits_file, hits));
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    if (words.size() == 4 && words[0] == "opengl") {
      by_opengl(words[1], words[2], words[3]);
    } else if (words.size() == 4 && (words[0] == "embree" || words[0] == "embree-robust")) {
      by_embree(words[0] == "embree-robust", words[1], words[2], words[3]);
    } else {
      fmt::print(stderr,
                 "usage: other-tracers embree|embree-robust RAYS MODEL HITS\n"
                 "       other-tracers opengl MODEL RAYS HITS\n");
      return 2;
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "other-tracers: {}\n", error.what());
    return 1;
  }
  return 0;
}
