#include "app.h"

#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/io/image_file.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <thread>

#include "common/failure.h"
#include "common/scene_plan.h"
#include "parameters.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace alpenglow::view {
namespace {

using samples::Failure;
using std::chrono::duration;

constexpr double kRestSeconds = 0.25;  // Without a change, before the picture is drawn in full.
constexpr float kLeastScale = 0.25f;
constexpr const char* kPassesOfPixels[] = {"sky", "aerial perspective", "terrain", "balloons",
                                           "stars"};
constexpr CapabilityFlags kNeeded = kCapabilityBake | kCapabilitySky;

void keepError(void* user, const Diagnostic& diagnostic) {
  if (diagnostic.severity == Severity::Error) {
    *static_cast<std::string*>(user) = diagnostic.message;
  }
}

// The most pixels that a window on one of the monitors can have.
VkExtent2D mostPixels(const Window& window) {
  VkExtent2D size = window.size();
  int count = 0;
  GLFWmonitor** monitors = glfwGetMonitors(&count);
  for (int i = 0; i < count; ++i) {
    const GLFWvidmode* mode = glfwGetVideoMode(monitors[i]);
    if (mode == nullptr) continue;
    size.width = std::max(size.width, static_cast<uint32_t>(mode->width));
    size.height = std::max(size.height, static_cast<uint32_t>(mode->height));
  }
  return size;
}

}  // namespace

Host::Host(const AppOptions& options, Window* window) {
  headless::DeviceOptions wanted;
  wanted.select = options.device;
  wanted.validation = options.validation;
  wanted.onValidationMessage = [](std::string_view message) {
    std::fprintf(stderr, "%.*s\n", static_cast<int>(message.size()), message.data());
  };
  wanted.instanceExtensions = Window::instanceExtensions();
  wanted.deviceExtensions = {VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  wanted.queueFamily = [](VkInstance instance, VkPhysicalDevice physical, uint32_t family) {
    return glfwGetPhysicalDevicePresentationSupport(instance, physical, family) == GLFW_TRUE;
  };
  CapabilityFlags capabilities = kNeeded;
  wanted.requirements = [&](PFN_vkGetInstanceProcAddr get, VkInstance instance,
                            VkPhysicalDevice physical, Requirements* out, std::string* missing) {
    // As much as the device has.
    for (const CapabilityFlags wish :
         {kCapabilityAerialPerspective | kCapabilityLightShafts | kCapabilityShadowVolumes,
          kCapabilityAerialPerspective | kCapabilityLightShafts,
          CapabilityFlags{kCapabilityAerialPerspective}, CapabilityFlags{0}}) {
      capabilities = kNeeded | wish;
      ContextDesc desc;
      desc.instance = instance;
      desc.physicalDevice = physical;
      desc.getInstanceProcAddr = get;
      desc.capabilities = capabilities;
      desc.diagnostics = {keepError, missing};
      if (queryRequirements(desc, out) == Status::Ok) return Status::Ok;
    }
    return Status::Unsupported;
  };
  std::string error;
  device = headless::Device::create(wanted, &error);
  if (!device) throw Failure(error);
  gpu.emplace(
      device.get(),
      [this](const char*, const std::function<void(VkCommandBuffer)>& record) {
        std::string sentence;
        const bool good = device->run(
            [&](VkCommandBuffer commands) {
              record(commands);
              return true;
            },
            &sentence);
        if (!good) throw Failure(sentence);
      },
      [this](Status status) {
        if (status != Status::Ok) throw Failure(lastError);
      });
  presenter.emplace(&*gpu, window, options.config.vsync);
  ContextDesc desc = device->contextDesc();
  desc.capabilities = capabilities;
  desc.diagnostics = {keepError, &lastError};
  if (!options.shaders.empty()) {
    shaders.emplace(options.shaders);
    desc.shaders = shaders->hook();
  }
  gpu->check(createContext(desc, &context));
}

Host::~Host() {
  if (device) device->waitIdle();
  if (context != nullptr) destroyContext(context);
}

App::App(AppOptions options)
    : options_(std::move(options)),
      window_(options_.config.width, options_.config.height, "Alpenglow"),
      host_(options_, &window_),
      interface_(&*host_.gpu, &window_, &*host_.presenter, options_.config.interfaceScale),
      picture_(&*host_.gpu, &*host_.presenter, mostPixels(window_)),
      timer_(&*host_.gpu),
      stage_(&*host_.gpu, host_.context, picture_.target().extent()),
      baker_(&*host_.gpu, host_.context),
      panel_(&*host_.gpu, host_.presenter->renderPass()) {
  if (!options_.script.empty()) script_.emplace(options_.script, options_.config.bindings);
  state_.scene = state_.start = options_.scene;
  state_.panel = options_.config.panel;
  stage_.load(state_.scene);
}

size_t App::run() {
  const auto quits = [this] {
    // A picture that was asked for is saved first.
    const bool saves = !state_.screenshot.empty() && window_.size().width > 0;
    return !saves && (state_.quit || glfwWindowShouldClose(window_.handle()) == GLFW_TRUE);
  };
  while (!quits()) {
    // Nothing moves: leave the processor idle.
    const bool idle = settled() && !script_ && !(options_.flythrough && state_.playing);
    window_.poll(idle ? 0.1 : 0.0);
    if (script_) {
      script_->step(&state_, {[this] { return settled(); },
                              [this](uint32_t width, uint32_t height) {
                                glfwSetWindowSize(window_.handle(), static_cast<int>(width),
                                                  static_cast<int>(height));
                              },
                              [this](double seconds) {
                                flythroughSeconds_ = seconds;
                                state_.playing = false;
                                return options_.flythrough.has_value();
                              },
                              [this](const std::string& path) { report(path); }});
      if (script_->finished()) script_.reset();
    }
    frame();
  }
  host_.device->waitIdle();
  return host_.device->validationMessages().size();
}

void App::frame() {
  const Clock::time_point now = Clock::now();
  const double seconds = duration<double>(now - lastFrame_).count();
  lastFrame_ = now;
  control(&state_, &window_, options_.config.bindings, seconds, !Interface::wantsKeyboard(),
          !Interface::wantsMouse());
  followFlythrough(seconds);
  Frame frame;
  if (!host_.presenter->begin(&frame)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return;
  }
  frameTimes_ms_.push_back(static_cast<float>(1e3 * seconds));
  const FrameNumbers numbers = host_.presenter->numbers();
  host_.gpu->check(advanceFrame(host_.context, numbers.submitting, numbers.completed));
  timer_.begin(frame);
  state_.scene.width = frame.size.width;
  state_.scene.height = frame.size.height;
  chooseExposure(frame, seconds);
  followScene();
  followShaders();
  // More while there is nothing else to do.
  baker_.record(frame, &timer_,
                options_.config.bakeSeconds * (!baked_    ? 6.0
                                               : resting_ ? 2.0
                                                          : 1.0));
  takeBake();
  drawPicture(frame);
  interface_.begin();
  makePanel();
  Interface::end();
  const Tone tone = {state_.scene.exposure.value_or(exposure_),
                     state_.scene.toneMap,
                     {state_.balance[0], state_.balance[1], state_.balance[2]}};
  host_.presenter->end(frame, [&] {
    timer_.time(frame, "tone map", [&] { picture_.show(frame, drawn_, tone); });
    timer_.time(frame, "interface", [&] { Interface::record(frame.commands); });
  });
  if (!state_.screenshot.empty() && resting_) saveScreenshot();
}

void App::followFlythrough(double seconds) {
  if (!options_.flythrough) return;
  const io::Flythrough& flythrough = *options_.flythrough;
  if (state_.playing) flythroughSeconds_ += seconds;
  const double end = flythrough.keys.back().time_s;
  if (flythroughSeconds_ > end) {
    flythroughSeconds_ = end;
    state_.playing = false;
  }
  caption_ = io::keyAt(flythrough, flythroughSeconds_).caption;
  const io::Scene there = io::sceneAt(flythrough, flythroughSeconds_);
  state_.scene.atmosphere = there.atmosphere;
  state_.scene.camera = there.camera;
  state_.scene.sun = there.sun;
  state_.scene.exposure = there.exposure;
  state_.scene.stars = there.stars;
}

// Plans and rebakes where the scene asks for other tables. Camera and sun may go anywhere, so
// they don't count.
void App::followScene() {
  const io::Scene& scene = state_.scene;
  const bool same = hasPlan_ && scene.model == planned_.model && scene.solver == planned_.solver &&
                    scene.quality == planned_.quality && scene.orders == planned_.orders &&
                    scene.shafts == planned_.shafts &&
                    std::equal(scene.effects, scene.effects + kEffectCount, planned_.effects) &&
                    io::firstDifference(scene.atmosphere, planned_.atmosphere).empty();
  if (same) return;
  const bool first = !hasPlan_;
  const io::Scene before = planned_;
  planned_ = scene;
  hasPlan_ = true;
  try {
    PlanRequest request = samples::requestOfFlight(scene);
    request.tables = samples::tablesOf(scene);
    const Plan plan = samples::planRequest(scene, request);
    const bool all = baker_.want(scene.atmosphere, plan);
    state_.message.clear();
    if (all && baked_) {  // Other pipelines may be called for.
      BakedAtmosphere baked = *baked_;
      baked.plan = plan;
      show(baked);
    }
  } catch (const std::exception& reason) {
    if (first) throw;
    goBack(before, reason.what());
  }
}

// The scene's atmosphere and method are what they were before; the user reads why.
void App::goBack(const io::Scene& before, const std::string& why) {
  state_.message = why;
  io::Scene& now = state_.scene;
  now.atmosphere = before.atmosphere;
  now.model = before.model;
  now.solver = before.solver;
  now.quality = before.quality;
  now.orders = before.orders;
  now.shafts = before.shafts;
  std::copy_n(before.effects, kEffectCount, now.effects);
  planned_ = before;
}

// Rebuilds pipelines of edited shaders. Code that the library refuses is dropped; the old code
// stays.
void App::followShaders() {
  if (!host_.shaders || !hasPlan_ || !host_.shaders->poll()) return;
  const auto makeAll = [this] {
    stage_.forget();
    if (baked_) prepareStage();
    baker_.again();
  };
  try {
    makeAll();
    state_.message = "The shaders were loaded again.";
  } catch (const std::exception& reason) {
    const std::string why = reason.what();
    host_.shaders->undo();
    makeAll();
    state_.message = why;
  }
}

void App::takeBake() {
  const std::optional<BakedAtmosphere> made = baker_.take();
  if (made) show(*made);
  if (const std::string why = baker_.takeRefusal(); !why.empty()) state_.message = why;
}

// Draws with it from now on; on failure nothing changes.
void App::show(const BakedAtmosphere& baked) {
  const std::optional<BakedAtmosphere> before = baked_;
  const io::Scene sceneBefore = shownScene_;
  baked_ = baked;
  try {
    prepareStage();
  } catch (const std::exception& reason) {
    if (!before) throw;
    baked_ = before;
    goBack(sceneBefore, reason.what());
    baker_.keep(*before);
    prepareStage();
  }
}

void App::prepareStage() {
  stage_.prepare(planned_, *baked_);
  shownScene_ = planned_;
  stale_ = true;
}

// While the scene changes, as few pixels as keep the frame rate; all of them once it rests.
VkExtent2D App::chooseSize(VkExtent2D full) {
  const bool moving = duration<double>(Clock::now() - lastChange_).count() < kRestSeconds;
  if (!moving || !state_.screenshot.empty()) return full;
  double seconds = 0.0;
  for (const char* pass : kPassesOfPixels) seconds += timer_.seconds(pass);
  // Fewer pixels don't shorten the other passes: pixels get the remaining time of a frame, but at
  // least a third of the time of the other passes.
  const double others = timer_.seconds() - timer_.seconds("bake") - seconds;
  const double wanted = std::max(1.0 / options_.config.framesPerSecond - others, others / 3.0);
  const bool slow = seconds > wanted, fast = seconds < 0.6 * wanted && seconds > 0.0;
  if (slow || fast) {
    const double factor = std::clamp(std::sqrt(0.8 * wanted / seconds), 0.7, 1.1);
    scale_ = std::clamp(scale_ * static_cast<float>(factor), kLeastScale, 1.0f);
  }
  const auto scaled = [&](uint32_t side) {
    return std::max(1u, static_cast<uint32_t>(std::lround(static_cast<float>(side) * scale_)));
  };
  return {scaled(full.width), scaled(full.height)};
}

void App::drawPicture(const Frame& frame) {
  const io::Scene& scene = state_.scene;
  Shown now;
  now.draw = samples::describeDraw(scene);
  now.draw.cameras[0].viewport = {};
  if (baked_ && !baked_->plan.choices[static_cast<uint32_t>(Effect::SunDisc)].on) {
    now.draw.lights[0].discRadius = 0.0;
  }
  now.tables = baked_ ? baked_->tables.get() : nullptr;
  now.siderealHours = scene.stars ? scene.stars->siderealHours : -1.0;
  const bool changed = stale_ || now != shown_;
  if (changed) lastChange_ = Clock::now();
  shown_ = now;
  stale_ = false;
  const VkExtent2D most = picture_.target().extent();
  const VkExtent2D full = {std::min(frame.size.width, most.width),
                           std::min(frame.size.height, most.height)};
  const VkExtent2D size = chooseSize(full);
  const bool sameSize = size.width == drawn_.width && size.height == drawn_.height;
  resting_ = size.width == full.width && size.height == full.height && now.tables;
  if (!changed && sameSize) return;
  drawn_ = size;
  now.draw.cameras[0].viewport.extent = size;
  if (now.tables != nullptr) {
    stage_.record(frame, scene, *baked_, now.draw, picture_, &timer_);
    return picture_.measure(frame, size);
  }
  picture_.beginDrawing(frame.commands);
  host_.gpu->render(frame.commands, picture_.target(), now.draw.cameras[0].viewport,
                    VK_ATTACHMENT_LOAD_OP_CLEAR, nullptr, [] {});
  picture_.endDrawing(frame.commands);
}

// Exposure adapts gradually, like eyes.
void App::chooseExposure(const Frame& frame, double seconds) {
  if (const std::optional<double> measured = picture_.measured(frame)) wantedExposure_ = *measured;
  if (wantedExposure_ == 0.0) return;
  if (exposure_ == 0.0) exposure_ = wantedExposure_;
  exposure_ *= std::pow(wantedExposure_ / exposure_, 1.0 - std::exp(-seconds / 0.1));
}

bool App::settled() const {
  const bool exposed = state_.scene.exposure.has_value() ||
                       std::abs(exposure_ - wantedExposure_) <= 1e-3 * wantedExposure_;
  const bool compiling = host_.shaders && host_.shaders->compiling();
  return resting_ && exposed && baker_.idle() && hasPlan_ && !stale_ && !compiling;
}

void App::makePanel() {
  PanelFacts facts;
  facts.baked = baked_ ? &*baked_ : nullptr;
  facts.baker = &baker_;
  facts.timer = &timer_;
  facts.bindings = &options_.config.bindings;
  resourceReport(host_.context, &facts.resources);
  facts.device = host_.device->name();
  facts.exposure = state_.scene.exposure.value_or(exposure_);
  facts.resting = settled();
  if (!facts.resting) lastFrame_ms_ = frameTimes_ms_.back();
  facts.frame_ms = lastFrame_ms_;
  facts.scale = scale_;
  facts.drawn = drawn_;
  facts.caption = caption_;
  facts.trouble = stage_.refusal();
  if (host_.shaders && !host_.shaders->error().empty()) facts.trouble = host_.shaders->error();
  panel_.make(&state_, facts);
}

void App::saveScreenshot() {
  const std::string path = std::exchange(state_.screenshot, "");
  io::LinearImage image = picture_.read(drawn_);
  io::Done done;
  if (path.ends_with(".exr")) {
    done = io::writeExr(path, image);
  } else {
    const double exposure = state_.scene.exposure.value_or(io::automaticExposure(image));
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] *= state_.balance[i % 3];
    done = io::writePng(path, io::toneMapped(image, exposure, state_.scene.toneMap));
  }
  state_.message =
      done ? "Saved '" + std::filesystem::absolute(path).lexically_normal().string() + "'."
           : done.error;
  if (!done && !options_.script.empty()) throw Failure(done.error);
}

}  // namespace alpenglow::view
