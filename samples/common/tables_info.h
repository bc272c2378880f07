// TablesInfo by value.
#pragma once

#include <alpenglow/tables.h>

namespace alpenglow::samples {

/// Empty for null.
inline TablesInfo infoOf(const Tables* tables) {
  TablesInfo info;
  if (tables != nullptr) tablesInfo(tables, &info);
  return info;
}

}  // namespace alpenglow::samples
