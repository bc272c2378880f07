// State that controls, panel, script and flythrough change, and the frame loop reads.
#pragma once

#include <alpenglow/io/scene_file.h>

#include <optional>
#include <string>
#include <vector>

namespace alpenglow::view {

struct State {
  io::Scene scene;
  io::Scene start;                        ///< What R goes back to.
  float balance[3] = {1.0f, 1.0f, 1.0f};  ///< Of the display's colours.
  bool panel = true, help = false;
  bool quit = false;
  bool playing = true;  ///< Of a flythrough.
  /// What to save at the end of the frame; empty: nothing. ".exr" or ".png".
  std::string screenshot;
  /// Sections of the panel, by their first words, that are to be open, all others closed; empty: as
  /// they are.
  std::vector<std::string> sections;
  /// A number that is being typed into the panel, which counts when the typing ends.
  struct Typed {
    std::string id;
    double value = 0.0;
  };
  std::optional<Typed> typed;
  /// The last failure or action, as a sentence.
  std::string message;
};

/// Moves the camera `metres` along its own axes: forward, right and up. The sun stays where it is.
void moveCamera(io::Scene* scene, const double metres[3]);

/// Metres a second that suit the camera's altitude.
double cameraSpeed(const io::Scene& scene);

/// The sun's place at a time of the day, hours after midnight, where its declination is this.
void setTimeOfDay(io::Scene* scene, double hours, double declination);
/// The hours that the sun's place stands for.
double timeOfDay(const io::Scene& scene);
/// Declination of the sun's place.
double declination(const io::Scene& scene);

}  // namespace alpenglow::view
