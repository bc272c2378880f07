#include "panel.h"

#include <alpenglow/io/scene_file.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "choices.h"
#include "controls.h"
#include "parameters.h"
#include "table_pictures.h"

namespace alpenglow::view {
namespace {

const ImVec4 kWarning = {1.0f, 0.75f, 0.3f, 1.0f};
constexpr double kDegrees = 180.0 / std::numbers::pi;

void combo(State* state, const char* name, const char* label) {
  const Choice* choice = findChoice(name);
  const size_t now = choice->get(*state);
  const char* shown = now < choice->values.size() ? choice->values[now].c_str() : "(own values)";
  if (!ImGui::BeginCombo(label, shown)) return;
  for (size_t i = 0; i < choice->values.size(); ++i) {
    if (ImGui::Selectable(choice->values[i].c_str(), i == now)) choice->set(state, i);
  }
  ImGui::EndCombo();
}

void hint(const char* text) {
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", text);
}

// How a number is shown. Coefficients are so small that ImGui would round them; radii are
// so large that 4 digits don't tell them apart.
struct Display {
  double factor = 1.0;
  std::string format;
};
Display displayOf(const Parameter& parameter) {
  const std::string unit = parameter.unit;
  if (unit == "1/m") return {1e6, "%.4g e-6/m"};
  const std::string digits = parameter.most > 1e6 ? "%.8g" : "%.4g";
  return {1.0, digits + (unit.empty() || unit.size() > 3 ? "" : " " + unit)};
}

// A slider over a parameter; a value that isn't allowed is left out, with the reason.
void slider(State* state, const Parameter& parameter, const char* label) {
  if (parameter.find(state->scene) == nullptr) return;
  const Display display = displayOf(parameter);
  double value = parameter.get(state->scene) * display.factor;
  const double least = parameter.least * display.factor, most = parameter.most * display.factor;
  const ImGuiSliderFlags flags =
      parameter.logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
  const bool changed = ImGui::SliderScalar(label, ImGuiDataType_Double, &value, &least, &most,
                                           display.format.c_str(), flags);
  char range[200];
  std::snprintf(range, sizeof range, "%s: %g to %g %s, now %g. Ctrl and click to type%s.",
                parameter.name.c_str(), parameter.least, parameter.most, parameter.unit,
                parameter.get(state->scene), display.factor != 1.0 ? " millionths" : "");
  hint(range);
  if (!changed) return;
  const io::Scene before = state->scene;
  parameter.set(&state->scene, value / display.factor);
  state->message = whyInvalid(state->scene);
  if (!state->message.empty()) state->scene = before;
}

// All parameters of the air, or all others, under their groups' names.
void sliders(State* state, bool ofAir) {
  std::string group;
  for (const Parameter& parameter : parameters()) {
    if (parameter.ofAir != ofAir || parameter.find(state->scene) == nullptr) continue;
    if (group != parameter.group) {
      group = parameter.group;
      if (!group.empty()) ImGui::TextDisabled("%s", group.c_str());
    }
    const size_t skip = group.empty() ? 0 : group.size() + 1;
    const std::string label = parameter.name.substr(skip) + "##" + parameter.name;
    slider(state, parameter, label.c_str());
  }
}

void showState(const State& state, const PanelFacts& facts) {
  ImGui::TextDisabled("%s", facts.device.c_str());
  ImGui::Text("%.1f ms  %.0f fps  %u x %u", double{facts.frame_ms},
              facts.frame_ms > 0.0f ? 1e3 / double{facts.frame_ms} : 0.0, facts.drawn.width,
              facts.drawn.height);
  if (facts.baker->idle()) {
    ImGui::ProgressBar(1.0f, {-1.0f, 0.0f}, "tables baked");
  } else {
    const BakeProgress& bake = facts.baker->progress();
    const float share = bake.unitsTotal == 0
                            ? 0.0f
                            : static_cast<float>(double(bake.unitsDone) / double(bake.unitsTotal));
    ImGui::ProgressBar(share, {-1.0f, 0.0f}, (std::string("baking ") + bake.pass).c_str());
  }
  for (const std::string& text : {state.message, facts.trouble}) {
    if (text.empty()) continue;
    ImGui::PushStyleColor(ImGuiCol_Text, kWarning);
    ImGui::TextWrapped("%s", text.c_str());
    ImGui::PopStyleColor();
  }
}

void showTime(State* state) {
  double hours = timeOfDay(state->scene), tilt = declination(state->scene) * kDegrees;
  constexpr double kZero = 0.0, kDay = 24.0, kSouth = -23.44, kNorth = 23.44;
  const bool turned =
      ImGui::SliderScalar("time of day", ImGuiDataType_Double, &hours, &kZero, &kDay, "%.2f h");
  const bool tilted = ImGui::SliderScalar("sun's declination", ImGuiDataType_Double, &tilt, &kSouth,
                                          &kNorth, "%.1f deg");
  hint("Of the season: +23.44 on June 21, 0 at the equinoxes.");
  if (turned || tilted) setTimeOfDay(&state->scene, hours, tilt / kDegrees);
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
  combo(state, "solver", "solver");
  combo(state, "quality", "quality");
  combo(state, "orders", "orders");
  combo(state, "shafts", "light shafts");
  if (facts.air == nullptr) return;
  const Plan& plan = facts.air->plan;
  const char* limit = modelLimit(plan.tableDesc.solver);
  if (limit[0] != '\0') ImGui::TextWrapped("%s", limit);
  if (plan.expectedError > 0.0) {
    ImGui::Text("error expected: %.2f %%", 100.0 * plan.expectedError);
    hint(
        "95th percentile of the relative error of radiance, of the worst band of the sun: measured "
        "against path-traced truth, docs/accuracy.md.");
  }
  ImGui::Text("tables: %.2f MB, while baking %.1f MB more", 1e-6 * double(plan.cost.bytes),
              1e-6 * double(plan.cost.bakeBytes));
  for (uint32_t i = 0; i < plan.choiceCount; ++i) {
    ImGui::BulletText("%s: %s", plan.choices[i].name, plan.choices[i].value);
    hint(plan.choices[i].reason);
  }
}

void showEffects(State* state, const PanelFacts& facts) {
  if (facts.air == nullptr) return;
  const Plan& plan = facts.air->plan;
  for (uint32_t i = 0; i < kEffectCount; ++i) {
    const std::string name = effectName(static_cast<Effect>(i));
    const EffectChoice& choice = plan.effects[i];
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
    char text[64];
    std::snprintf(text, sizeof text, "%.2f ms", double{history.last});
    ImGui::PlotHistogram(name.c_str(), all.data(), static_cast<int>(all.size()), 0, text, 0.0f,
                         most, {0.0f, 2.2f * ImGui::GetTextLineHeight()});
  }
  const ResourceReport& r = facts.resources;
  ImGui::Text("device memory %.2f MB (most: %.2f MB)", 1e-6 * double(r.bytes),
              1e-6 * double(r.peakBytes));
  ImGui::Text("%llu images, %llu buffers, %llu pipelines",
              static_cast<unsigned long long>(r.images), static_cast<unsigned long long>(r.buffers),
              static_cast<unsigned long long>(r.pipelines));
  if (facts.air != nullptr) {
    const Plan& plan = facts.air->plan;
    for (uint32_t i = 0; i < plan.tableCount; ++i) {
      const PlanTable& table = plan.tables[i];
      ImGui::BulletText("%s, %u x %u x %u: %.2f MB", table.name, table.width, table.height,
                        table.depth, 1e-6 * double(table.bytes));
    }
  }
  ImGui::TextDisabled("Where nothing moves nothing is drawn, and a pass shows its last time.");
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

Panel::Panel(const samples::Gpu* gpu, Context* context, VkRenderPass renderPass)
    : tables_(std::make_unique<TablePictures>(gpu, context, renderPass)) {}
Panel::~Panel() = default;

void Panel::make(State* state, const PanelFacts& facts) {
  if (!facts.caption.empty()) showCaption(facts.caption);
  if (state->help) showHelp(facts);
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
  showState(*state, facts);
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
  if (section("Air", false)) {
    combo(state, "preset", "preset");
    double haze = turbidity(state->scene.atmosphere);
    constexpr double kClear = 1.0, kHazy = 20.0;
    if (ImGui::SliderScalar("turbidity", ImGuiDataType_Double, &haze, &kClear, &kHazy, "%.2f")) {
      setTurbidity(&state->scene.atmosphere, haze);
    }
    sliders(state, true);
  }
  if (section("Method", false)) showMethod(state, facts);
  if (section("Effects", false)) showEffects(state, facts);
  if (section("Tables", false) && facts.air != nullptr) {
    tables_->make(facts.air->tables.get(), facts.air->desc);
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
