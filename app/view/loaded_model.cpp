#include "app/view/loaded_model.h"

#include <exception>
#include <utility>
#include <variant>

#include "app/dispatch/accel.h"

namespace trisect::view {

void LoadedModel::request(const RenderOptions& render) {
  // Without a choice of the user the acceleration may change with the size of the window.
  const bool may_need_tree =
      render.solver == SOLVER_ROBUST && (!render.accel || needs_bvh(*render.accel, render.shadows));
  loader_.ask(
      {render.model, render.mesh, {render.surface, render.alpha, render.shell}, may_need_tree});
}

void LoadedModel::open(const RenderOptions& render) {
  loader_.forget();
  is_opening_ = true;
  request(render);
}

std::optional<LoadedModel::Change> LoadedModel::poll(RenderOptions& render, std::string& message) {
  const auto result = loader_.poll();
  if (!result) return std::nullopt;
  if (const auto* failure = std::get_if<LoadFailure>(&*result)) {
    if (!is_loaded()) std::rethrow_exception(failure->error);
    message = failure->message;
    restore(render, failure->request);
    return Change::failed;
  }
  current_ = std::get<ViewedScene>(*result);
  ++number_;
  if (!std::exchange(is_opening_, false)) return Change::rebaked;
  recent_.add(current_->request.model);
  return Change::opened;
}

void LoadedModel::restore(RenderOptions& render, const SceneRequest& failed) {
  const SceneRequest& kept = current_->request;
  render.model = kept.model;
  render.mesh = kept.mesh;
  render.surface = kept.choice.surface;
  render.alpha = kept.choice.alpha;
  render.shell = kept.choice.shell;
  if (failed.tree && !kept.tree) {
    render.accel = Accel::list;
    render.shadows = false;
  }
  is_opening_ = false;
  // Otherwise the next request() would ask for the failed scene again.
  loader_.keep(*current_);
}

}  // namespace trisect::view
