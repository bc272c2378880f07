// A device, a context and a small target: what the sweeps bake and draw with.
#pragma once

#include <alpenglow/alpenglow.h>
#include <alpenglow/cost.h>
#include <alpenglow/headless_target.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "atmosphere/cost/truth.h"

namespace alpenglow::cost {

/// One sentence; functions of this folder throw it, measure() catches it.
class Failure : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Freed with the frame that the device is at.
struct TablesDeleter {
  headless::Device* device = nullptr;
  void operator()(Tables* tables) const { destroyTables(tables); }
};
using TablesPointer = std::unique_ptr<Tables, TablesDeleter>;
struct ViewDeleter {
  headless::Device* device = nullptr;
  void operator()(View* view) const { destroyView(view); }
};
using ViewPointer = std::unique_ptr<View, ViewDeleter>;

/// What is drawn with: tables, and how a view reads them.
struct Drawn {
  const Tables* tables = nullptr;
  TableDesc desc;
  bool fromLut = true;
  EffectFlags viewDisabledEffects = 0;  ///< Of kViewEffects.
};

/// Not thread-safe. Functions throw a Failure.
class Bench {
 public:
  Bench(const std::string& device, VkExtent2D frame, bool validation);
  ~Bench();
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  headless::Device& device() { return *device_; }
  bool software() const { return software_; }
  const std::string& driver() const { return driver_; }
  const std::string& vulkan() const { return vulkan_; }

  /// Null, with the library's sentence in refusal(), for what this version can't bake.
  TablesPointer bake(const Parameters& parameters, const TableDesc& desc, double* seconds);
  const std::string& refusal() const { return error_; }
  /// Of the context that is in use.
  ResourceReport resources();
  /// Makes a new context, so that what follows is counted separately. No tables or views of the
  /// last one may be left.
  void renew();
  /// Throws the first message of the validation layers, if there is any.
  void checkValidation() const;

  /// A view, in a rendering scope of the target's format. Throws.
  ViewPointer view(const Drawn& drawn);
  /// Seconds of a frame: the LUT, if any, and the sky over the whole target.
  double frame(View* view, const FrameDesc& draw);
  /// What the target holds after it.
  io::LinearImage read(VkExtent2D size);
  /// Total radiance of rays that go on to the ground or to space, in a pixel each.
  std::vector<Spectrum> radiance(View* view, const Parameters& parameters,
                                 const std::vector<ProbeQuery>& rays);
  /// A copy of a table, RGBA.
  std::vector<float> readTable(Tables* tables, TableId id, ImageInfo* info);
  /// Tables of the moment solver like `from`, but for the sources.
  TablesPointer withSource(const Parameters& parameters, const TableDesc& desc, Tables* from,
                           const std::vector<float>& source);

 private:
  ImageInfo imageOf(const Tables* tables, TableId id);
  void upload(Tables* tables, TableId id, const std::vector<float>& rgba);
  void advance();  ///< All that was recorded has completed.
  double run(const std::function<Status(VkCommandBuffer)>& record);
  Status recordRays(VkCommandBuffer commands, View* view, const std::vector<FrameDesc>& draws);
  void describeDriver();

  std::unique_ptr<headless::Device> device_;
  Context* context_ = nullptr;
  std::string error_, driver_, vulkan_;
  bool software_ = false;
  std::unique_ptr<headless::Target> target_;
};

/// The draw of a ray as a probe has it: a camera that looks along it, with a narrow field of view.
FrameDesc drawOfRay(const Parameters& parameters, const ProbeQuery& ray, int32_t x);
/// A camera above latitude 0, longitude 0, with the sun `azimuth` off its heading; degrees.
FrameDesc drawOfView(const Parameters& parameters, double altitude_m, double sun, double azimuth,
                     double pitch, double fov, VkExtent2D size);

}  // namespace alpenglow::cost
