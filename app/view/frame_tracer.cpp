#include "app/view/frame_tracer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/base/error.h"
#include "app/base/stopwatch.h"
#include "app/cli/interrupt.h"
#include "app/cli/load_scene.h"
#include "app/cli/statistics.h"
#include "app/frame/supersampling.h"

namespace trisect::view {
namespace {

// Which kernels are the fastest for moving frames is judged by frames of half of the window's
// sides, whatever their scale, so that it does not change while something moves. If slower kernels
// were chosen than at full resolution, the frames would stay small for their sake.
constexpr uint32_t kWindowOverMovingFrame = 2;

}  // namespace

FrameTracer::FrameTracer(const gpu::Device& device, const Window& window, Screen& screen,
                         ViewState& state, FrameScheduler& scheduler)
    : window_(window),
      screen_(screen),
      state_(state),
      scheduler_(scheduler),
      still_(device),
      moving_(device) {}

uint32_t FrameTracer::samples_at_rest() const {
  const Settings& settings = state_.settings;
  uint32_t side = settings.shown == SHOWN_COLOR ? samples_across(settings.render.spp) : 1;
  while (side > 0 && !still_.can_hold(window_.width() * side, window_.height() * side)) --side;
  return side;
}

std::optional<FrameTracer::Target> FrameTracer::choose_target(const FrameContent& wanted,
                                                              double scale) {
  const bool was_waiting = std::exchange(is_waiting_, false);
  const KernelChoice reduced =
      state_.kernel_choice(std::max(wanted.width / kWindowOverMovingFrame, 1U),
                           std::max(wanted.height / kWindowOverMovingFrame, 1U));
  const auto use = [&](Picture& picture, const KernelChoice& kernels) -> std::optional<Target> {
    const Picture::Use used =
        picture.use(state_.model.shared_scene(), kernels, state_.kernels.code());
    if (used == Picture::Use::soon) return std::nullopt;
    state_.facts.accel = accel_name(kernels.accel);
    return Target{&picture, used == Picture::Use::anew};
  };
  std::optional<Target> target;
  if (scale < 1.0 && reduced != wanted.kernels) target = use(moving_, reduced);
  // The refinement comes next.
  if (target) still_.prepare(state_.model.shared_scene(), wanted.kernels, state_.kernels.code());
  // Kernels that are there are better than the best ones that are not.
  if (!target) target = use(still_, wanted.kernels);
  if (target) return target;
  is_waiting_ = true;
  scheduler_.postponed();
  // The panel tells about it.
  if (!was_waiting) scheduler_.request_draws(FrameScheduler::kDrawsForPanel);
  return std::nullopt;
}

FrameTracer::Result FrameTracer::trace(const KeepGoing& may_refine, bool has_shown_a_frame) {
  Result result;
  if (!state_.model.is_loaded()) return result;
  try {
    const FrameContent wanted = state_.content(window_.width(), window_.height());
    const FrameScheduler::Plan plan =
        scheduler_.plan(wanted, samples_at_rest(), state_.settings.frame_ms, Clock::now());
    if (plan.step == FrameScheduler::Step::nothing) return result;
    if (plan.step == FrameScheduler::Step::moving) {
      result.moving = trace_moving(wanted, plan);
      if (!result.moving) return result;
    } else if (!refine(wanted, plan, may_refine)) {
      result.frame_was_lost = !front_->is_there();
      return result;
    }
    if (wanted.kernels.counts && scheduler_.is_refined(samples_at_rest())) count_work();
  } catch (const UsageError& error) {
    report_failure(error.what());
  } catch (const DeviceLost&) {
    throw;
  } catch (const DeviceError& error) {
    if (!scheduler_.has_frame() && !has_shown_a_frame) throw;
    report_failure(error.what());
  }
  return result;
}

// Nothing if the user interrupted the program, or kernels are being made.
std::optional<MovingFrame> FrameTracer::trace_moving(const FrameContent& wanted,
                                                     const FrameScheduler::Plan& plan) {
  scheduler_.begin(plan, wanted);
  screen_.wait();
  state_.facts.work.reset();
  double scale = plan.scale;
  const auto scaled = [&](uint32_t pixels) {
    return std::max(1U, static_cast<uint32_t>(std::lround(pixels * scale)));
  };
  const std::optional<Target> target = choose_target(wanted, scale);
  if (!target) return std::nullopt;
  Picture& picture = *target->picture;
  while (scale > Pacer::kLeast && !picture.can_hold(scaled(wanted.width), scaled(wanted.height))) {
    scale *= 0.5;
  }
  // Input does not stop such a frame, or a slow device would show nothing while something moves.
  const std::optional<double> ms =
      trace_into(picture, scaled(wanted.width), scaled(wanted.height), {});
  if (!ms) return std::nullopt;
  scheduler_.moving_frame_done(wanted, picture.width() == wanted.width, Clock::now());
  const double part = static_cast<double>(picture.width()) * picture.height() /
                      (static_cast<double>(wanted.width) * wanted.height);
  return MovingFrame{part, *ms, target->is_new};
}

// False if it was stopped.
bool FrameTracer::refine(const FrameContent& wanted, const FrameScheduler::Plan& plan,
                         const KeepGoing& may_refine) {
  screen_.wait();
  scheduler_.begin(plan, wanted);
  const uint32_t side = plan.samples_across;
  const std::optional<Target> target = choose_target(wanted, 1.0);
  if (!target) return true;
  if (!trace_into(*target->picture, wanted.width * side, wanted.height * side, may_refine)) {
    // If the moving frame is a picture of its own, it is still there.
    scheduler_.refinement_stopped(front_->is_there());
    return false;
  }
  scheduler_.refinement_done(side);
  return true;
}

// Returns milliseconds; nothing if it was stopped.
std::optional<double> FrameTracer::trace_into(Picture& picture, uint32_t width, uint32_t height,
                                              const KeepGoing& keep_going) {
  screen_.wait();
  const TraceSettings settings =
      settings_of(state_.render_options(width, height), state_.model.mesh(), state_.model.scene());
  const Stopwatch watch;
  const bool finished =
      picture.trace(settings, [&] { return not_interrupted() && may_go_on(keep_going); });
  if (!finished) return std::nullopt;
  const double ms = watch.milliseconds();
  front_ = &picture;
  screen_.picture_changed();
  state_.facts.trace_ms = ms;
  state_.facts.frame_width = width;
  state_.facts.frame_height = height;
  // The panel of this loop was built before the frame: the next one tells about it.
  scheduler_.request_draws(FrameScheduler::kDrawsForTracedFrame);
  return ms;
}

void FrameTracer::report_failure(const std::string& message) {
  state_.facts.message = message;
  scheduler_.failed(front_->is_there());
}

void FrameTracer::count_work() {
  Frame frame;
  front_->fetch(frame);
  const WorkCounts work = work_of(frame);
  const auto pixels = static_cast<double>(frame.aovs.size());
  state_.facts.work = Work{static_cast<double>(work.evaluations) / pixels,
                           static_cast<double>(work.candidates) / pixels};
}

void FrameTracer::prepare(const std::shared_ptr<const KernelCode>& code) {
  screen_.wait();
  const KernelChoice kernels = state_.kernel_choice(window_.width(), window_.height());
  while (still_.use(state_.model.shared_scene(), kernels, code) == Picture::Use::soon) {
    still_.wait();
  }
}

}  // namespace trisect::view
