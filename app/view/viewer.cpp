#include "app/view/viewer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/base/stopwatch.h"
#include "app/cli/interrupt.h"
#include "app/mesh/obj_file.h"

namespace trisect::view {
namespace {

// How many moving frames the graph in the panel shows.
constexpr std::size_t kFramesInGraph = 120;

}  // namespace

Viewer::Viewer(const ViewOptions& options, std::vector<ScriptStep> script, Window& window,
               const gpu::Instance& instance, const gpu::Device& device, VkSurfaceKHR surface)
    : options_(options),
      window_(window),
      device_(device),
      screen_(instance, device, window, surface),
      state_(options, device),
      tracer_(device, window, screen_, state_, scheduler_),
      commands_(device, window, screen_, state_, scheduler_, tracer_, errors_),
      script_(std::move(script)) {
  statistics_.device = state_.facts.device;
  statistics_.driver = state_.facts.driver;
  state_.model.open(state_.settings.render);
}

void Viewer::run() {
  while (!window_.is_closing() && not_interrupted()) loop_once();
  stop_if_interrupted();
  // A run may be too short for its model to have been loaded: save() waits for that.
  if (!options_.screenshot.empty() && !commands_.save(options_.screenshot)) stop_if_interrupted();
}

void Viewer::loop_once() {
  window_.wait(seconds_to_wait());
  if (!not_interrupted()) return;
  const Stopwatch watch;
  take_input();
  follow_script();
  commands_.take_loaded();
  move_camera();
  if (options_.watch) commands_.watch_shaders();
  poll_errors();
  if (script_.has_started()) name_model_in_title();
  if (is_minimised()) return;
  update_panel();
  const FrameTracer::Result traced = trace();
  if (!not_interrupted()) return;
  if (!traced.frame_was_lost) show();
  if (traced.moving) record(*traced.moving, watch.milliseconds());
  if (options_.frames && statistics_.frames >= *options_.frames) window_.close();
}

bool Viewer::is_minimised() const {
  return window_.width() == 0 || window_.height() == 0;
}

double Viewer::seconds_to_wait() const {
  if (is_minimised()) return 0.05;
  const Clock::time_point now = Clock::now();
  const bool is_walking = steps_of(walk_keys(now)) != glm::dvec3(0.0);
  if (tracer_.is_waiting()) return 0.01;
  if (scheduler_.needs_draw() || is_walking || options_.frames) return 0.0;
  // Results of other threads raise no event: they are polled.
  if (state_.model.is_loading()) return 0.01;
  if (errors_.progress()) return 0.1;
  const double until_refinement =
      scheduler_.seconds_until_refinement(tracer_.samples_at_rest(), now).value_or(0.5);
  const double until_script = script_.seconds_until_next(now).value_or(until_refinement);
  return std::max(1e-3, std::min(until_refinement, until_script));
}

void Viewer::take_input() {
  const Input input = window_.take();
  if (input.any) scheduler_.request_draws(FrameScheduler::kDrawsForPanel);
  if (input.resized) screen_.resized();
  if (!PanelLayer::wants_mouse()) state_.camera.turn_wheel(input.wheel);
  for (const KeyPress& press : input.keys) commands_.press(press.key, press.mods);
  if (!input.dropped.empty()) commands_.open_model(input.dropped.back());
}

void Viewer::follow_script() {
  // By a new time for each step, as a step may take long. What a step asked for is shown before the
  // next one asks for something else.
  while (not_interrupted() && !tracer_.is_waiting() && script_.run_next(commands_, Clock::now())) {
    scheduler_.request_draws(FrameScheduler::kDrawsForPanel);
  }
}

bool Viewer::is_held(int key, Clock::time_point now) const {
  return script_.holds(key, now) || (!PanelLayer::wants_keys() && window_.is_key_down(key));
}

WalkKeys Viewer::walk_keys(Clock::time_point now) const {
  WalkKeys keys;
  keys.left = is_held(GLFW_KEY_A, now);
  keys.right = is_held(GLFW_KEY_D, now);
  keys.up = is_held(GLFW_KEY_SPACE, now);
  keys.down = is_held(GLFW_KEY_LEFT_SHIFT, now) || is_held(GLFW_KEY_RIGHT_SHIFT, now);
  keys.ahead = is_held(GLFW_KEY_W, now);
  keys.back = is_held(GLFW_KEY_S, now);
  return keys;
}

void Viewer::move_camera() {
  const Clock::time_point now = Clock::now();
  CameraControl& camera = state_.camera;
  ControlState control;
  control.keys = walk_keys(now);
  control.button_is_down = window_.is_left_button_down();
  control.panel_has_mouse = PanelLayer::wants_mouse();
  control.cursor = window_.cursor();
  control.orbits = state_.settings.orbit;
  const bool was_turning = camera.is_turning();
  camera.move(control, now);
  if (camera.is_turning() == was_turning) return;
  window_.capture_cursor(camera.is_turning());
  // Capturing may set the cursor to another position.
  if (camera.is_turning()) camera.set_cursor(window_.cursor());
}

void Viewer::poll_errors() {
  if (errors_.poll()) {
    scheduler_.request_draws(FrameScheduler::kDrawsForProgress);
    screen_.wait();
    errors_.upload(device_);
  }
  if (errors_.progress()) scheduler_.request_draws(FrameScheduler::kDrawsForProgress);
}

bool Viewer::shows_errors() const {
  return state_.settings.shown == SHOWN_ERROR && errors_.has_map() &&
         errors_.belongs_to(state_.content(window_.width(), window_.height()));
}

void Viewer::update_panel() {
  PanelLayer::begin();
  Facts& facts = state_.facts;
  facts.save_file = commands_.next_file();
  facts.making_kernels = tracer_.is_waiting();
  facts.error_progress = errors_.progress();
  facts.error = shows_errors() ? errors_.map().summary : "";
  if (facts.error.empty() && errors_.has_map() && state_.settings.shown == SHOWN_ERROR) {
    facts.error = "measured of another view; here is the colour";
  }
  const Requests requests = build_panel(state_.settings, facts);
  PanelLayer::end();
  commands_.obey(requests);
  state_.model.request(state_.settings.render);
}

FrameTracer::Result Viewer::trace() {
  const auto may_refine = [this] {
    window_.wait(0.0);
    return !window_.has_input_that_ends_refinement() && !script_.is_due(Clock::now());
  };
  return tracer_.trace(may_refine, statistics_.frames > 0);
}

ScreenPush Viewer::screen_push(bool shows_errors) const {
  const Picture& picture = tracer_.front();
  ScreenPush push{};
  push.frame_width = 1;
  push.frame_height = 1;
  push.high = 1.0F;
  if (shows_errors) {
    push.frame_width = errors_.map().width;
    push.frame_height = errors_.map().height;
    push.shown = SHOWN_ERROR;
    // Powers of 10 of the scene's radius, as the panel says.
    push.low = -9.0F;
    push.high = -3.0F;
  } else if (picture.is_there()) {
    push.frame_width = picture.width();
    push.frame_height = picture.height();
    const uint shown = state_.settings.shown;
    push.shown = shown == SHOWN_ERROR || !picture.has_aovs() ? SHOWN_COLOR : shown;
    if (push.shown == SHOWN_DEPTH) {
      const BakedScene& scene = state_.model.scene();
      const double distance = glm::distance(state_.camera.camera().eye, scene.origin);
      push.low = static_cast<float>(std::max(0.0, distance - scene.radius));
      push.high = static_cast<float>(distance + scene.radius);
    }
    if (push.shown == SHOWN_EVALUATIONS) push.high = 16.0F;
  }
  return push;
}

void Viewer::show() {
  if (!scheduler_.needs_draw() && !options_.frames) return;
  const bool errors = shows_errors();
  if (!screen_.show(window_.width(), window_.height(), tracer_.front(),
                    errors ? &errors_.errors() : nullptr, screen_push(errors))) {
    return;
  }
  scheduler_.frame_drawn();
  // What waits for kernels is not the frame that is wanted.
  if (!state_.model.is_loaded() || tracer_.is_waiting()) return;
  ++statistics_.frames;
  if (script_.has_started()) return;
  if (statistics_.frames < kFramesToStart) {
    // However much of the picture is still to come.
    scheduler_.request_draws(1);
    return;
  }
  script_.start(Clock::now());
  name_model_in_title();
}

void Viewer::record(const MovingFrame& frame, double loop_ms) {
  if (!frame.warmed_up) {
    scheduler_.record_cost(std::sqrt(frame.pixel_part), frame.trace_ms, loop_ms - frame.trace_ms);
  }
  statistics_.moving_part.push_back(frame.pixel_part);
  statistics_.moving_ms.push_back(loop_ms);
  std::vector<float>& graph = state_.facts.frame_ms;
  graph.push_back(static_cast<float>(loop_ms));
  if (graph.size() > kFramesInGraph) graph.erase(graph.begin());
}

void Viewer::name_model_in_title() {
  window_.set_title("trisect: " + model_name(state_.model.shown().model));
}

}  // namespace trisect::view
