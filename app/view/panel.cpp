#include "app/view/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "app/mesh/obj_file.h"

namespace trisect::view {
namespace {

constexpr std::array<const char*, 8> kShownNames{
    "colour", "shading normal", "geometric normal",        "depth", "patch",
    "u v",    "evaluations",    "error against the oracle"};

void text(const std::string& line) {
  ImGui::TextWrapped("%s", line.c_str());
}

// A combo box for a value that is an index into the names.
template <typename Names>
void choose(const char* label, uint& value, const Names& names) {
  if (!ImGui::BeginCombo(label, names[value])) return;
  for (uint i = 0; i < names.size(); ++i) {
    if (ImGui::Selectable(names[i], i == value)) value = i;
  }
  ImGui::EndCombo();
}

// A slider for a double. ImGui's sliders are of floats: the value is only written when the user
// moves the slider. Returns whether that was so.
bool slide(const char* label, double& value, double least, double most, const char* format) {
  auto shown = static_cast<float>(value);
  if (!ImGui::SliderFloat(label, &shown, static_cast<float>(least), static_cast<float>(most),
                          format, ImGuiSliderFlags_AlwaysClamp)) {
    return false;
  }
  // By the shortest decimal of this float, so that copied flags read 0.1 and not
  // 0.10000000149011612.
  value = std::stod(fmt::format("{}", shown));
  return true;
}

void choose_model(const Settings& settings, const Facts& facts, Requests& requests) {
  const auto entries = [&](const std::vector<std::string>& files) {
    for (const std::string& file : files) {
      const bool chosen = file == settings.render.model;
      if (ImGui::Selectable(fmt::format("{}##{}", model_name(file), file).c_str(), chosen)) {
        requests.open = file;
      }
    }
  };
  if (ImGui::BeginCombo("model", model_name(settings.render.model).c_str())) {
    entries(facts.models);
    if (!facts.recent.empty()) ImGui::Separator();
    // A file may be in both lists, but ImGui needs distinct identifiers.
    ImGui::PushID("recent");
    entries(facts.recent);
    ImGui::PopID();
    ImGui::EndCombo();
  }
  if (facts.loading) {
    text("loading ...");
  } else if (facts.making_kernels) {
    text("making kernels ...");
  } else {
    text(facts.model);
  }
}

void choose_surface(Settings& settings, const Facts& facts) {
  RenderOptions& render = settings.render;
  choose("surface", render.surface, std::array{"flat", "phong", "sphere"});
  if (render.surface == SURFACE_PHONG) slide("alpha", render.alpha, 0.0, 1.0, "%.2f");
  choose("shell", render.shell, std::array{"height", "normal"});
  choose("solver", render.solver, std::array{"bisect", "robust"});
  if (render.solver == SOLVER_BISECT) {
    auto rank = static_cast<int>(render.rank);
    ImGui::SliderInt("Rank", &rank, 1, 60, "%d", ImGuiSliderFlags_AlwaysClamp);
    render.rank = static_cast<uint32_t>(rank);
    // Only the robust solver has these.
    render.shadows = false;
    render.accel.reset();
    return;
  }
  uint accel = render.accel ? 1U + static_cast<uint>(*render.accel) : 0U;
  if (facts.ray_query) {
    choose("accel", accel, std::array{"auto", "list", "tiles", "bvh", "rayquery"});
  } else {
    choose("accel", accel, std::array{"auto", "list", "tiles", "bvh"});
  }
  render.accel = accel == 0U ? std::nullopt : std::optional(static_cast<Accel>(accel - 1U));
  ImGui::Checkbox("shadows", &render.shadows);
}

// What colours the surface has. Shadows need light.
void choose_shading(Settings& settings) {
  RenderOptions& render = settings.render;
  const uint before = render.shading.value_or(SHADING_PLAIN);
  uint shading = before;
  choose("shading", shading, std::array{"plain", "grid", "normal", "patch", "depth"});
  if (shading != before) render.shading = shading;
  if (!is_lit(shading)) {
    render.shadows = false;
    render.color.reset();
    return;
  }
  glm::vec3 color(render.color.value_or(standard_color(shading)));
  if (ImGui::ColorEdit3("color", &color.x)) {
    render.color = glm::dvec3(glm::clamp(color, 0.0F, 1.0F));
  }
}

// What is behind it. A window shows what is transparent as black.
void choose_background(RenderOptions& render) {
  uint background = render.background ? 1U + static_cast<uint>(*render.background) : 0U;
  choose("background", background, std::array{"by shading", "sky", "colour", "transparent"});
  render.background =
      background == 0U ? std::nullopt : std::optional(static_cast<Background>(background - 1U));
  if (render.background != Background::color) return;
  glm::vec3 color(render.background_color);
  if (ImGui::ColorEdit3("behind", &color.x)) {
    render.background_color = glm::dvec3(glm::clamp(color, 0.0F, 1.0F));
  }
}

void choose_light(Settings& settings) {
  glm::dvec3 light = settings.render.light.value_or(glm::dvec3(0.35, 0.8, 0.5));
  bool changed = slide("light x", light.x, -1.0, 1.0, "%.2f");
  changed = slide("light y", light.y, -1.0, 1.0, "%.2f") || changed;
  changed = slide("light z", light.z, -1.0, 1.0, "%.2f") || changed;
  if (changed && light != glm::dvec3(0.0)) settings.render.light = light;
}

void choose_output(Settings& settings, const Facts& facts, Requests& requests) {
  choose("shown", settings.shown, kShownNames);
  if (settings.shown == SHOWN_EVALUATIONS) text("dark blue: 0 evaluations, red: 16 or more");
  if (settings.shown == SHOWN_ERROR) {
    text(
        "dark blue: 1e-9 of the radius or less, red: 1e-3 or more; magenta: wrong or missed; "
        "grey: undecided");
  }
  if (facts.error_progress) {
    ImGui::ProgressBar(*facts.error_progress);
  } else if (ImGui::Button("measure the error")) {
    requests.measure_error = true;
  }
  if (!facts.error.empty()) text(facts.error);
  constexpr std::array<uint32_t, 4> samples{1, 4, 9, 16};
  auto chosen = static_cast<uint>(std::find(samples.begin(), samples.end(), settings.render.spp) -
                                  samples.begin());
  choose("rays a pixel", chosen, std::array{"1", "4", "9", "16"});
  settings.render.spp = samples[chosen];
}

void show_timings(Settings& settings, const Facts& facts) {
  text(fmt::format("{}\n{}", facts.device, facts.driver));
  if (facts.frame_width > 0) {
    text(fmt::format("{}x{} rays by {}, {:.1f} ms", facts.frame_width, facts.frame_height,
                     facts.accel, facts.trace_ms));
  }
  if (!facts.frame_ms.empty()) {
    ImGui::PlotLines("ms a frame", facts.frame_ms.data(), static_cast<int>(facts.frame_ms.size()),
                     0, nullptr, 0.0F, 2.0F * static_cast<float>(settings.frame_ms),
                     ImVec2(0.0F, 48.0F));
  }
  slide("moving, ms", settings.frame_ms, 5.0, 500.0, "%.0f");
  ImGui::Checkbox("count work", &settings.counts);
  if (facts.work) {
    text(fmt::format("a pixel: {:.2f} evaluations, {:.2f} candidates", facts.work->evaluations,
                     facts.work->candidates));
  }
}

void offer_files(Settings& settings, const Facts& facts, Requests& requests) {
  std::array<int, 2> size{static_cast<int>(settings.render.width),
                          static_cast<int>(settings.render.height)};
  if (ImGui::InputInt2("size", size.data())) {
    settings.render.width = static_cast<uint32_t>(std::clamp(size[0], 1, 16384));
    settings.render.height = static_cast<uint32_t>(std::clamp(size[1], 1, 16384));
  }
  if (ImGui::Button("save (F12)")) requests.save = true;
  ImGui::SameLine();
  ImGui::Checkbox("EXR", &settings.exr);
  ImGui::SameLine();
  text(facts.save_file);
  if (ImGui::Button("copy flags (Ctrl+C)")) requests.copy = true;
  ImGui::SameLine();
  if (ImGui::Button("paste (Ctrl+V)")) requests.paste = true;
  if (ImGui::Button("frame the model (F)")) requests.frame_model = true;
  ImGui::SameLine();
  if (ImGui::Button("reload shaders (F5)")) requests.reload_shaders = true;
}

void build_key_list() {
  ImGui::SetNextWindowPos(ImVec2(ImGui::GetIO().DisplaySize.x - 10.0F, 10.0F), ImGuiCond_Always,
                          ImVec2(1.0F, 0.0F));
  ImGui::Begin("keys", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove);
  constexpr std::array<std::array<const char*, 2>, 12> keys{{
      {"W A S D", "walk"},
      {"Space, Shift", "up, down"},
      {"left button", "look around; Esc lets go"},
      {"wheel", "speed; in orbit the distance"},
      {"O", "orbit around the target, or walk"},
      {"F", "frame the model"},
      {"1 to 8", "what is shown"},
      {"Tab", "the panel"},
      {"Ctrl+C, Ctrl+V", "copy, paste the flags of trisect render"},
      {"F5", "compile the shaders anew"},
      {"F12", "save a picture"},
      {"H", "this list"},
  }};
  for (const auto& key : keys) ImGui::Text("%-15s %s", key[0], key[1]);
  ImGui::End();
}

}  // namespace

std::optional<uint> shown_named(const std::string& name) {
  const auto* const found = std::find(kShownNames.begin(), kShownNames.end(), name);
  if (found == kShownNames.end()) return std::nullopt;
  return static_cast<uint>(found - kShownNames.begin());
}

Requests build_panel(Settings& settings, const Facts& facts) {
  Requests requests;
  if (settings.show_keys) build_key_list();
  if (!settings.panel) return requests;
  ImGui::SetNextWindowPos(ImVec2(10.0F, 10.0F), ImGuiCond_FirstUseEver);
  ImGui::SetNextWindowSize(ImVec2(300.0F, 0.0F), ImGuiCond_FirstUseEver);
  ImGui::Begin("trisect (H: keys)", &settings.panel);
  ImGui::PushItemWidth(-90.0F);
  choose_model(settings, facts, requests);
  if (!facts.message.empty()) text(facts.message);
  ImGui::Separator();
  choose_surface(settings, facts);
  choose_shading(settings);
  choose_background(settings.render);
  choose_light(settings);
  ImGui::Checkbox("orbit", &settings.orbit);
  ImGui::Separator();
  choose_output(settings, facts, requests);
  ImGui::Separator();
  show_timings(settings, facts);
  ImGui::Separator();
  offer_files(settings, facts, requests);
  ImGui::PopItemWidth();
  ImGui::End();
  return requests;
}

}  // namespace trisect::view
