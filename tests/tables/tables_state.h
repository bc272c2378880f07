// What tests ask of tables in few words.
#pragma once

#include <alpenglow/tables.h>

namespace alpenglow::testing {

/// Empty for null.
inline TablesInfo infoOf(const Tables* tables) {
  TablesInfo info;
  if (tables != nullptr) tablesInfo(tables, &info);
  return info;
}

/// Views and probes may use them.
inline bool ready(const Tables* tables) { return infoOf(tables).state >= TablesState::Recorded; }

/// The name is null for a table that they don't have.
inline ImageInfo imageOf(const Tables* tables, TableId id) { return infoOf(tables).images[id]; }

}  // namespace alpenglow::testing
