// Every parameter of a scene, by name, with its unit and range.
#pragma once

#include <alpenglow/io/scene_file.h>

#include <functional>
#include <span>
#include <string>

namespace alpenglow::view {

struct Parameter {
  const char* group;  ///< "rayleigh", as files have it.
  std::string name;   ///< "rayleigh.scattering_per_m.0": group, field, channel.
  const char* unit;
  double least, most;  ///< Of sliders: the allowed range, or the useful part of it.
  bool logarithmic;
  bool ofMedium;                            ///< A change of it needs other tables.
  std::function<double*(io::Scene&)> find;  ///< Null where the scene has no such thing.
  double factor = 1.0;                      ///< From the scene's number to the one shown.

  double get(io::Scene& scene) const { return *find(scene) * factor; }
  void set(io::Scene* scene, double value) const;
};

/// All of them, in the order of atmosphere and scene files.
std::span<const Parameter> parameters();
/// Null when there is none of this name.
const Parameter* findParameter(const std::string& name);

/// Empty where the scene can be simulated and drawn, else a sentence.
std::string whyInvalid(const io::Scene& scene);

/// Total over molecular optical depth of the atmosphere above the ground, in the middle channel
/// (Preetham et al. 1999); 1: no aerosols.
double turbidity(const Parameters& parameters);
void setTurbidity(Parameters* parameters, double turbidity);
/// Multiplies scattering and extinction of molecules or aerosols.
void scaleRayleigh(Parameters* parameters, double factor);
void scaleMie(Parameters* parameters, double factor);

}  // namespace alpenglow::view
