// Which effects the code is compiled for (alpenglow/effects.h). Literals or specialization constants that the
// includer may define, common/effect_constants.glsl for our own shaders; what is false leaves nothing behind.
// Tables without a table of sources, or of moments, are fixed at compile time, since a shader needs what it
// declares: ALPENGLOW_WITHOUT_SOURCE (no aerosols), ALPENGLOW_WITHOUT_MULTIPLE.
#ifdef ALPENGLOW_WITHOUT_SOURCE
#define ALPENGLOW_MIE false
#endif
#ifndef ALPENGLOW_RAYLEIGH
#define ALPENGLOW_RAYLEIGH true
#endif
#ifndef ALPENGLOW_MIE
#define ALPENGLOW_MIE true
#endif
#ifndef ALPENGLOW_ABSORPTION
#define ALPENGLOW_ABSORPTION true
#endif
#ifndef ALPENGLOW_GROUND_REFLECTION
#define ALPENGLOW_GROUND_REFLECTION true
#endif
#ifndef ALPENGLOW_GROUND_IRRADIANCE
#define ALPENGLOW_GROUND_IRRADIANCE true
#endif
// Cameras above the top of the atmosphere.
#ifndef ALPENGLOW_SPACE_VIEWS
#define ALPENGLOW_SPACE_VIEWS true
#endif
