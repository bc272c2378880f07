// Flythrough files (docs/schema/walk.schema.json): a scene whose camera, sun, atmosphere, exposure
// and stars move from key to key, with captions. Programs play them or render them frame by frame.
#pragma once

#include <alpenglow/io/scene_file.h>

#include <cstdint>
#include <string>
#include <vector>

namespace alpenglow::io {

/// How a flythrough moves from the previous key to a key.
enum class FlythroughMove : uint32_t {
  Smooth,  ///< Smoothly; at rest at the first key, the last, and on both sides of a cut.
  Linear,  ///< At constant speed.
  Cut,     ///< The previous key's scene stays until this key's time.
};

struct FlythroughKey {
  double time_s = 0.0;
  std::string caption;  ///< Shown from here to the next key.
  FlythroughMove move = FlythroughMove::Smooth;
  Scene scene;
};

struct Flythrough {
  std::string title;
  double framesPerSecond = 24.0;
  /// At least one; the first is at 0, each later than the one before. Their scenes differ in
  /// atmosphere, sun, camera, exposure and stars alone.
  std::vector<FlythroughKey> keys;
};

/// Most frames of a flythrough, and keys.
inline constexpr uint32_t kMaxFlythroughFrames = 1'000'000;
inline constexpr uint32_t kMaxFlythroughKeys = 10'000;

/// Reads and checks everything; paths in the file are relative to it. A key takes what it leaves
/// out from the previous key.
Result<Flythrough> readFlythrough(const std::string& path);
/// As readFlythrough, for text; `folder` is where its paths start.
Result<Flythrough> parseFlythrough(const std::string& text, const std::string& name,
                                   const std::string& folder);

/// Frames 0 to frameCount - 1, the first at 0 seconds, the last not after the last key.
uint32_t frameCount(const Flythrough& flythrough);
double timeOfFrame(const Flythrough& flythrough, uint32_t frame);

/// The last key that is not after this time; the first for times before it.
const FlythroughKey& keyAt(const Flythrough& flythrough, double time_s);

/// The scene at a time: at a key's time that key's scene; before the first key the first, after the
/// last the last. Between two keys positions lie on the great circle, altitude h is interpolated as
/// log(1 m + h), exposure, fov and an orthographic height as their logarithms, angles the shorter
/// way round, and all other numbers, those of an atmosphere included, linearly.
Scene sceneAt(const Flythrough& flythrough, double time_s);

}  // namespace alpenglow::io
