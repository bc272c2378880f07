// Orthographic cameras: alpenglowMoveObserver gives each pixel's ray an observer of its own.

layout(constant_id = 6) const bool kOrthographic = false;
