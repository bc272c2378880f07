// Flythrough files (docs/schema/walk.schema.json): a scene whose camera, sun, atmosphere, exposure
// and stars move from key to key, with captions. Programs play them or render them frame by frame.
#pragma once

#include <alpenglow/io/scene_file.h>

#include <cstdint>
#include <string>
#include <vector>

namespace alpenglow::io {

/// How a flythrough comes to a key from the one before.
enum class FlythroughMove : uint32_t {
  Smooth,  ///< Without jerks; at rest at the first key, the last, and on both sides of a cut.
  Linear,  ///< At one speed.
  Cut,     ///< Not at all: the one before stays until this one's time.
};

struct FlythroughKey {
  double time_s = 0.0;
  std::string caption;  ///< Of the time from here to the next key.
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

/// Reads and checks everything; paths in the file are relative to it. A key has all that it doesn't
/// give from the one before.
Result<Flythrough> readFlythrough(const std::string& path);
/// As readFlythrough, for text; `folder` is where its paths start.
Result<Flythrough> parseFlythrough(const std::string& text, const std::string& name,
                                   const std::string& folder);

/// Frames 0 to frameCount - 1, the first at 0 seconds, the last not after the last key.
uint32_t frameCount(const Flythrough& flythrough);
double timeOfFrame(const Flythrough& flythrough, uint32_t frame);

/// The last key that is not after this time; the first for times before it.
const FlythroughKey& keyAt(const Flythrough& flythrough, double time_s);

/// The scene at a time: at a key's time the key's own, before the first and after the last theirs.
/// Between two keys places lie on the great circle between theirs, altitude h runs in
/// log(1 m + h), exposure, fov and an orthographic height in their logarithms, angles the shorter
/// way round, and everything else, the numbers of an atmosphere too, as it is.
Scene sceneAt(const Flythrough& flythrough, double time_s);

}  // namespace alpenglow::io
