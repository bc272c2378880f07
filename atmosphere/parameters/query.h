// Where the segment of a probe query begins and ends, decided once, in double, for the tables and
// for the reference alike. The rules are those of docs/file-formats.md, "Queries and answers".
#pragma once

#include <alpenglow/query.h>

#include "atmosphere/parameters/physics_cpp.h"

namespace alpenglow {

/// A ray query, resolved. `ray` is the part of the view ray inside the atmosphere; the query's
/// segment is its first `length` metres.
struct ResolvedQuery {
  physics_f64::Ray ray;
  double length = 0.0;        ///< 0 where there is no atmosphere along the segment.
  bool empty = true;          ///< The segment never enters the atmosphere, or its distance is 0.
  bool endsOnGround = false;  ///< Also for length 0, when the observer stands on the ground.
};

ResolvedQuery resolveQuery(const physics_f64::Medium& medium, const ProbeQuery& query);

}  // namespace alpenglow
