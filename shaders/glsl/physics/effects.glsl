// Which effects the code is compiled for (alpenglow/effects.h). The includer may define them as literals or as
// specialization constants (common/effect_constants.glsl in our own shaders); the compiler removes what is false.
// Missing tables of sources or of moments are declared at compile time, since a shader needs every binding that it
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
