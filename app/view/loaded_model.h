// The model in the window: loaded in the background, replaced once the next one is ready.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/cli/options.h"
#include "app/view/recent_files.h"
#include "app/view/scene_loader.h"

namespace trisect::view {

// To be used by one thread; the loading runs in others.
class LoadedModel {
 public:
  enum class Change {
    failed,   // the last scene stays
    rebaked,  // the same model with other options
    opened,   // a model that the camera is to frame
  };

  // cache_folder: where the list of recent models is kept, if anywhere.
  explicit LoadedModel(const std::optional<std::filesystem::path>& cache_folder)
      : recent_(cache_folder) {}

  // Has the scene of these options loaded, unless it is what was asked for last.
  void request(const RenderOptions& render);

  // The same, but the file is read again even if it is the one that was read last.
  void open(const RenderOptions& render);

  // Takes over what has been loaded; nothing if that is nothing. On a failure `message` tells why,
  // and `render` is set back to the options of the scene that stays. Throws what it
  // failed with if there is none.
  std::optional<Change> poll(RenderOptions& render, std::string& message);

  [[nodiscard]] bool is_loading() const { return loader_.is_busy(); }
  [[nodiscard]] bool is_loaded() const { return current_.has_value(); }

  // The rest needs a scene to be loaded.
  [[nodiscard]] const SceneRequest& shown() const { return current_->request; }
  [[nodiscard]] const Mesh& mesh() const { return *current_->mesh; }
  [[nodiscard]] const BakedScene& scene() const { return *current_->scene; }
  [[nodiscard]] const std::shared_ptr<const BakedScene>& shared_scene() const {
    return current_->scene;
  }
  [[nodiscard]] const FileFacts& file() const { return current_->file; }

  // How many scenes have been loaded.
  [[nodiscard]] uint64_t number() const { return number_; }

  // The models that were opened last, the last one first.
  [[nodiscard]] const std::vector<std::string>& recent() const { return recent_.files(); }

 private:
  void restore(RenderOptions& render, const SceneRequest& failed);

  SceneLoader loader_;
  std::optional<ViewedScene> current_;
  uint64_t number_ = 0;
  bool is_opening_ = true;  // the scene that is loaded next is of another model
  RecentFiles recent_;
};

}  // namespace trisect::view
