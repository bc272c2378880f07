// The program: a window, a device, a context, and the loop around them.
#pragma once

#include <alpenglow/io/flythrough_file.h>

#include <chrono>
#include <memory>
#include <optional>

#include "baker.h"
#include "common/compare.h"
#include "config.h"
#include "interface.h"
#include "panel.h"
#include "script.h"
#include "shader_folder.h"
#include "stage.h"

namespace alpenglow::view {

struct AppOptions {
  io::Scene scene;
  std::optional<io::Flythrough> flythrough;
  Config config;
  std::string device;   ///< As --device.
  std::string script;   ///< Empty: none.
  std::string shaders;  ///< A folder to reload shaders from; empty: none.
  bool validation = false;
};

/// Vulkan, up to the window's picture. Members are destroyed from the last to the first.
class Host {
 public:
  Host(const AppOptions& options, Window* window);
  Host(const Host&) = delete;
  Host& operator=(const Host&) = delete;
  ~Host();

  std::optional<ShaderFolder> shaders;  ///< Where --shaders was given.
  std::unique_ptr<headless::Device> device;
  std::optional<samples::Gpu> gpu;
  std::optional<Presenter> presenter;
  Context* context = nullptr;
  std::string lastError;  ///< The library's last sentence.
};

class App {
 public:
  explicit App(AppOptions options);
  App(const App&) = delete;
  App& operator=(const App&) = delete;
  ~App() { host_.device->waitIdle(); }
  /// Until the user quits. Returns how many validation messages there were.
  size_t run();

 private:
  using Clock = std::chrono::steady_clock;
  void frame();
  void followFlythrough(double seconds);
  void followScene();
  void followShaders();
  void takeBake();
  void show(const BakedAtmosphere& baked);
  void goBack(const io::Scene& before, const std::string& why);
  void prepareStage();
  VkExtent2D chooseSize(VkExtent2D full);
  void drawPicture(const Frame& frame);
  void chooseExposure(const Frame& frame, double seconds);
  void makePanel();
  void saveScreenshot();
  bool settled() const;
  void report(const std::string& path);

  AppOptions options_;
  Window window_;
  Host host_;
  Interface interface_;
  Picture picture_;
  PassTimer timer_;
  Stage stage_;
  Baker baker_;
  Panel panel_;
  std::optional<Script> script_;
  std::optional<BakedAtmosphere> baked_;  ///< What is drawn with.
  State state_;

  io::Scene planned_;     ///< The scene that the last plan was made for.
  io::Scene shownScene_;  ///< The one that the stage was prepared for.
  bool hasPlan_ = false;
  double flythroughSeconds_ = 0.0;
  std::string caption_;
  double exposure_ = 0.0, wantedExposure_ = 0.0;  ///< Shown now, and soon; 0: not known yet.

  float scale_ = 1.0f;  ///< Of a side of the picture, while it moves.
  VkExtent2D drawn_ = {};
  /// What the picture shows.
  struct Shown {
    FrameDesc draw;
    const Tables* tables = nullptr;
    double siderealHours = 0.0;  ///< -1 without stars.
    bool operator==(const Shown& other) const {
      return samples::samePicture(draw, other.draw) && tables == other.tables &&
             siderealHours == other.siderealHours;
    }
  };
  Shown shown_;
  bool stale_ = true;     ///< Pipelines have changed since.
  bool resting_ = false;  ///< The last frame drew, or kept, the picture at full resolution.
  Clock::time_point lastFrame_ = Clock::now(), lastChange_ = Clock::now();
  float lastFrame_ms_ = 0.0f;         ///< While something moved.
  std::vector<float> frameTimes_ms_;  ///< Since the last report.
};

}  // namespace alpenglow::view
