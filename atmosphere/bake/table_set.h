// The tables of one atmosphere: their images, the state of their bake, and the recording of it.
// This is what the public handle alpenglow::Tables points to.
#pragma once

#include <alpenglow/tables.h>

#include <vector>

#include "atmosphere/bake/resources.h"
#include "atmosphere/model/physics_cpp.h"
#include "engine/barriers.h"
#include "engine/descriptors.h"
#include "engine/frames.h"
#include "engine/memory.h"

namespace alpenglow::bake {

/// Where checks of a description report, and what images there are: of a device, or of a plan,
/// which knows none and takes the largest images that any has.
class Checks {
 public:
  Checks(const engine::Device& device)  // NOLINT: a device stands for its checks.
      : most2D(device.limits().maxImageDimension2D),
        most3D(device.limits().maxImageDimension3D),
        device_(&device) {}
  explicit Checks(const DiagnosticSink& sink) : sink_(sink) {}

  const uint32_t most2D = 32768, most3D = 16384;
  /// As Device::fail.
  Status fail(Status status, VkResult result, const char* format, ...) const ALPENGLOW_PRINTF(4, 5);

 private:
  const engine::Device* device_ = nullptr;
  DiagnosticSink sink_;
};

/// Ok, or a sentence to the diagnostic that names the wrong field of the description, as the host
/// gave it.
Status checkTableDesc(const Checks& checks, const TableDesc& desc);
/// The description with its zeros replaced by defaults, for parameters as simulated; but Moments
/// keep orders == 0: all of them.
TableDesc completed(const Parameters& parameters, const TableDesc& desc);
/// The parameters less what is not simulated.
Parameters simulated(const Parameters& parameters, EffectFlags without);
/// Ok, or a sentence when a size of a completed description is out of range on this device.
Status checkSizes(const Checks& checks, const TableDesc& desc);

}  // namespace alpenglow::bake

namespace alpenglow {
inline namespace v1 {

/// Externally synchronised, as every handle of its kind.
struct Tables : public engine::FrameObject {
 public:
  /// Both arguments are checked and completed. Allocates; records nothing. Without `bakes` the
  /// tables can only be uploaded, and nothing is made that a bake alone needs. `plan` makes the
  /// solver's plan of them; the last argument is finestFormat.
  using MakePlan = bake::SolverPlan (*)(const Parameters&, const TableDesc&, TableFormat);
  static Status create(bake::Resources& resources, const Parameters& parameters,
                       const TableDesc& desc, MakePlan plan, bool bakes, Tables** out);
  static void destroy(Tables* tables, uint64_t frame);

  Status recordBake(VkCommandBuffer commands, uint64_t budget, BakeProgress* progress);
  Status info(TableId id, TableInfo* out) const;
  Status recordReadback(VkCommandBuffer commands, TableId id, VkBuffer buffer, VkDeviceSize offset);
  Status recordUpload(VkCommandBuffer commands, TableId id, VkBuffer buffer, VkDeviceSize offset);

  void frameCompleted(uint64_t completed) override;
  void frameAbandoned(uint64_t frame) override;
  void destroyNow() override { destroy(this, 0); }

  bool ready() const { return state_.ready; }
  /// Newest frame with commands that write the tables; 0: none.
  uint64_t recordedFrame() const { return recordedFrame_; }
  const Parameters& parameters() const { return parameters_; }
  const TableDesc& desc() const { return desc_; }
  VkDescriptorSet descriptorSet() const { return tableSet_; }
  bake::Resources& resources() const { return resources_; }
  uint64_t id() const { return id_; }  ///< From 1; unique in the context.
  /// InvalidArgument with a sentence when an image is not where descriptorSet() says.
  Status assertReadable() const;

 private:
  Tables(bake::Resources& resources, const Parameters& parameters, const TableDesc& desc,
         bool bakes);
  ~Tables() override = default;
  Status makeImages();
  Status makeUniforms();
  Status makeDescriptors();
  Status makePipelines();
  Status writeTableSet();
  Status writeStageSets(uint32_t stage);
  void writeSampled(engine::DescriptorWriter* writer, uint32_t binding, uint32_t image) const;
  uint32_t imageOf(TableId id) const;  ///< kNoImage when these tables have none such.
  /// The image to copy now; kNoImage when the table is not finished.
  uint32_t readableImage(TableId id) const;
  Status missing(TableId id) const;
  Status notReadable(TableId id) const;
  Status recordPass(VkCommandBuffer commands, const bake::Pass& pass, uint32_t firstRow,
                    uint32_t endRow);
  Status finish(VkCommandBuffer commands);
  Status makeReadable(VkCommandBuffer commands);
  void releaseScratch();
  /// Before anything is recorded: keeps what frameAbandoned() goes back to.
  Status noteFrame();

  bake::Resources& resources_;
  engine::Device& device_;
  uint64_t id_;
  Parameters parameters_;
  TableDesc desc_;
  bool bakes_;
  bake::SolverPlan plan_;
  uint64_t unitsTotal_ = 0;

  /// What the bake has for a stage.
  struct StageObjects {
    VkPipeline pipeline = VK_NULL_HANDLE;  ///< Owned by the resources.
    VkDescriptorSet inputs = VK_NULL_HANDLE, outputs = VK_NULL_HANDLE;
  };
  std::vector<StageObjects> stages_;   ///< Empty without `bakes_`.
  std::vector<engine::Image> images_;  ///< As in the plan; scratch is empty without `bakes_`.
  engine::Buffer uniforms_;
  engine::MemoryBlock persistentBlock_, scratchBlock_, uniformBlock_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet tableSet_ = VK_NULL_HANDLE;

  /// What has been recorded, as far as no frame was abandoned.
  struct RecordState {
    uint32_t pass = 0;
    uint32_t row = 0;
    uint64_t unitsDone = 0;
    uint32_t uploaded = 0;  ///< Bits by image.
    bool ready = false;
  };
  RecordState state_;
  uint64_t recordedFrame_ = 0;
  RecordState stateBefore_;                    ///< Before recordedFrame_ ...
  std::vector<engine::ImageTrack> imagesBefore_;  ///< ... and the images' states then.
  bool scratchReleased_ = false;
};

}  // namespace v1
}  // namespace alpenglow
