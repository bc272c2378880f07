// The tables of one atmosphere: their images, the state of their bake, and the recording of it.
// This is what the public handle alpenglow::Tables points to.
#pragma once

#include <alpenglow/tables.h>

#include <vector>

#include "atmosphere/parameters/physics_cpp.h"
#include "atmosphere/tables/resources.h"
#include "engine/barriers.h"
#include "engine/descriptors.h"
#include "engine/frames.h"
#include "engine/memory.h"

namespace alpenglow::tables {

/// The description with its zeros replaced by defaults, for simulated parameters: the second part
/// of resolveTableDesc.
TableDesc completed(const Parameters& parameters, const TableDesc& desc);
/// The parameters without disabled effects.
Parameters simulated(const Parameters& parameters, EffectFlags disabled);
/// Ok, or a sentence when a size of a completed description is out of range on this device.
Status checkDeviceLimits(const engine::Device& device, const TableDesc& desc);

}  // namespace alpenglow::tables

namespace alpenglow {
inline namespace v1_0 {

/// Externally synchronised, as every handle of its kind.
struct Tables : public engine::FrameObject {
 public:
  /// Both arguments are checked and completed. Allocates; records nothing. Without `bakes` the
  /// tables can only be uploaded, and nothing is made that a bake alone needs. `plan` makes the
  /// solver's graph of them; the last argument is finestFormat.
  using MakeGraph = tables::BakeGraph (*)(const Parameters&, const TableDesc&, TableFormat);
  static Status create(tables::Resources& resources, const Parameters& parameters,
                       const TableDesc& desc, MakeGraph graph, bool bakes, Tables** out);
  static void destroy(Tables* tables, uint64_t frame);

  Status recordBake(VkCommandBuffer commands, uint64_t budget, BakeProgress* progress);
  void info(TablesInfo* out) const;
  Status recordReadback(VkCommandBuffer commands, TableId id, VkBuffer buffer, VkDeviceSize offset);
  Status recordUpload(VkCommandBuffer commands, TableId id, VkBuffer buffer, VkDeviceSize offset);

  void frameCompleted(uint64_t completed) override;
  void frameAbandoned(uint64_t frame) override;
  void destroyNow() override { destroy(this, 0); }

  /// Baked or uploaded, by commands that are recorded.
  bool ready() const { return state_.ready; }
  TablesState state() const;
  /// Newest frame with commands that write the tables; 0: none.
  uint64_t recordedFrame() const { return recordedFrame_; }
  const Parameters& parameters() const { return parameters_; }
  const TableDesc& desc() const { return desc_; }
  /// Irradiance of light 0 at the top of the atmosphere, for views.
  const Spectrum& irradiance() const { return desc_.lights[0].irradiance; }
  VkDescriptorSet descriptorSet() const { return tableSet_; }
  tables::Resources& resources() const { return resources_; }
  uint64_t id() const { return id_; }  ///< From 1; unique in the context.
  /// A table's host copy and shape; null data when cpuQueries doesn't ask for it. It has arrived
  /// once the state is Complete.
  struct HostCopy {
    const void* data = nullptr;
    VkExtent3D extent = {};
    VkFormat format = VK_FORMAT_UNDEFINED;
  };
  HostCopy hostCopy(TableId id) const;
  /// NotReady, without a sentence, until ready(). InvalidArgument with a sentence when an image is
  /// not where descriptorSet() says.
  Status assertReadable() const;

 private:
  Tables(tables::Resources& resources, const Parameters& parameters, const TableDesc& desc,
         bool bakes);
  ~Tables() override = default;
  Status makeImages();
  Status makeUniforms();
  Status makeHostCopies();
  Status makeDescriptors();
  Status makePipelines();
  Status writeTableSet();
  Status writeStageSets(uint32_t stage);
  void writeSampled(engine::DescriptorWriter* writer, uint32_t binding, uint32_t image) const;
  uint32_t imageOf(TableId id) const;  ///< kNoImage when these tables have none such.
  /// The image to copy now; kNoImage when the table is not finished.
  uint32_t readableImage(TableId id) const;
  Status missing(TableId id) const;
  engine::ImageState readable() const;  ///< Where readers sample the finished tables.
  ImageInfo imageInfo(TableId id) const;
  void copyToBuffer(VkCommandBuffer commands, engine::Image& image, VkBuffer buffer,
                    VkDeviceSize offset);
  Status recordPass(VkCommandBuffer commands, const tables::Pass& pass, uint32_t firstRow,
                    uint32_t endRow);
  Status finish(VkCommandBuffer commands);
  Status recordHostCopies(VkCommandBuffer commands);
  void releaseScratch();
  /// Before anything is recorded: saves the state that frameAbandoned() restores.
  Status noteFrame();

  tables::Resources& resources_;
  engine::Device& device_;
  uint64_t id_;
  Parameters parameters_;
  TableDesc desc_;
  bool bakes_;
  tables::BakeGraph graph_;
  uint64_t unitsTotal_ = 0;

  /// Objects of the bake for a stage.
  struct StageObjects {
    VkPipeline pipeline = VK_NULL_HANDLE;  ///< Owned by the resources.
    VkDescriptorSet inputs = VK_NULL_HANDLE, outputs = VK_NULL_HANDLE;
  };
  std::vector<StageObjects> stages_;   ///< Empty without `bakes_`.
  std::vector<engine::Image> images_;  ///< As in the graph; scratch is empty without `bakes_`.
  engine::Buffer uniforms_;
  /// Those that cpuQueries asks for, by TableId; the others are empty.
  engine::Buffer hostCopies_[kTableSource + 1];
  engine::MemoryBlock persistentBlock_, scratchBlock_, uniformBlock_, hostBlock_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet tableSet_ = VK_NULL_HANDLE;

  /// What has been recorded in frames that were not abandoned.
  struct RecordState {
    uint32_t pass = 0;
    uint32_t row = 0;
    uint64_t unitsDone = 0;
    uint32_t uploaded = 0;  ///< Bits by image.
    bool ready = false;
    uint64_t readyFrame = 0;  ///< In which the last slice or upload was recorded.
  };
  RecordState state_;
  uint64_t recordedFrame_ = 0;   ///< The newest in which something was recorded, and not abandoned.
  uint64_t keptFrame_ = 0;       ///< The state before this frame is saved; 0: none is.
  uint64_t recordedBefore_ = 0;  ///< recordedFrame_ before keptFrame_ ...
  RecordState stateBefore_;      ///< ... the state then ...
  std::vector<engine::ImageTrack> imagesBefore_;  ///< ... and the images' states then.
  bool scratchReleased_ = false;
};

}  // namespace v1_0
}  // namespace alpenglow
