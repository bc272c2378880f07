// Calls into each library of the package; exit status 0 when the answers make sense.
#include <alpenglow/alpenglow.h>
#include <alpenglow/headless.h>
#include <alpenglow/io/atmosphere_file.h>
#include <alpenglow/reference/reference.h>

#include <cstdio>
#include <string>

int main() {
  const auto earth = alpenglow::io::findAtmosphere("earth");
  if (!earth) {
    std::fprintf(stderr, "%s\n", earth.error.c_str());
    return 1;
  }
  alpenglow::ProbeQuery zenith;
  zenith.sunZenith = 1.0;
  alpenglow::ReferenceAnswer answer;
  if (alpenglow::referenceSingleScattering(*earth, zenith, &answer, {}) != alpenglow::Status::Ok) {
    return 2;
  }
  if (answer.value.skyRadiance[2] <= answer.value.skyRadiance[0]) return 3;  // The sky is blue.
  std::string error;
  const auto device = alpenglow::headless::Device::create({}, &error);
  if (!device) {
    std::fprintf(stderr, "%s\n", error.c_str());
    return 4;
  }
  alpenglow::Context* context = nullptr;
  if (alpenglow::createContext(device->contextDesc(), &context) != alpenglow::Status::Ok) return 5;
  alpenglow::destroyContext(context);
  std::printf("%s on %s\n", ALPENGLOW_VERSION_STRING, device->name().c_str());
}
