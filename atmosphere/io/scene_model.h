// The model of a scene file.
#pragma once

#include <alpenglow/io/scene_file.h>

#include "atmosphere/io/json.h"

namespace alpenglow::io {

/// Fields model and model_samples; `scene` has its solver, orders and quality.
void readModel(JsonErrors* errors, ObjectReader* reader, Scene* scene);

}  // namespace alpenglow::io
