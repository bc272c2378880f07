// The tables of one atmosphere: their images, the state of their bake, and the recording of it.
// This is what the public handle alpenglow::Tables points to.
#pragma once

#include <alpenglow/tables.h>

#include <vector>

#include "atmosphere/bake/pass.h"
#include "atmosphere/bake/resources.h"
#include "atmosphere/model/physics_cpp.h"
#include "engine/barriers.h"
#include "engine/memory.h"

namespace alpenglow::bake {

/// Twin of TableShape in shaders/glsl/physics/lookup.glsl.
struct ShapeConstants {
  float transmittanceMu, transmittanceR, irradianceMuS, irradianceR;
  float scatteringR, scatteringMu, scatteringMuS, scatteringNu;
};

/// The uniform block of set 0, binding 0 (std140).
struct AtmosphereConstants {
  physics_f32::Medium medium;
  ShapeConstants shape;
};
static_assert(sizeof(AtmosphereConstants) == 144);

/// Ok, or a sentence to the diagnostic that names the wrong field of the description.
Status checkTableDesc(const engine::Device& device, const TableDesc& desc);
/// The description with its zeros replaced by defaults.
TableDesc completed(const TableDesc& desc);

}  // namespace alpenglow::bake

namespace alpenglow {
inline namespace v1 {

/// Externally synchronised, as every handle of its kind.
struct Tables {
 public:
  /// Both arguments are checked and completed. Allocates; records nothing. Without `bakes` the
  /// tables can only be uploaded, and nothing is made that a bake alone needs.
  static Status create(bake::Resources& resources, const Parameters& parameters,
                       const TableDesc& desc, bool bakes, Tables** out);
  static void destroy(Tables* tables, const FrameInfo& frame);

  Status recordBake(VkCommandBuffer commands, const FrameInfo& frame, uint64_t budget,
                    BakeProgress* progress);
  Status info(TableId id, TableInfo* out) const;
  Status recordReadback(VkCommandBuffer commands, TableId id, VkBuffer buffer, VkDeviceSize offset);
  Status recordUpload(VkCommandBuffer commands, const FrameInfo& frame, TableId id, VkBuffer buffer,
                      VkDeviceSize offset);

  bool ready() const { return ready_; }
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
  Status makeImages();
  Status makeUniforms();
  Status makeDescriptors();
  Status makePipelines();
  Status writeTableSet();
  Status writeBakeSets();
  bool persistent(uint32_t image) const;
  uint32_t imageOf(TableId id) const;  ///< kNoImage when these tables have none such.
  bool readable(TableId id) const;
  Status recordPass(VkCommandBuffer commands, const bake::Pass& pass, uint32_t firstRow,
                    uint32_t endRow);
  Status finish(VkCommandBuffer commands, const FrameInfo& frame);
  Status makeReadable(VkCommandBuffer commands);
  void releaseScratch(const FrameInfo& frame);

  bake::Resources& resources_;
  engine::Device& device_;
  uint64_t id_;
  Parameters parameters_;
  TableDesc desc_;
  bool bakes_;
  std::vector<bake::Pass> passes_;
  std::vector<VkPipeline> pipelines_;  ///< One for each pass; owned by the resources.

  engine::Image images_[bake::kImageCount];
  engine::Buffer uniforms_;
  engine::MemoryBlock persistentBlock_, scratchBlock_, uniformBlock_;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet tableSet_ = VK_NULL_HANDLE;
  VkDescriptorSet inputSet_ = VK_NULL_HANDLE;
  VkDescriptorSet outputSets_[bake::kPassKindCount] = {};

  uint32_t currentPass_ = 0;
  uint32_t currentRow_ = 0;
  uint64_t unitsDone_ = 0, unitsTotal_ = 0;
  uint32_t uploaded_ = 0;  ///< Bits by ImageId.
  bool scratchReleased_ = false;
  bool ready_ = false;
};

}  // namespace v1
}  // namespace alpenglow
