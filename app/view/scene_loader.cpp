#include "app/view/scene_loader.h"

#include <chrono>
#include <exception>
#include <new>
#include <utility>

#include "app/bake/bvh.h"
#include "app/bake/subpatch_bounds.h"
#include "app/cli/model_sha256.h"
#include "app/mesh/model_file.h"

namespace trisect::view {
namespace {

// mesh: of an earlier request for the same model and mesh options, or null to read the file.
// before: the scene that was baked from that mesh, whose tree can be refitted; file: of that mesh.
std::variant<ViewedScene, LoadFailure> load(const SceneRequest& request,
                                            std::shared_ptr<const Mesh> mesh,
                                            const std::shared_ptr<const BakedScene>& before,
                                            FileFacts file) {
  try {
    const bool is_known = mesh != nullptr;
    if (!is_known) {
      PolygonModel model = read_model(request.model);
      file.sha256 = model_sha256(request.model, model.files);
      BuiltMesh built = build_mesh(std::move(model), request.model, request.mesh);
      file.summary = describe(built.report);
      mesh = std::make_shared<const Mesh>(std::move(built.mesh));
    }
    BakedScene scene = bake_with_subpatches(*mesh, request.choice);
    if (request.tree) {
      std::optional<std::vector<BvhNode>> bvh;
      if (is_known) bvh = refitted_bvh(scene, *before);
      scene.bvh = bvh ? std::move(*bvh) : build_bvh(scene);
    }
    return ViewedScene{request, std::move(mesh),
                       std::make_shared<const BakedScene>(std::move(scene)), std::move(file)};
  } catch (const std::bad_alloc&) {
    return LoadFailure{request, request.model + ": not enough memory for this model.",
                       std::current_exception()};
  } catch (const std::exception& error) {
    return LoadFailure{request, error.what(), std::current_exception()};
  }
}

}  // namespace

void SceneLoader::ask(const SceneRequest& request) {
  if (asked_ == request) return;
  asked_ = request;
  if (running_.valid()) {
    waiting_ = request;
    return;
  }
  const bool same_mesh =
      mesh_ && mesh_request_.model == request.model && mesh_request_.mesh == request.mesh;
  running_ =
      std::async(std::launch::async, load, request, same_mesh ? mesh_ : nullptr, scene_, file_);
}

std::optional<SceneLoader::Result> SceneLoader::poll() {
  if (!running_.valid() ||
      running_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
    return std::nullopt;
  }
  Result result = running_.get();
  if (const auto* loaded = std::get_if<ViewedScene>(&result)) {
    mesh_ = loaded->mesh;
    scene_ = loaded->scene;
    mesh_request_ = loaded->request;
    file_ = loaded->file;
  }
  if (!waiting_) return result;
  const SceneRequest next = *std::exchange(waiting_, std::nullopt);
  asked_.reset();
  ask(next);
  return std::nullopt;
}

}  // namespace trisect::view
