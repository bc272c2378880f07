#include "tests/passes/light_shafts/light_shaft_rig.h"

#include <alpenglow/shaders/test_host_depth.h>

#include <cstring>

#include "atmosphere/api/context_impl.h"
#include "engine/barriers.h"
#include "engine/structure.h"

namespace alpenglow::testing {

using namespace engine;

LightShaftRig::LightShaftRig(Context* context, headless::Device& host, const LightShaftSetup& s,
                             VkExtent2D size, const Tables* tables)
    : device(*context->device), setup(s) {
  scene.layout = VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL;
  scene.extent = size;
  makeHost(host);
  makeView(context, tables);
}

LightShaftRig::~LightShaftRig() {
  destroyView(view);
  device.vk().DestroyImageView(device.handle(), scene.view, nullptr);
  device.destroyObject(VK_OBJECT_TYPE_PIPELINE, pipeline);
  device.destroyObject(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout);
  destroyImage(device, &color);
  destroyImage(device, &depth);
  freeBlock(device, &block);
}

bool LightShaftRig::isValidFor(const LightShaftSetup& s, VkExtent2D size) const {
  const bool samePicture = size.width == scene.extent.width && size.height == scene.extent.height &&
                           s.depth == setup.depth && s.projection == setup.projection &&
                           s.fromLut == setup.fromLut && s.depthFormat == setup.depthFormat &&
                           s.shafts == setup.shafts && s.disabledEffects == setup.disabledEffects;
  return samePicture &&
         (!s.shafts || (s.method == setup.method && s.shadowMapSize == setup.shadowMapSize &&
                        s.meshSize == setup.meshSize && s.stepCount == setup.stepCount &&
                        s.multipleLoss == setup.multipleLoss && s.closed == setup.closed));
}

void LightShaftRig::makeHost(headless::Device& host) {
  ImageDesc desc;
  desc.extent = {scene.extent.width, scene.extent.height, 1};
  desc.format = kLightShaftColor;
  desc.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  desc.name = "light";
  EXPECT_EQ(createImage(device, desc, &color), Status::Ok);
  desc.format = setup.depthFormat;
  desc.usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT |
               VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  desc.linearFilter = false;
  desc.name = "depth";
  EXPECT_EQ(createImage(device, desc, &depth), Status::Ok);
  Image* images[] = {&color, &depth};
  EXPECT_EQ(allocateAndBind(device, "host", VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, images, 2, nullptr,
                            0, &block),
            Status::Ok);
  const VkPushConstantRange range = {VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(HostConstants)};
  EXPECT_EQ(createPipelineLayout(device, nullptr, 0, &range, 1, "host", &layout), Status::Ok);
  GraphicsPipelineDesc draw;
  draw.vertex = {shaders::kTestHostDepth, sizeof shaders::kTestHostDepth, "host_depth"};
  draw.layout = layout;
  draw.vertices = {12, 0};
  draw.topology = Topology::TrianglesWithAdjacency;
  draw.depthFormat = setup.depthFormat;
  draw.depthTest = draw.depthWrite = true;
  draw.depthCompare =
      setup.depth == DepthConvention::Reversed ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS;
  EXPECT_EQ(createGraphicsPipeline(device, draw, &pipeline), Status::Ok);
  std::string error;
  readback = host.createHostBuffer(VkDeviceSize{64} * scene.extent.width * scene.extent.height,
                                   VK_BUFFER_USAGE_TRANSFER_DST_BIT, &error);
  EXPECT_TRUE(error.empty()) << error;
  // A view of the depth alone, as a host has one beside that of its attachment.
  auto info = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  info.image = depth.handle;
  info.viewType = VK_IMAGE_VIEW_TYPE_2D;
  info.format = setup.depthFormat;
  info.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};
  EXPECT_EQ(device.vk().CreateImageView(device.handle(), &info, nullptr, &scene.view), VK_SUCCESS);
}

ViewDesc viewDescOf(const LightShaftSetup& setup) {
  ViewDesc desc;
  desc.colorFormat = kLightShaftColor;
  desc.depthFormat = setup.depthFormat;
  desc.depth = setup.depth;
  desc.projection = setup.projection;
  desc.disabledEffects = setup.disabledEffects;
  desc.sky = setup.fromLut ? SkyMethod::Lut : SkyMethod::Integrate;
  desc.aerialPerspective = setup.fromLut ? AerialPerspective::On : AerialPerspective::Integrate;
  if (!setup.shafts) return desc;
  LightShaftDesc& shafts = desc.lightShafts;
  shafts.method = setup.method;
  shafts.shadowMapSize = setup.shadowMapSize;
  shafts.meshSize = setup.meshSize;
  shafts.stepCount = setup.stepCount;
  shafts.multipleLoss = setup.multipleLoss;
  shafts.closed = setup.closed;
  shafts.adjacency = true;
  return desc;
}

void LightShaftRig::makeView(Context* context, const Tables* tables) {
  EXPECT_EQ(createView(context, tables, viewDescOf(setup), &view), Status::Ok);
}

VkDeviceSize LightShaftRig::copyBack(VkCommandBuffer commands, Image& image,
                                     VkImageAspectFlags aspect, uint32_t texelBytes) {
  Barriers barriers;
  barriers.image(image, kTransferSource);
  EXPECT_EQ(barriers.record(device, commands), Status::Ok);
  VkBufferImageCopy copy = {};
  copy.bufferOffset = used;
  copy.imageSubresource = {aspect, 0, 0, 1};
  copy.imageExtent = image.desc.extent;
  device.vk().CmdCopyImageToBuffer(commands, image.handle, kTransferSource.layout,
                                   readback.buffer(), 1, &copy);
  used += VkDeviceSize{texelBytes} * copy.imageExtent.width * copy.imageExtent.height;
  return copy.bufferOffset;
}

std::vector<float> LightShaftRig::floats(VkDeviceSize offset, size_t count) const {
  std::vector<float> values(count);
  std::memcpy(values.data(), static_cast<const char*>(readback.data()) + offset, count * 4);
  return values;
}

}  // namespace alpenglow::testing
