#include "widgets.h"

#include <imgui.h>

#include <algorithm>
#include <map>

#include "choices.h"
#include "parameters.h"

namespace alpenglow::view {
namespace {

bool escapePressed() { return ImGui::IsKeyPressed(ImGui::GetIO().KeyMap[ImGuiKey_Escape]); }

// How a number is shown. Coefficients are so small that ImGui would round them, radii so large that
// 4 digits don't tell them apart.
struct Display {
  double factor = 1.0;
  std::string format;
};

Display displayOf(const Parameter& parameter) {
  const std::string unit = parameter.unit;
  if (unit == "1/m") return {1e6, "%.4g /Mm"};
  const std::string digits = unit == "m" ? "%.8g" : "%.4g";
  return {1.0, digits + (unit.empty() || unit.size() > 3 ? "" : " " + unit)};
}

// The field alone, without its unit: "scattering red" of rayleigh.scattering_per_m.0.
std::string labelOf(const Parameter& parameter) {
  const size_t skip = parameter.group[0] == '\0' ? 0 : std::string(parameter.group).size() + 1;
  std::string label = parameter.name.substr(skip);
  std::string channel;
  if (const size_t dot = label.find('.'); dot != std::string::npos) {
    static const char* const kChannels[] = {" red", " green", " blue"};
    channel = kChannels[label[dot + 1] - '0'];
    label.resize(dot);
  }
  for (const char* unit : {"_per_m", "_deg", "_m"}) {
    const std::string suffix = unit;
    if (label.ends_with(suffix)) label.resize(label.size() - suffix.size());
  }
  std::replace(label.begin(), label.end(), '_', ' ');
  return label + channel;
}

const char* meaningOf(const Parameter& parameter) {
  static const std::map<std::string, const char*> kMeanings = {
      {"bottom_radius_m", "Of the ground."},
      {"top_radius_m", "Of the atmosphere's top; above is empty space."},
      {"rayleigh.scattering_per_m", "Of light by molecules, at the ground."},
      {"rayleigh.scale_height_m", "Over which the molecules' density falls to 1/e."},
      {"mie.scattering_per_m", "Of light by aerosols, at the ground."},
      {"mie.extinction_per_m", "Light that aerosols remove from a beam: scattered and absorbed."},
      {"mie.scale_height_m", "Over which the aerosols' density falls to 1/e."},
      {"mie.asymmetry", "g of their phase function: 1 forward, 0 even, -1 back."},
      {"absorption.extinction_per_m", "Of ozone, or another layer, where it is densest."},
      {"absorption.center_m", "Altitude where the layer is densest."},
      {"absorption.half_width_m", "From there to the ends of the layer, up and down."},
      {"ground_albedo", "Share of light that the ground reflects."},
      {"solar_irradiance", "Of the sun at the top of the atmosphere."},
      {"sun_angular_radius_deg", "Of the tables: it softens the edge of the planet's shadow."},
      {"sun.disc_radius_deg", "Of the disc that is drawn."},
      {"camera.fov_deg", "Of the picture's height."},
      {"stars.sidereal_hours", "Local sidereal time."}};
  std::string field = parameter.name;
  if (field.back() >= '0' && field.back() <= '2') field.resize(field.size() - 2);
  const auto found = kMeanings.find(field);
  return found == kMeanings.end() ? "" : found->second;
}

void slider(State* state, const Parameter& parameter) {
  const Display display = displayOf(parameter);
  const double now = parameter.get(state->scene);
  const double range[2] = {parameter.least * display.factor, parameter.most * display.factor};
  const std::optional<double> wanted =
      edited(state, labelOf(parameter), parameter.name, now * display.factor, range,
             display.format.c_str(), parameter.logarithmic);
  char text[320];
  std::snprintf(text, sizeof text, "%s %s\n%g, from %g to %g %s%s. Ctrl and click to type.",
                parameter.name.c_str(), meaningOf(parameter), now, parameter.least, parameter.most,
                parameter.unit, display.factor != 1.0 ? "; 1 /Mm is 1e-6 1/m" : "");
  hint(text);
  if (!wanted) return;
  const io::Scene before = state->scene;
  parameter.set(&state->scene, *wanted / display.factor);
  state->message = whyInvalid(state->scene);
  if (!state->message.empty()) state->scene = before;
}

}  // namespace

void hint(const std::string& text) {
  if (!ImGui::IsItemHovered()) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(30.0f * ImGui::GetFontSize());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

bool list(const char* label, const char* shown, size_t count, size_t now,
          const std::function<const char*(size_t)>& nameOf, size_t* chosen) {
  if (!ImGui::BeginCombo(label, shown)) return false;
  bool set = false;
  for (size_t i = 0; i < count; ++i) {
    if (!ImGui::Selectable(nameOf(i), i == now)) continue;
    *chosen = i;
    set = true;
  }
  if (escapePressed()) ImGui::CloseCurrentPopup();
  ImGui::EndCombo();
  return set;
}

void combo(State* state, const char* name, const char* label) {
  const Choice* choice = findChoice(name);
  const size_t now = choice->get(*state);
  const char* shown = now < choice->values.size() ? choice->values[now].c_str() : "(own values)";
  size_t chosen = 0;
  const auto nameOf = [choice](size_t i) { return choice->values[i].c_str(); };
  if (list(label, shown, choice->values.size(), now, nameOf, &chosen)) choice->set(state, chosen);
}

std::optional<double> edited(State* state, const std::string& label, const std::string& id,
                             double value, const double range[2], const char* format,
                             bool logarithmic) {
  double shown = value;
  const ImGuiSliderFlags flags = logarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None;
  const bool changed = ImGui::SliderScalar((label + "##" + id).c_str(), ImGuiDataType_Double,
                                           &shown, &range[0], &range[1], format, flags);
  std::optional<State::Typed>& typed = state->typed;
  if (ImGui::IsItemActive() && ImGui::GetIO().WantTextInput) {
    typed = {id, shown};
    return std::nullopt;
  }
  if (typed && typed->id == id) {
    const State::Typed last = *std::exchange(typed, std::nullopt);
    if (escapePressed()) return std::nullopt;
    if (!changed) shown = last.value;
    return shown == value ? std::nullopt : std::optional(shown);
  }
  return changed ? std::optional(shown) : std::nullopt;
}

void sliders(State* state, bool ofMedium) {
  std::string group;
  for (const Parameter& parameter : parameters()) {
    if (parameter.ofMedium != ofMedium || parameter.find(state->scene) == nullptr) continue;
    if (group != parameter.group) {
      group = parameter.group;
      if (!group.empty()) ImGui::TextDisabled("%s", group.c_str());
    }
    slider(state, parameter);
  }
}

}  // namespace alpenglow::view
