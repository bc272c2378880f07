#include "controls.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <map>
#include <numbers>

#include "parameters.h"

namespace alpenglow::view {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

const std::map<std::string, int>& keys() {
  static const std::map<std::string, int> kKeys = [] {
    std::map<std::string, int> all = {{"Up", GLFW_KEY_UP},
                                      {"Down", GLFW_KEY_DOWN},
                                      {"Left", GLFW_KEY_LEFT},
                                      {"Right", GLFW_KEY_RIGHT},
                                      {"Space", GLFW_KEY_SPACE},
                                      {"Escape", GLFW_KEY_ESCAPE},
                                      {"Enter", GLFW_KEY_ENTER},
                                      {"Tab", GLFW_KEY_TAB},
                                      {"Period", GLFW_KEY_PERIOD},
                                      {"Comma", GLFW_KEY_COMMA},
                                      {"Minus", GLFW_KEY_MINUS},
                                      {"Equal", GLFW_KEY_EQUAL},
                                      {"Slash", GLFW_KEY_SLASH},
                                      {"PageUp", GLFW_KEY_PAGE_UP},
                                      {"PageDown", GLFW_KEY_PAGE_DOWN},
                                      {"Home", GLFW_KEY_HOME},
                                      {"End", GLFW_KEY_END},
                                      {"Insert", GLFW_KEY_INSERT},
                                      {"Delete", GLFW_KEY_DELETE},
                                      {"Backspace", GLFW_KEY_BACKSPACE},
                                      {"LeftShift", GLFW_KEY_LEFT_SHIFT},
                                      {"RightShift", GLFW_KEY_RIGHT_SHIFT},
                                      {"LeftControl", GLFW_KEY_LEFT_CONTROL},
                                      {"RightControl", GLFW_KEY_RIGHT_CONTROL}};
    for (char c = 'A'; c <= 'Z'; ++c) all[std::string(1, c)] = GLFW_KEY_A + (c - 'A');
    for (char c = '0'; c <= '9'; ++c) all[std::string(1, c)] = GLFW_KEY_0 + (c - '0');
    for (int i = 1; i <= 12; ++i) all["F" + std::to_string(i)] = GLFW_KEY_F1 + (i - 1);
    return all;
  }();
  return kKeys;
}

std::string screenshotName(bool exr) {
  const std::time_t now = std::time(nullptr);
  std::tm local = {};
  localtime_r(&now, &local);
  char name[64];
  std::strftime(name, sizeof name, "alpenglow_%Y-%m-%d_%H-%M-%S", &local);
  return std::string(name) + (exr ? ".exr" : ".png");
}

void turnSun(io::Scene* scene, double up, double right) {
  scene->sun.elevation = std::clamp(scene->sun.elevation + up, -90 * kDegree, 90 * kDegree);
  scene->sun.azimuth = std::remainder(scene->sun.azimuth + right, 360 * kDegree);
  if (scene->sun.azimuth < 0.0) scene->sun.azimuth += 360 * kDegree;
}

// A change of the atmosphere; one that isn't valid is left out, with the reason.
template <typename Change>
void changeMedium(State* state, const Change& change) {
  const Parameters before = state->scene.atmosphere;
  change(&state->scene.atmosphere);
  const std::string why = whyInvalid(state->scene);
  if (why.empty()) return;
  state->scene.atmosphere = before;
  state->message = why;
}

}  // namespace

std::vector<Binding> defaultBindings() {
  return {{Action::Forward, "forward", "fly forward", GLFW_KEY_W},
          {Action::Back, "back", "fly back", GLFW_KEY_S},
          {Action::Left, "left", "fly to the left", GLFW_KEY_A},
          {Action::Right, "right", "fly to the right", GLFW_KEY_D},
          {Action::Up, "up", "rise", GLFW_KEY_E},
          {Action::Down, "down", "sink", GLFW_KEY_Q},
          {Action::Fast, "fast", "held: five times as fast", GLFW_KEY_LEFT_SHIFT},
          {Action::SunUp, "sun_up", "raise the sun (with shift: far)", GLFW_KEY_UP},
          {Action::SunDown, "sun_down", "lower the sun", GLFW_KEY_DOWN},
          {Action::SunLeft, "sun_left", "turn the sun to the left", GLFW_KEY_LEFT},
          {Action::SunRight, "sun_right", "turn the sun to the right", GLFW_KEY_RIGHT},
          {Action::RayleighLess, "rayleigh_less", "fewer molecules", GLFW_KEY_I},
          {Action::RayleighMore, "rayleigh_more", "more molecules", GLFW_KEY_O},
          {Action::MieLess, "mie_less", "fewer aerosols", GLFW_KEY_K},
          {Action::MieMore, "mie_more", "more aerosols", GLFW_KEY_L},
          {Action::AsymmetryLess, "asymmetry_less", "aerosols scatter less forward", GLFW_KEY_H},
          {Action::AsymmetryMore, "asymmetry_more", "aerosols scatter more forward", GLFW_KEY_J},
          {Action::TurbidityLess, "turbidity_less", "clearer air", GLFW_KEY_F},
          {Action::TurbidityMore, "turbidity_more", "hazier air", GLFW_KEY_G},
          {Action::Help, "help", "show or hide the keys", GLFW_KEY_F1},
          {Action::Panel, "panel", "show or hide the panel", GLFW_KEY_TAB},
          {Action::Screenshot, "screenshot", "save a PNG (with shift: the linear EXR)",
           GLFW_KEY_PERIOD},
          {Action::Play, "play", "play or halt a flythrough", GLFW_KEY_SPACE},
          {Action::Reset, "reset", "back to the start", GLFW_KEY_R},
          {Action::Quit, "quit", "quit", GLFW_KEY_ESCAPE}};
}

int keyNamed(const std::string& name) {
  const auto found = keys().find(name);
  return found == keys().end() ? 0 : found->second;
}

std::string keyName(int key) {
  for (const auto& [name, number] : keys()) {
    if (number == key) return name;
  }
  return "";
}

void press(State* state, Action action, bool shift) {
  io::Scene* scene = &state->scene;
  const double angle = (shift ? 5.0 : 0.5) * kDegree;
  const double more = shift ? 1.25 : 1.05;
  const double g = shift ? 0.05 : 0.01;
  const auto air = [state](const auto& change) { changeMedium(state, change); };
  switch (action) {
    case Action::SunUp:
      return turnSun(scene, angle, 0.0);
    case Action::SunDown:
      return turnSun(scene, -angle, 0.0);
    case Action::SunLeft:
      return turnSun(scene, 0.0, -angle);
    case Action::SunRight:
      return turnSun(scene, 0.0, angle);
    case Action::RayleighLess:
      return air([&](Parameters* p) { scaleRayleigh(p, 1.0 / more); });
    case Action::RayleighMore:
      return air([&](Parameters* p) { scaleRayleigh(p, more); });
    case Action::MieLess:
      return air([&](Parameters* p) { scaleMie(p, 1.0 / more); });
    case Action::MieMore:
      return air([&](Parameters* p) { scaleMie(p, more); });
    case Action::AsymmetryLess:
      return air([&](Parameters* p) { p->mie.asymmetry -= g; });
    case Action::AsymmetryMore:
      return air([&](Parameters* p) { p->mie.asymmetry += g; });
    case Action::TurbidityLess:
      return air([&](Parameters* p) { setTurbidity(p, turbidity(*p) - (shift ? 0.5 : 0.1)); });
    case Action::TurbidityMore:
      return air([&](Parameters* p) { setTurbidity(p, turbidity(*p) + (shift ? 0.5 : 0.1)); });
    case Action::Help:
      state->help = !state->help;
      return;
    case Action::Panel:
      state->panel = !state->panel;
      return;
    case Action::Screenshot:
      state->screenshot = screenshotName(shift);
      return;
    case Action::Play:
      state->playing = !state->playing;
      return;
    case Action::Reset:
      state->scene = state->start;
      std::fill_n(state->balance, 3, 1.0f);
      state->message.clear();
      return;
    case Action::Quit:
      state->quit = true;
      return;
    default:
      return;  // control() handles keys that are held.
  }
}

void fly(io::Scene* scene, const double amounts[3], bool fast, double seconds) {
  const double way = cameraSpeed(*scene) * (fast ? 5.0 : 1.0) * std::min(seconds, 0.1);
  const double metres[3] = {amounts[0] * way, amounts[1] * way, amounts[2] * way};
  moveCamera(scene, metres);
}

void turn(io::Scene* scene, const double pixels[2], double pictureHeight) {
  io::SceneCamera& camera = scene->camera;
  const double fov = camera.orthographicHeight_m ? 60 * kDegree : camera.fov;
  const double angle = fov / std::max(pictureHeight, 1.0);
  camera.heading = std::remainder(camera.heading - pixels[0] * angle, 360 * kDegree);
  if (camera.heading < 0.0) camera.heading += 360 * kDegree;
  camera.pitch = std::clamp(camera.pitch + pixels[1] * angle, -90 * kDegree, 90 * kDegree);
}

void control(State* state, Window* window, const std::vector<Binding>& bindings, double seconds,
             bool keyboardFree, bool mouseFree) {
  double moved[2];
  window->drag(mouseFree, moved);
  if (moved[0] != 0.0 || moved[1] != 0.0) turn(&state->scene, moved, window->size().height);
  if (!keyboardFree) return;
  for (const KeyEvent& key : window->keys) {
    if (key.action == GLFW_RELEASE) continue;
    for (const Binding& binding : bindings) {
      if (binding.key != key.key) continue;
      press(state, binding.action, (key.modifiers & GLFW_MOD_SHIFT) != 0);
    }
  }
  const auto held = [&](Action action) {
    return window->focused() &&
           std::any_of(bindings.begin(), bindings.end(),
                       [&](const Binding& b) { return b.action == action && window->held(b.key); });
  };
  const auto axis = [&](Action more, Action less) {
    return (held(more) ? 1.0 : 0.0) - (held(less) ? 1.0 : 0.0);
  };
  const double amounts[3] = {axis(Action::Forward, Action::Back), axis(Action::Right, Action::Left),
                             axis(Action::Up, Action::Down)};
  if (amounts[0] == 0.0 && amounts[1] == 0.0 && amounts[2] == 0.0) return;
  fly(&state->scene, amounts, held(Action::Fast), seconds);
}

}  // namespace alpenglow::view
