// The effects of physics/effects.glsl as specialization constants; include this before any physics. Their numbers
// are those of atmosphere/tables/effect_constants.h.
#ifndef ALPENGLOW_EFFECT_CONSTANTS
#define ALPENGLOW_EFFECT_CONSTANTS

layout(constant_id = 20) const bool kRayleigh = true;
layout(constant_id = 22) const bool kAbsorption = true;
layout(constant_id = 23) const bool kGroundReflection = true;
layout(constant_id = 24) const bool kGroundIrradiance = true;
layout(constant_id = 25) const bool kSpaceViews = true;

#define ALPENGLOW_RAYLEIGH kRayleigh
#define ALPENGLOW_ABSORPTION kAbsorption
#define ALPENGLOW_GROUND_REFLECTION kGroundReflection
#define ALPENGLOW_GROUND_IRRADIANCE kGroundIrradiance
#define ALPENGLOW_SPACE_VIEWS kSpaceViews
#ifndef ALPENGLOW_WITHOUT_SOURCE
layout(constant_id = 21) const bool kMie = true;
#define ALPENGLOW_MIE kMie
#endif

#endif
