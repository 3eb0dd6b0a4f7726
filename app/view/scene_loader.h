// Models are read and baked beside the window, which goes on showing the last one.
#pragma once

#include <future>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "app/bake/bake.h"
#include "app/mesh/mesh.h"
#include "app/surface/surface_choice.h"

namespace trisect::view {

struct SceneRequest {
  std::string model;
  std::optional<double> crease;
  SurfaceChoice choice;
  bool tree = false;  // a bvh is wanted

  bool operator==(const SceneRequest&) const = default;
};

struct ViewedScene {
  SceneRequest request;
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const BakedScene> scene;  // with cages
  std::string summary;                      // about the file
};

// Why there is none.
struct LoadFailure {
  SceneRequest request;
  std::string message;
};

class SceneLoader {
 public:
  // Has this scene loaded, after the one that is being loaded; of several that wait the last one
  // counts. What was asked for last is not asked for again.
  void ask(const SceneRequest& request);

  // What is there counts as asked for last: nothing is to be loaded until something else is.
  void keep(const ViewedScene& scene) {
    asked_ = scene.request;
    mesh_ = scene.mesh;
    scene_ = scene.scene;
    mesh_request_ = scene.request;
    summary_ = scene.summary;
  }

  // The same may be asked for again, and is read anew.
  void forget() {
    asked_.reset();
    mesh_.reset();
  }

  // The scene asked for, once.
  std::optional<std::variant<ViewedScene, LoadFailure>> poll();

  [[nodiscard]] bool is_busy() const { return running_.valid(); }

 private:
  using Result = std::variant<ViewedScene, LoadFailure>;

  std::optional<SceneRequest> asked_;
  std::optional<SceneRequest> waiting_;
  std::shared_ptr<const Mesh> mesh_;  // of the last model that was read
  std::shared_ptr<const BakedScene> scene_;
  SceneRequest mesh_request_;
  std::string summary_;
  std::future<Result> running_;
};

}  // namespace trisect::view
