#include "panel.h"

#include <alpenglow/io/scene_file.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "controls.h"
#include "parameters.h"
#include "table_pictures.h"
#include "widgets.h"

namespace alpenglow::view {
namespace {

const ImVec4 kWarning = {1.0f, 0.75f, 0.3f, 1.0f};
constexpr double kMessageSeconds = 15.0;
constexpr double kDegrees = 180.0 / std::numbers::pi;

void showState(const PanelFacts& facts) {
  ImGui::TextDisabled("%s", facts.device.c_str());
  if (facts.resting) {
    ImGui::Text("at rest, %u x %u; the last frame: %.1f ms", facts.drawn.width, facts.drawn.height,
                double{facts.frame_ms});
  } else {
    ImGui::Text("%.1f ms, %.0f a second, %u x %u", double{facts.frame_ms},
                facts.frame_ms > 0.0f ? 1e3 / double{facts.frame_ms} : 0.0, facts.drawn.width,
                facts.drawn.height);
  }
  const BakeProgress& bake = facts.baker->progress();
  if (facts.baker->idle()) return ImGui::ProgressBar(0.0f, {-1.0f, 0.0f}, "tables baked");
  const float share = bake.unitsTotal == 0
                          ? 0.0f
                          : static_cast<float>(double(bake.unitsDone) / double(bake.unitsTotal));
  char text[64];
  std::snprintf(text, sizeof text, "%s, pass %u of %u", facts.baker->draft() ? "draft" : "baking",
                bake.passIndex + 1, std::max(bake.passCount, 1u));
  ImGui::ProgressBar(share, {-1.0f, 0.0f}, text);
}

// Over the picture, so that the panel's widgets stay where they are.
void showMessages(const State& state, const std::string& trouble) {
  if (state.message.empty() && trouble.empty()) return;
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({size.x - 8.0f, 8.0f}, ImGuiCond_Always, {1.0f, 0.0f});
  ImGui::Begin("messages", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                   ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PushTextWrapPos(0.5f * size.x);
  ImGui::PushStyleColor(ImGuiCol_Text, kWarning);
  for (const std::string& text : {state.message, trouble}) {
    if (!text.empty()) ImGui::TextUnformatted(text.c_str());
  }
  ImGui::PopStyleColor();
  ImGui::PopTextWrapPos();
  ImGui::End();
}

void showTime(State* state) {
  const double tilt = declination(state->scene) * kDegrees;
  constexpr double kDay[2] = {0.0, 24.0}, kSeasons[2] = {-23.44, 23.44};
  const auto hours = edited(state, "time of day", "time", timeOfDay(state->scene), kDay, "%.2f h");
  const auto tilted = edited(state, "sun's declination", "declination", tilt, kSeasons, "%.1f deg");
  hint("Of the season: +23.44 on June 21, 0 at the equinoxes. The arrow keys may go beyond.");
  if (hours || tilted) {
    setTimeOfDay(&state->scene, hours.value_or(timeOfDay(state->scene)),
                 tilted.value_or(tilt) / kDegrees);
  }
}

void showPicture(State* state, const PanelFacts& facts) {
  bool automatic = !state->scene.exposure.has_value();
  if (ImGui::Checkbox("automatic exposure", &automatic)) {
    state->scene.exposure.reset();
    if (!automatic) state->scene.exposure = facts.exposure;
  }
  float stops = static_cast<float>(std::log2(facts.exposure));
  if (ImGui::SliderFloat("exposure", &stops, -10.0f, 30.0f, "%+.2f stops")) {
    state->scene.exposure = std::exp2(double{stops});
  }
  combo(state, "tone_map", "tone map");
  ImGui::SliderFloat3("colour balance", state->balance, 0.25f, 4.0f, "%.2f",
                      ImGuiSliderFlags_Logarithmic);
  hint("Factors on red, green and blue, before the tone map; not in the linear EXR.");
  if (ImGui::Button("no balance")) std::fill_n(state->balance, 3, 1.0f);
}

void showMethod(State* state, const PanelFacts& facts) {
  combo(state, "model", "model");
  if (!io::solverOf(state->scene.model)) {  // The simpler models have none of these.
    combo(state, "solver", "solver");
    if (state->scene.solver != Solver::Standard) combo(state, "quality", "quality");
    combo(state, "orders", "orders");
  }
  combo(state, "shafts", "light shafts");
  if (facts.baked == nullptr) return;
  const Plan& plan = facts.baked->plan;
  const char* limit = modelLimit(plan.tables.solver);
  if (limit[0] != '\0') ImGui::TextWrapped("%s", limit);
  // With all orders: orders left out by choice are no error of the tables.
  if (plan.expectedError > 0.0 && !state->scene.orders) {
    ImGui::Text("error expected: up to %.2f %%", 100.0 * plan.expectedError);
    hint(
        "Of the radiance of 95 rays in 100, with the sun in the band where it is worst: measured "
        "against path-traced light, docs/accuracy.md.");
  }
  ImGui::Text("tables: %.2f MB, while baking %.1f MB more", 1e-6 * double(plan.cost.bytes),
              1e-6 * double(plan.cost.bakeBytes));
  for (uint32_t i = kEffectCount; i < plan.choiceCount; ++i) {
    std::string name = plan.choices[i].name;
    std::replace(name.begin(), name.end(), '_', ' ');
    ImGui::BulletText("%s: %s", name.c_str(), plan.choices[i].value);
    hint(plan.choices[i].reason);
  }
}

void showEffects(State* state, const PanelFacts& facts) {
  if (facts.baked == nullptr) return;
  const Plan& plan = facts.baked->plan;
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    const std::string name = effectName(static_cast<Effect>(i));
    const PlanChoice& choice = plan.choices[i];
    ImGui::SetNextItemWidth(0.3f * ImGui::GetContentRegionAvail().x);
    combo(state, ("effects." + name).c_str(), ("##" + name).c_str());
    ImGui::SameLine();
    if (choice.on) {
      ImGui::Text("%s: on", name.c_str());
    } else {
      ImGui::TextDisabled("%s: off", name.c_str());
    }
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextDisabled("%s", choice.reason);
    ImGui::PopTextWrapPos();
    if (choice.saves.units > 0) {
      ImGui::TextDisabled("saves %.2f MB and %.3g units of a bake",
                          1e-6 * double(choice.saves.bytes), double(choice.saves.units));
    } else if (choice.saves.bytes > 0) {
      ImGui::TextDisabled("saves %.2f MB", 1e-6 * double(choice.saves.bytes));
    }
  }
}

void showCost(const PanelFacts& facts) {
  for (const auto& [name, history] : facts.timer->passes()) {
    const auto& all = history.milliseconds;
    const float most = std::max(*std::max_element(all.begin(), all.end()), 0.1f);
    char label[64];
    std::snprintf(label, sizeof label, "%.2f ms %s", double{history.last}, name.c_str());
    ImGui::PlotHistogram(("##" + name).c_str(), all.data(), static_cast<int>(all.size()), 0,
                         nullptr, 0.0f, most, {0.0f, 1.6f * ImGui::GetTextLineHeight()});
    ImGui::SameLine();
    ImGui::TextUnformatted(label);
  }
  const ResourceReport& r = facts.resources;
  ImGui::Text("device memory %.2f MB (most: %.2f MB)", 1e-6 * double(r.bytes),
              1e-6 * double(r.peakBytes));
  ImGui::Text("%llu images, %llu buffers, %llu pipelines",
              static_cast<unsigned long long>(r.images), static_cast<unsigned long long>(r.buffers),
              static_cast<unsigned long long>(r.pipelines));
  if (facts.baked != nullptr) {
    const Plan& plan = facts.baked->plan;
    for (uint32_t i = 0; i < plan.imageCount; ++i) {
      const ImageInfo& table = plan.images[i];
      ImGui::BulletText("%s, %u x %u x %u: %.2f MB", table.name, table.extent.width,
                        table.extent.height, table.extent.depth, 1e-6 * double(table.bytes));
    }
  }
  ImGui::PushTextWrapPos(0.0f);
  ImGui::TextDisabled("Where nothing moves nothing is drawn, and a pass shows its last time.");
  ImGui::PopTextWrapPos();
}

void showHelp(const PanelFacts& facts) {
  ImGui::SetNextWindowPos(
      {0.5f * ImGui::GetIO().DisplaySize.x, 0.5f * ImGui::GetIO().DisplaySize.y}, ImGuiCond_Always,
      {0.5f, 0.5f});
  ImGui::Begin("Keys", nullptr, ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
  if (ImGui::BeginTable("keys", 2)) {
    for (const Binding& binding : *facts.bindings) {
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(keyName(binding.key).c_str());
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(binding.what);
    }
    ImGui::TableNextColumn();
    ImGui::TextUnformatted("Mouse, left button");
    ImGui::TableNextColumn();
    ImGui::TextUnformatted("look around");
    ImGui::EndTable();
  }
  ImGui::End();
}

void showCaption(const std::string& caption) {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * size.x, 0.95f * size.y}, ImGuiCond_Always, {0.5f, 1.0f});
  ImGui::Begin("caption", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                   ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::TextUnformatted(caption.c_str());
  ImGui::End();
}

}  // namespace

Panel::Panel(const samples::Gpu* gpu, VkRenderPass renderPass)
    : tables_(std::make_unique<TablePictures>(gpu, renderPass)) {}
Panel::~Panel() = default;

void Panel::make(State* state, const PanelFacts& facts) {
  if (!facts.caption.empty()) showCaption(facts.caption);
  if (state->help) showHelp(facts);
  if (state->message != message_) messageSince_ = ImGui::GetTime();
  if (ImGui::GetTime() - messageSince_ > kMessageSeconds) state->message.clear();
  message_ = state->message;
  showMessages(*state, facts.trouble);
  if (!state->panel) return;
  const ImGuiIO& io = ImGui::GetIO();
  const float width = std::min(26.0f * ImGui::GetFontSize(), 0.6f * io.DisplaySize.x);
  ImGui::SetNextWindowPos({0.0f, 0.0f}, ImGuiCond_FirstUseEver);
  // As high as the program's window, whenever that changes.
  const bool other = io.DisplaySize.x != window_[0] || io.DisplaySize.y != window_[1];
  ImGui::SetNextWindowSize({width, io.DisplaySize.y},
                           other ? ImGuiCond_Always : ImGuiCond_FirstUseEver);
  window_[0] = io.DisplaySize.x;
  window_[1] = io.DisplaySize.y;
  ImGui::Begin("Alpenglow");
  ImGui::PushItemWidth(0.55f * ImGui::GetContentRegionAvail().x);
  showState(facts);
  const std::vector<std::string> wanted = std::exchange(state->sections, {});
  const auto section = [&](const std::string& title, bool open) {
    if (!wanted.empty()) {
      const std::string first = title.substr(0, title.find(' '));
      ImGui::SetNextItemOpen(std::find(wanted.begin(), wanted.end(), first) != wanted.end());
    }
    return ImGui::CollapsingHeader(title.c_str(), open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
  };
  if (section("Sun and camera", true)) {
    showTime(state);
    combo(state, "stars", "stars");
    sliders(state, false);
  }
  if (section("Picture", true)) showPicture(state, facts);
  if (section("Atmosphere", false)) {
    combo(state, "preset", "preset");
    constexpr double kHaze[2] = {1.0, 20.0};
    const auto haze =
        edited(state, "turbidity", "turbidity", turbidity(state->scene.atmosphere), kHaze, "%.2f");
    hint("Optical depth of the whole atmosphere over that of its molecules, in green.");
    if (haze) setTurbidity(&state->scene.atmosphere, std::clamp(*haze, kHaze[0], kHaze[1]));
    sliders(state, true);
  }
  if (section("Method", false)) showMethod(state, facts);
  if (section("Effects", false)) showEffects(state, facts);
  if (section("Tables", false) && facts.baked != nullptr) {
    tables_->make(facts.baked->tables.get(), facts.baked->desc);
  }
  if (section("Cost", false)) showCost(facts);
  ImGui::Separator();
  if (ImGui::Button("Back to the start")) press(state, Action::Reset, false);
  ImGui::SameLine();
  if (ImGui::Button("Keys (F1)")) state->help = !state->help;
  ImGui::SameLine();
  if (ImGui::Button("Copy the scene")) {
    ImGui::SetClipboardText(io::formatScene(state->scene).c_str());
    state->message = "The scene is on the clipboard, as JSON.";
  }
  ImGui::PopItemWidth();
  ImGui::End();
}

}  // namespace alpenglow::view
