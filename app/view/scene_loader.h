// Reads and bakes models in the background, while the window goes on showing the last one.
#pragma once

#include <exception>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <variant>

#include "app/bake/bake.h"
#include "app/mesh/mesh.h"
#include "app/mesh/mesh_builder.h"
#include "app/surface/surface_choice.h"

namespace trisect::view {

struct SceneRequest {
  std::string model;
  MeshOptions mesh;
  SurfaceChoice choice;
  bool tree = false;  // whether the scene needs its bvh

  bool operator==(const SceneRequest&) const = default;
};

// Of a model's file.
struct FileFacts {
  std::string summary;  // one line
  std::string sha256;   // model_sha256()
};

struct ViewedScene {
  SceneRequest request;
  std::shared_ptr<const Mesh> mesh;
  std::shared_ptr<const BakedScene> scene;  // with the bounds of its subpatches
  FileFacts file;
};

// Why a scene could not be loaded.
struct LoadFailure {
  SceneRequest request;
  std::string message;
  std::exception_ptr error;
};

// One scene is loaded at a time, in a thread of its own. The functions are for one thread.
class SceneLoader {
 public:
  // Has this scene loaded, once the one that is being loaded is ready. Of several that wait only
  // the last one is loaded. A request equal to the last one does nothing.
  void ask(const SceneRequest& request);

  // Takes this scene for the one that was asked for last: an equal request loads nothing.
  void keep(const ViewedScene& scene) {
    asked_ = scene.request;
    mesh_ = scene.mesh;
    scene_ = scene.scene;
    mesh_request_ = scene.request;
    file_ = scene.file;
  }

  // Forgets the last request and its mesh: an equal one reads the file again.
  void forget() {
    asked_.reset();
    mesh_.reset();
  }

  // The result of the last request, once, when it is ready.
  std::optional<std::variant<ViewedScene, LoadFailure>> poll();

  [[nodiscard]] bool is_busy() const { return running_.valid(); }

 private:
  using Result = std::variant<ViewedScene, LoadFailure>;

  std::optional<SceneRequest> asked_;    // the last one
  std::optional<SceneRequest> waiting_;  // to be loaded after the one that is being loaded
  // What was loaded last, to be used again if the next request is for the same mesh.
  std::shared_ptr<const Mesh> mesh_;
  std::shared_ptr<const BakedScene> scene_;
  SceneRequest mesh_request_;
  FileFacts file_;
  std::future<Result> running_;
};

}  // namespace trisect::view
