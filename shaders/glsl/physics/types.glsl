// The types of the physics text, which compiles as GLSL and, through GLM, as C++ in float and in
// double (atmosphere/parameters/physics_cpp.h defines the same names there). Rules of this folder: no
// swizzles, samplers, globals or array initialisers; literals are REAL(2.0); a table read is a
// function that the includer defines (see lookup.glsl). Lengths are metres, angles radians.
#ifndef __cplusplus
#define Real float
#define Real2 vec2
#define Real3 vec3
#define Real4 vec4
#define REAL(literal) literal
#define IN(type) in type
#define OUT(type) out type
#define ALPENGLOW_FN
#define ALPENGLOW_STD140(type) type
// One value for each wavelength baked together: the only place where their number stands.
#define Spectrum vec3
#define SPECTRUM(value) vec3(value)
#define ALPENGLOW_PI 3.14159265358979
#endif
