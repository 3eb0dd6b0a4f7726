#include "tests/fuzz/seeds.h"

#include <draco/compression/encode.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "app/bake/bake.h"
#include "app/cli/picture_source.h"
#include "app/judge/ray_file.h"
#include "app/mesh/model_file.h"
#include "app/picture/image_file.h"
#include "app/report/document.h"
#include "app/tessellation/flat_mesh_file.h"
#include "tests/support/file_content.h"
#include "tests/support/scenes.h"
#include "tests/support/temporary_folder.h"

namespace trisect::fuzz {
namespace {

namespace fs = std::filesystem;

// The numbers of model_input's endings.
char ending_number(ModelFormat format) {
  switch (format) {
    case ModelFormat::gltf:
      return 1;
    case ModelFormat::ply:
      return 3;
    case ModelFormat::stl:
      return 4;
    case ModelFormat::fbx:
      return 5;
    default:
      return 0;
  }
}

void add_models(const fs::path& folder, std::vector<Seed>& seeds) {
  constexpr std::uintmax_t largest = 12000;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || !is_model_name(entry.path())) continue;
    if (entry.file_size() > largest) continue;
    const std::string content = test::content_of(entry.path());
    seeds.push_back({"model", ending_number(format_of(content, entry.path())) + content});
  }
}

// The formats that the program writes.
void add_exports(std::vector<Seed>& seeds) {
  const test::TemporaryFolder folder;
  const Mesh mesh = test::load_asset("sphere-20");
  const FlatMesh flat = *divided_evenly(mesh, bake(mesh, {SURFACE_FLAT, 0.0, SHELL_NORMAL}), 1);
  for (const char* ending : {".obj", ".ply", ".stl", ".glb"}) {
    const fs::path path = folder / (std::string("model") + ending);
    AtomicFile file(path);
    write_mesh(flat, *mesh_format_of(path), file);
    file.commit();
    const std::string content = test::content_of(path);
    seeds.push_back({"model", ending_number(format_of(content, path)) + content});
  }
}

// A square of two triangles with a skin, a morph target and a sparse accessor.
std::string gltf_of_all() {
  const float corners[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1};
  std::string bytes(sizeof(corners), '\0');
  std::memcpy(bytes.data(), corners, sizeof(corners));
  bytes += std::string("\0\1\2\0\2\3\0\0", 8);
  for (int corner = 0; corner < 4; ++corner) bytes += std::string("\377\0\0\0", 4);
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"skin":0,
"children":[1],"rotation":[0,0,0,1],"scale":[1,1,1]},{"translation":[0,0,1]}],"skins":[{"joints":[0,1]}],
"meshes":[{"weights":[0.5],"primitives":[{"attributes":{"POSITION":0,"NORMAL":2,"COLOR_0":0,"JOINTS_0":3,
"WEIGHTS_0":4},"indices":1,"material":0,"mode":4,"targets":[{"POSITION":2}]}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0,1]}}],"accessors":[
{"bufferView":0,"componentType":5126,"type":"VEC3","count":4},
{"bufferView":1,"componentType":5121,"type":"SCALAR","count":6},
{"componentType":5126,"type":"VEC3","count":4,"sparse":{"count":2,"indices":{"bufferView":1,
"componentType":5121},"values":{"bufferView":0,"byteOffset":48}}},
{"componentType":5121,"type":"VEC4","count":4},
{"componentType":5121,"type":"VEC4","count":4,"bufferView":2,"normalized":true}],
"bufferViews":[{"buffer":0,"byteLength":72},{"buffer":0,"byteOffset":72,"byteLength":8},
{"buffer":0,"byteOffset":80,"byteLength":16}],"buffers":[{"byteLength":96,"uri":"data:application/octet-stream;base64,)" +
         report::base64_of(bytes) + "\"}]}";
}

// The same square as Draco packs it.
std::string gltf_of_draco() {
  draco::Mesh mesh;
  mesh.set_num_points(4);
  draco::GeometryAttribute attribute;
  attribute.Init(draco::GeometryAttribute::POSITION, nullptr, 3, draco::DT_FLOAT32, false, 12, 0);
  const int id = mesh.AddAttribute(attribute, true, 4);
  const float corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  for (uint32_t i = 0; i < 4; ++i) {
    mesh.attribute(id)->SetAttributeValue(draco::AttributeValueIndex(i), corners[i]);
  }
  mesh.AddFace({draco::PointIndex(0), draco::PointIndex(1), draco::PointIndex(2)});
  mesh.AddFace({draco::PointIndex(0), draco::PointIndex(2), draco::PointIndex(3)});
  draco::EncoderBuffer packed;
  draco::Encoder encoder;
  if (!encoder.EncodeMeshToBuffer(mesh, &packed).ok()) return {};
  const std::string size = std::to_string(packed.size());
  return R"({"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0},"extensions":{
"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}}]}],"bufferViews":[{"buffer":0,
"byteLength":)" +
         size + R"(}],"buffers":[{"byteLength":)" + size +
         R"(,"uri":"data:application/octet-stream;base64,)" +
         report::base64_of({packed.data(), packed.size()}) + "\"}]}";
}

void add_paths(std::vector<Seed>& seeds) {
  seeds.push_back(
      {"path", R"({"frames": 90, "keys": [{"frame": 0, "eye": [3, 1, 4], "target": [0, 0, 0],
"up": [0, 1, 0], "fov": 45}, {"frame": 30.5, "eye": [1e12, -1, 4]}, {"frame": 60, "fov": 170}]})"});
  seeds.push_back({"path", R"({"keys": [{"frame": 7, "up": [0, 0, 1]}, {"frame": 7.5}]})"});
}

std::string picture(const char* ending, bool with_aovs, std::optional<FramePlace> place) {
  const test::TemporaryFolder folder;
  Frame frame;
  frame.resize(4, 2, with_aovs);
  for (std::size_t i = 0; i < frame.colors.size(); ++i) {
    frame.colors[i] = vec4(0.1F * static_cast<float>(i), 0.5F, 1.0F, 1.0F);
  }
  RenderOptions options;
  options.model = "a.obj";
  options.width = 4;
  options.height = 2;
  if (place) options.tile = ImagePart{place->x, place->y, 4, 2};
  if (place) options.height = place->image_height;
  const fs::path path = folder / (std::string("picture") + ending);
  ImageContents contents;
  contents.place = place;
  contents.attributes = attributes_of(options, {});
  save_image(frame, path, contents);
  return test::content_of(path);
}

void add_pictures(std::vector<Seed>& seeds) {
  for (const char* ending : {".png", ".exr"}) {
    const char kind = ending == std::string(".png") ? 0 : 1;
    for (const bool with_aovs : {false, true}) {
      seeds.push_back({"picture", kind + picture(ending, with_aovs, std::nullopt)});
    }
    const std::string top = picture(ending, false, FramePlace{0, 0, 4, 4});
    const std::string bottom = picture(ending, false, FramePlace{0, 2, 4, 4});
    const auto size = static_cast<uint16_t>(top.size());
    std::string both(3, static_cast<char>(kind + 2));
    std::memcpy(&both[1], &size, sizeof(size));
    seeds.push_back({"picture", both.append(top).append(bottom)});
  }
}

void add_texts(std::vector<Seed>& seeds) {
  const auto add = [&](char kind, const std::string& text) {
    seeds.push_back({"text", kind + text});
  };
  for (const char* words :
       {"render\na.obj\n-o\na.png\n--size\n64x48\n--turntable\n8\n--aov\ncolor,Z\n--tile\n0,0,8,8",
        "render\n--from\na.png\n-o\nb.exr\n--spp\n4\n--backend\ncpu", "view\na.obj\n--script\ns",
        "stitch\na.png\nb.png\n-o\nc.png\n-q", "compare\na.exr\nb.exr\n--threshold\ncolor_max=2",
        "crosscheck\na.obj\n--backends\nvulkan,cpu", "bench\npareto\na.obj\n--json\nb.json",
        "export\na.obj\n--error\n0.01\n-o\nb.glb", "accuracy\na.obj\n--size\n16x12",
        "certify\na.obj\n-o\na.png\n--json\nb.json", "info\na.ply\n--weld\n1e-3",
        "devices\n--floats", "hardcases\n--backend\ncpu"}) {
    add(0, words);
  }
  add(1,
      "trisect render m.obj -o a.png --eye 1,-2,3 --target -4,5,-6.5 --light=-1,0,1 --alpha -0.5 "
      "--up 0,0,1 --solver bisect --rank 12 --accel list --size 64x48 --fov 30");
  add(1,
      "--shadows --shading grid --color 0.1,0,1 --background 0.3,0.5,1 --spp 16 --crease 0.1 "
      "--weld 1e-07 --repair --surface sphere --shell height");
  add(1, "--preset thesis --background transparent --shading depth");
  add(2,
      "# a script\n0.5 hold w 0.25\n1 press f12\n1 flags --fov 30\n2 shown depth\n2 size 64x48\n"
      "3 open a.obj\n3 save a.exr\n4 error\n5 quit\n");
  for (const char* value : {"800x600", "1,-2.5,3e2", "0.5,0.7,1", "color,Z,N,G,patch,uv,P,evals",
                            "0:59", "0,0,100,50", "vulkan,opengl,cpu", "color_rmse=0.5"}) {
    add(3, value);
  }
  const std::vector<FileRay> rays(2);
  const std::vector<FileHit> hits{{1.5, 0.25, 0.5, 12}, {}, {2.0, 0.0, 0.0, kSomeTriangle}};
  for (const char* name : {"a.csv", "a"}) {
    const char kind = std::string_view(name) == "a" ? 5 : 4;
    add(kind, rays_for(name, rays));
    add(kind, hits_for(name, hits));
  }
}

void add_solver_numbers(std::vector<Seed>& seeds) {
  const float triangle[] = {-1,    0,    0,    1,     0,    0,    0,    1,    0,    -0.5F,
                            -0.3F, 0.8F, 0.5F, -0.3F, 0.8F, 0,    0.6F, 0.8F, 0,    0.1F,
                            0,     0,    0,    -1,    0.1F, 0.2F, 0,    1,    0.1F, 0.02F};
  std::string numbers(sizeof(triangle), '\0');
  std::memcpy(numbers.data(), triangle, sizeof(triangle));
  for (char choice = 0; choice < 5; ++choice) {
    seeds.push_back({"solver", static_cast<char>(130 + choice) + numbers});
    seeds.push_back({"solver", choice + numbers.substr(0, 60)});
  }
}

}  // namespace

std::vector<Seed> seeds_of(const std::vector<std::filesystem::path>& folders) {
  std::vector<Seed> seeds;
  for (const fs::path& folder : folders) add_models(folder, seeds);
  add_exports(seeds);
  seeds.push_back({"model", '\1' + gltf_of_all()});
  seeds.push_back({"model", '\1' + gltf_of_draco()});
  add_paths(seeds);
  add_pictures(seeds);
  add_texts(seeds);
  add_solver_numbers(seeds);
  return seeds;
}

}  // namespace trisect::fuzz
