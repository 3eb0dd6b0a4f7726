#include "app/view/viewer.h"
#include "app/cli/cache_folder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <span>
#include <utility>

#include "app/base/error.h"
#include "app/base/stopwatch.h"
#include "app/buffers/kernels.h"
#include "app/cli/interrupt.h"
#include "app/cli/load_scene.h"
#include "app/cli/statistics.h"
#include "app/dispatch/accel.h"
#include "app/dispatch/pipeline_store.h"
#include "app/frame/supersampling.h"
#include "app/mesh/obj_file.h"
#include "app/view/clock.h"
#include "vk/result.h"

namespace trisect::view {
namespace {

// After a change the picture is refined when so many seconds brought no other.
constexpr double kStill = 0.15;
// Of the graph in the panel.
constexpr std::size_t kFramesTold = 120;

std::vector<std::string> models_in(const std::filesystem::path& folder) {
  std::vector<std::string> models;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    if (entry.path().extension() == ".obj") models.push_back(entry.path().string());
  }
  std::sort(models.begin(), models.end());
  return models;
}

}  // namespace

Viewer::Viewer(const ViewOptions& options, std::vector<ScriptStep> script, Window& window,
               const gpu::Instance& instance, const gpu::Device& device, VkSurfaceKHR surface)
    : options_(options),
      window_(window),
      device_(device),
      swapchain_(device, surface),
      pass_(device, swapchain_.render_pass(), spirv_of("screen_vert"), spirv_of("screen_frag"),
            screen_interface(), BINDING_FRAME, "screen"),
      layer_(instance, device, window, swapchain_.render_pass()),
      still_(device),
      moving_(device),
      unused_(device, sizeof(PixelAovs), gpu::Memory::host, "unused"),
      recent_(cache_folder()),
      navigator_(Camera{}, 1.0),
      script_(std::move(script)) {
  settings_.render = options.render;
  settings_.frame_ms = options.frame_ms;
  facts_.device = device.report().name;
  facts_.driver = device.report().driver;
  facts_.ray_query = device.has_ray_query();
  facts_.models = models_in(options.assets);
  facts_.recent = recent_.files();
  statistics_.device = facts_.device;
  statistics_.driver = facts_.driver;
  shaders_changed_ = last_change(options.shaders);
  std::fill(unused_.bytes().begin(), unused_.bytes().end(), std::byte{0});
  load();
}

void Viewer::run() {
  while (!quits_ && glfwWindowShouldClose(window_.get()) != GLFW_TRUE) {
    window_.wait(seconds_to_wait());
    stop_if_interrupted();
    const Stopwatch watch;
    trace_ms_ = 0.0;
    moved_ = false;
    take_input();
    follow_script();
    take_loaded();
    move_camera();
    if (options_.watch) watch_shaders();
    if (auto map = error_.poll()) {
      error_map_ = std::move(*map);
      redraws_ = std::max(redraws_, 1);
      show_errors();
    }
    if (error_.progress()) redraws_ = std::max(redraws_, 1);
    if (window_.width() == 0 || window_.height() == 0) continue;
    build_panel_and_obey();
    trace();
    show();
    const double ms = watch.milliseconds();
    if (moved_) {
      if (!warming_) {
        pacer_.record(std::sqrt(statistics_.moving_part.back()), trace_ms_, ms - trace_ms_);
      }
      statistics_.moving_ms.push_back(ms);
      facts_.frame_ms.push_back(static_cast<float>(ms));
      if (facts_.frame_ms.size() > kFramesTold) facts_.frame_ms.erase(facts_.frame_ms.begin());
    }
    if (options_.frames && statistics_.frames >= *options_.frames) quits_ = true;
  }
  // However short the run was.
  if (!options_.screenshot.empty()) save(options_.screenshot);
}

double Viewer::seconds_to_wait() const {
  // While it is minimised there is nothing to draw.
  if (window_.width() == 0 || window_.height() == 0) return 0.05;
  if (redraws_ > 0 || is_walking() || options_.frames) return 0.0;
  if (loader_.is_busy()) return 0.01;
  if (error_.progress()) return 0.1;
  const bool refines = traced_ && !failed_ && side_ != samples_when_still();
  double seconds = refines ? kStill - seconds_between(changed_, Clock::now()) : 0.5;
  if (next_step_ < script_.size()) {
    seconds = std::min(seconds, script_[next_step_].seconds - since_start());
  }
  return std::max(1e-3, seconds);
}

double Viewer::since_start() const {
  return first_frame_ ? seconds_between(*first_frame_, Clock::now()) : 0.0;
}

void Viewer::load() {
  const RenderOptions& render = settings_.render;
  // By itself the way may change with the window's size.
  const bool may_need_tree =
      render.solver == SOLVER_ROBUST && (!render.accel || needs_bvh(*render.accel, render.shadows));
  loader_.ask(
      {render.model, render.crease, {render.surface, render.alpha, render.shell}, may_need_tree});
}

void Viewer::open(const std::string& model) {
  loader_.forget();
  settings_.render.model = model;
  settings_.render.eye.reset();
  settings_.render.target.reset();
  frames_model_ = true;
  load();
}

void Viewer::take_loaded() {
  const auto result = loader_.poll();
  facts_.loading = loader_.is_busy();
  if (!result) return;
  redraws_ = 3;
  if (const auto* failure = std::get_if<LoadFailure>(&*result)) {
    if (!scene_) throw InputError(failure->message);
    facts_.message = failure->message;
    // What is there stays, and counts as asked for.
    const SceneRequest& kept = scene_->request;
    settings_.render.model = kept.model;
    settings_.render.crease = kept.crease;
    settings_.render.surface = kept.choice.surface;
    settings_.render.alpha = kept.choice.alpha;
    settings_.render.shell = kept.choice.shell;
    if (failure->request.tree && !kept.tree) {
      settings_.render.accel = Accel::list;
      settings_.render.shadows = false;
    }
    frames_model_ = false;
    loader_.keep(*scene_);
    return;
  }
  scene_ = std::get<ViewedScene>(*result);
  ++scene_number_;
  facts_.model = scene_->summary;
  if (std::exchange(frames_model_, false)) {
    facts_.message.clear();
    recent_.add(scene_->request.model);
    facts_.recent = recent_.files();
    if (first_frame_) entitle();
    frame_now();
  }
}

KernelChoice Viewer::kernels_wanted(uint32_t width, uint32_t height) const {
  const RenderOptions render = render_at(width, height);
  const bool outputs = settings_.shown != SHOWN_COLOR && settings_.shown != SHOWN_ERROR;
  KernelChoice choice;
  choice.solver = render.solver;
  choice.counts = settings_.counts || settings_.shown == SHOWN_EVALUATIONS;
  choice.aovs = outputs || choice.counts;
  choice.shadows = render.shadows;
  // The tree may be on its way.
  choice.accel = accel_at_hand(accel_request(render), *scene_->scene);
  return choice;
}

RenderOptions Viewer::render_now() const {
  RenderOptions render = settings_.render;
  const Camera& camera = navigator_.camera();
  render.eye = camera.eye;
  render.target = camera.target;
  render.up = camera.up;
  render.fov = camera.fov;
  render.model = scene_->request.model;
  render.crease = scene_->request.crease;
  render.surface = scene_->request.choice.surface;
  render.alpha = scene_->request.choice.alpha;
  render.shell = scene_->request.choice.shell;
  return render;
}

// A frame of that size, a ray for each of its pixels.
RenderOptions Viewer::render_at(uint32_t width, uint32_t height) const {
  RenderOptions render = render_now();
  render.width = width;
  render.height = height;
  render.spp = 1;
  return render;
}

Viewer::Shown Viewer::shown_now() const {
  Shown shown;
  shown.render = render_at(0, 0);
  shown.scene = scene_number_;
  shown.code = code_number_;
  shown.kernels = kernels_wanted(window_.width(), window_.height());
  shown.width = window_.width();
  shown.height = window_.height();
  return shown;
}

uint32_t Viewer::samples_when_still() const {
  uint32_t side = settings_.shown == SHOWN_COLOR ? samples_across(settings_.render.spp) : 1;
  // 0 if not even the window's pixels fit.
  while (side > 0 && !still_.can_hold(window_.width() * side, window_.height() * side)) --side;
  return side;
}

bool Viewer::trace_at(Picture& picture, uint32_t width, uint32_t height, bool moving) {
  swapchain_.wait();
  const TraceSettings settings =
      settings_of(render_at(width, height), *scene_->mesh, *scene_->scene);
  const Stopwatch watch;
  const std::optional<double> ms = picture.trace(settings, [&] {
    if (!not_interrupted()) return false;
    if (moving) return true;
    window_.wait(0.0);
    const bool script_is_due =
        next_step_ < script_.size() && script_[next_step_].seconds <= since_start();
    return !window_.is_disturbed() && !script_is_due;
  });
  stop_if_interrupted();
  if (!ms) return false;
  trace_ms_ = watch.milliseconds();
  front_ = &picture;
  copied_ = false;
  facts_.trace_ms = trace_ms_;
  facts_.frame_width = width;
  facts_.frame_height = height;
  // The panel tells of it in the next one.
  redraws_ = std::max(redraws_, 2);
  return true;
}

// Fewer pixels may go faster another way, which then has kernels and buffers of its own.
Picture& Viewer::picture_for(const Shown& shown, double scale) {
  constexpr uint32_t part = 4;
  const KernelChoice small =
      kernels_wanted(std::max(shown.width / part, 1U), std::max(shown.height / part, 1U));
  const bool apart = scale < 1.0 && small != shown.kernels;
  Picture& picture = apart ? moving_ : still_;
  // A first frame also warms up the device, which is no measure for the next.
  warming_ = picture.use(scene_->scene, apart ? small : shown.kernels, code_);
  facts_.accel = accel_name(apart ? small.accel : shown.kernels.accel);
  return picture;
}

void Viewer::trace_moving(const Shown& now) {
  swapchain_.wait();
  traced_.reset();
  facts_.work.reset();
  double scale = pacer_.scale(settings_.frame_ms);
  const auto side = [&](uint32_t pixels) {
    return std::max(1U, static_cast<uint32_t>(std::lround(pixels * scale)));
  };
  Picture& picture = picture_for(now, scale);
  while (scale > Pacer::kLeast && !picture.can_hold(side(now.width), side(now.height))) {
    scale *= 0.5;
  }
  trace_at(picture, side(now.width), side(now.height), true);
  statistics_.moving_part.push_back(static_cast<double>(picture.width()) * picture.height() /
                                    (static_cast<double>(now.width) * now.height));
  moved_ = true;
  traced_ = now;
  side_ = picture.width() == now.width ? 1 : 0;
  changed_ = Clock::now();
}

void Viewer::trace() {
  if (!scene_) return;
  try {
    const Shown now = shown_now();
    if (!traced_ || *traced_ != now) {
      if (failed_ == now) return;
      failed_ = now;
      trace_moving(now);
    } else if (const uint32_t most = samples_when_still();
               side_ != most && seconds_between(changed_, Clock::now()) >= kStill) {
      if (failed_ == now) return;
      swapchain_.wait();
      const uint32_t side = side_ == 0 ? 1 : most;
      failed_ = now;
      if (!trace_at(picture_for(now, 1.0), now.width * side, now.height * side, false)) {
        failed_.reset();
        // A moving picture of its own is still there; without one the window keeps what it shows.
        if (!front_->is_there()) {
          traced_.reset();
          keeps_ = true;
        }
        return;
      }
      side_ = side;
    } else {
      return;
    }
    failed_.reset();
    if (side_ == samples_when_still() && now.kernels.counts) count_work();
  } catch (const UsageError& error) {
    complain(error.what());
  } catch (const DeviceError& error) {
    if (!traced_ && statistics_.frames == 0) throw;
    complain(error.what());
  }
}

// What failed is not tried again until something changes.
void Viewer::complain(const std::string& message) {
  facts_.message = message;
  redraws_ = 3;
  if (!front_->is_there()) traced_.reset();
}

void Viewer::count_work() {
  Frame frame;
  front_->fetch(frame);
  const WorkCounts work = work_of(frame);
  const auto pixels = static_cast<double>(frame.aovs.size());
  facts_.work = Work{static_cast<double>(work.evaluations) / pixels,
                     static_cast<double>(work.candidates) / pixels};
}

ScreenPush Viewer::screen_push() const {
  ScreenPush push{};
  push.width = swapchain_.extent().width;
  push.height = swapchain_.extent().height;
  push.frame_width = 1;
  push.frame_height = 1;
  push.high = 1.0F;
  if (shows_errors()) {
    push.frame_width = error_map_.width;
    push.frame_height = error_map_.height;
    push.shown = SHOWN_ERROR;
    push.low = -9.0F;
    push.high = -3.0F;
  } else if (front_->is_there()) {
    push.frame_width = front_->width();
    push.frame_height = front_->height();
    const bool as_colors = settings_.shown == SHOWN_ERROR || !front_->has_aovs();
    push.shown = as_colors ? SHOWN_COLOR : settings_.shown;
    const double distance = glm::distance(navigator_.camera().eye, scene_->scene->origin);
    if (push.shown == SHOWN_DEPTH) {
      push.low = static_cast<float>(std::max(0.0, distance - scene_->scene->radius));
      push.high = static_cast<float>(distance + scene_->scene->radius);
    }
    if (push.shown == SHOWN_EVALUATIONS) push.high = 16.0F;
  }
  return push;
}

void Viewer::show() {
  if (std::exchange(keeps_, false)) return;
  if (redraws_ == 0 && !options_.frames) return;
  swapchain_.wait();
  const gpu::Buffer* colors = front_->is_there() ? &front_->colors() : &unused_;
  const gpu::Buffer* aovs = front_->is_there() ? &front_->aovs() : &unused_;
  const uint32_t width = window_.width();
  const uint32_t height = window_.height();
  if (!texture_ || texture_->width() < width || texture_->height() < height) {
    texture_.emplace(device_, width, height, "frame");
    copied_ = false;
  }
  pass_.bind({shows_errors() ? &*error_buffer_ : colors, aovs}, *texture_);
  const bool shown = swapchain_.show(
      width, height,
      [&](VkCommandBuffer commands) {
        if (std::exchange(copied_, true)) return;
        const bool fits = front_->is_there() && front_->width() <= texture_->width() &&
                          front_->height() <= texture_->height();
        // Something has to be in it, also if no frame fits.
        texture_->copy(commands, *colors, fits ? front_->width() : 1, fits ? front_->height() : 1);
      },
      [&](VkCommandBuffer commands) {
        const ScreenPush push = screen_push();
        pass_.draw(commands, std::as_bytes(std::span(&push, 1)));
        PanelLayer::draw(commands);
      });
  if (!shown) return;
  redraws_ = std::max(redraws_ - 1, 0);
  if (!scene_) return;
  ++statistics_.frames;
  // Drivers compile on the way to the first frames: with the third all is there.
  if (first_frame_ || statistics_.frames < 3) return;
  first_frame_ = Clock::now();
  entitle();
}

void Viewer::entitle() {
  glfwSetWindowTitle(window_.get(), ("trisect: " + model_name(scene_->request.model)).c_str());
}

}  // namespace trisect::view
