// What the report varies: a list of settings, each measured in the same way.
#pragma once

#include <alpenglow/tables.h>

#include <string>
#include <vector>

namespace alpenglow::cost {

enum class Storage { AsDesc, SharedExponent };  ///< The latter: tables rounded to RGB9E5.

struct Configuration {
  std::string sweep, name, family, detail;
  TableDesc desc;
  bool fromLut = true;
  EffectFlags viewDisabledEffects = 0;
  Storage storage = Storage::AsDesc;
  /// Rays and views under this sun alone, at ground level: a domain that is a part of all. 0: all.
  double onlySun_deg = 0.0;
  uint32_t bands = 5;  ///< That the tables are for: the first.
};

/// The full list, or a shorter one. Names are unique in their sweep.
std::vector<Configuration> configurations(bool quick);

}  // namespace alpenglow::cost
