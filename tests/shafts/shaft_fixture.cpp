#include "tests/shafts/shaft_fixture.h"

#include <alpenglow/shaders/test_host_depth.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "atmosphere/api/context_impl.h"
#include "atmosphere/shafts/shaft_pass.h"
#include "engine/barriers.h"
#include "engine/structure.h"

namespace alpenglow::testing {
namespace {

using namespace engine;

constexpr VkFormat kColor = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr ImageState kColorDrawn = {
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
constexpr VkPipelineStageFlags2 kDepthStages =
    VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
constexpr ImageState kDepthDrawn = {
    VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL, kDepthStages,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
constexpr ImageState kDepthRead = {
    VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL,
    kDepthStages | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

struct HostConstants {
  float clipFromCamera[16];
  float fromCamera[4];
};

VkRenderingAttachmentInfo attachmentOf(const Image& image, VkImageLayout layout,
                                       VkAttachmentLoadOp load, VkAttachmentStoreOp store) {
  auto info = structure<VkRenderingAttachmentInfo>(VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO);
  info.imageView = image.view;
  info.imageLayout = layout;
  info.loadOp = load;
  info.storeOp = store;
  return info;
}

bool hasStencil(VkFormat format) {
  return (formatAspects(format) & VK_IMAGE_ASPECT_STENCIL_BIT) != 0;
}

}  // namespace

Vec groundOrigin(const Parameters& parameters) { return {parameters.bottomRadius_m, 0.0, 0.0}; }

void ShaftTest::SetUp() {
  SkyTest::SetUp();
  useEarth();
}

void ShaftTest::useEarth() {
  parameters = preset("earth");
  parameters.groundAlbedo = {};
  baked = tables("earth, black ground", parameters);
}

void ShaftTest::useThinAir() {
  parameters = preset("earth");
  parameters.mie.present = parameters.absorption.present = false;
  parameters.rayleigh.scattering_per_m = {{1e-9, 1e-9, 1e-9}};
  parameters.rayleigh.scaleHeight_m = 1e8;  // the validator's greatest
  parameters.groundAlbedo = {};
  baked = tables("thin", parameters);
}

void ShaftTest::TearDown() {
  clearCasters();
  SkyTest::TearDown();
}

void ShaftTest::clearCasters() {
  engine::Device& device = *context()->device;
  for (CasterBuffers& b : buffers_) {
    destroyBuffer(device, &b.vertices);
    destroyBuffer(device, &b.indices);
    freeBlock(device, &b.block);
  }
  buffers_.clear();
  meshes_.clear();
  rays_.reset();
}

void ShaftTest::addCaster(const reference::test::Mesh& mesh) {
  engine::Device& device = *context()->device;
  std::vector<float> positions(mesh.positions.begin(), mesh.positions.end());
  std::vector<uint32_t> adjacency(2 * mesh.indices.size());
  MeshView view;
  view.positions = positions.data();
  view.vertexCount = static_cast<uint32_t>(positions.size() / 3);
  view.indices = mesh.indices.data();
  view.indexCount = static_cast<uint32_t>(mesh.indices.size());
  ASSERT_EQ(buildAdjacency(view, adjacency.data(), nullptr, nullptr, nullptr), Status::Ok);

  CasterBuffers& b = buffers_.emplace_back();
  b.indexCount = static_cast<uint32_t>(adjacency.size());
  ASSERT_EQ(createBuffer(device, positions.size() * 4, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                         "vertices", &b.vertices),
            Status::Ok);
  ASSERT_EQ(createBuffer(device, adjacency.size() * 4, VK_BUFFER_USAGE_INDEX_BUFFER_BIT, "indices",
                         &b.indices),
            Status::Ok);
  Buffer* both[] = {&b.vertices, &b.indices};
  ASSERT_EQ(
      allocateAndBind(device, "caster",
                      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT,
                      nullptr, 0, both, 2, &b.block),
      Status::Ok);
  std::memcpy(b.vertices.mapped, positions.data(), positions.size() * 4);
  std::memcpy(b.indices.mapped, adjacency.data(), adjacency.size() * 4);

  // As the device has it, rounded.
  reference::test::Mesh rounded = mesh;
  std::copy(positions.begin(), positions.end(), rounded.positions.begin());
  meshes_.push_back(std::move(rounded));
  rays_.reset();
  Vec low = {1e30, 1e30, 1e30}, high = {-1e30, -1e30, -1e30};
  for (const reference::test::Mesh& m : meshes_) {
    for (size_t i = 0; i < m.positions.size(); ++i) {
      low[i % 3] = std::min(low[i % 3], m.positions[i]);
      high[i % 3] = std::max(high[i % 3], m.positions[i]);
    }
  }
  const Vec origin = groundOrigin(parameters);
  bounds_ = Box{};
  for (size_t i = 0; i < 3; ++i) {
    bounds_.center_m[i] = origin[i] + 0.5 * (low[i] + high[i]);
    bounds_.halfAxes_m[i][i] = 0.5 * (high[i] - low[i]);
  }
}

const reference::MeshRays& ShaftTest::rays() {
  if (rays_ == nullptr) {
    const Vec o = groundOrigin(parameters);
    rays_ = std::make_unique<reference::MeshRays>(
        reference::test::raysOf(meshes_, reference::Vector(o[0], o[1], o[2])));
  }
  return *rays_;
}

SkyDraw ShaftTest::drawFrom(const Vec& local, double heading, double pitch, double fov,
                            VkExtent2D extent, double sunElevation, double sunAzimuth) {
  Camera camera = cameraFromGeodetic(parameters, 0.0, 0.0, 0.0, radians(heading), radians(pitch),
                                     0.0, radians(fov));
  const Vec origin = groundOrigin(parameters);
  for (size_t i = 0; i < 3; ++i) camera.position_m[i] = origin[i] + local[i];
  Vec sun;
  sunDirection(0.0, 0.0, radians(sunElevation), radians(sunAzimuth), sun.data());
  SkyDraw draw = makeDraw(camera, sun, extent);
  draw.depth.near_m = 0.1;
  return draw;
}

std::pair<Vec, Vec> ShaftTest::pixelRay(const ShaftSetup& setup, const SkyDraw& draw, double x,
                                        double y) {
  const Camera& c = draw.camera;
  if (setup.projection == Projection::Perspective)
    return {vec(c.position_m), *pixelDirection(draw, setup.projection, x, y)};
  const double width = draw.viewport.extent.width, height = draw.viewport.extent.height;
  const double pixel = c.height_m / height;
  const Vec right = cross(vec(c.forward), vec(c.up));
  Vec origin = vec(c.position_m);
  for (size_t i = 0; i < 3; ++i) {
    origin[i] +=
        pixel * (x + 0.5 - 0.5 * width) * right[i] + pixel * (0.5 * height - y - 0.5) * c.up[i];
  }
  return {origin, vec(c.forward)};
}

Casters ShaftTest::casters() {
  Casters casters;
  casters.bounds = bounds_;
  casters.user = this;
  casters.draw = [](void* user, VkCommandBuffer commands, const CasterPass* pass) {
    auto* test = static_cast<ShaftTest*>(user);
    placeCaster(pass, groundOrigin(test->parameters).data(), nullptr);
    test->drawAll(commands);
  };
  return casters;
}

void ShaftTest::drawAll(VkCommandBuffer commands) {
  const Dispatch& vk = context()->device->vk();
  for (const CasterBuffers& b : buffers_) {
    const VkDeviceSize zero = 0;
    vk.CmdBindVertexBuffers(commands, 0, 1, &b.vertices.handle, &zero);
    vk.CmdBindIndexBuffer(commands, b.indices.handle, 0, VK_INDEX_TYPE_UINT32);
    vk.CmdDrawIndexed(commands, b.indexCount, 1, 0, 0, 0);
  }
}

/// The host's images and its pipeline for depth.
struct ShaftTest::Target {
  Target(engine::Device& d, headless::Device& h, const ShaftSetup& setup, VkExtent2D size)
      : device(d) {
    ImageDesc desc;
    desc.extent = {size.width, size.height, 1};
    desc.format = kColor;
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
    EXPECT_EQ(allocateAndBind(device, "host", VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT, images, 2,
                              nullptr, 0, &block),
              Status::Ok);
    const VkPushConstantRange range = {VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof(HostConstants)};
    EXPECT_EQ(createPipelineLayout(device, nullptr, 0, &range, 1, "host", &layout), Status::Ok);
    const bool reversed = setup.depth == DepthConvention::Reversed;
    GraphicsPipelineDesc draw;
    draw.vertex = {shaders::kTestHostDepth, sizeof shaders::kTestHostDepth, "host_depth"};
    draw.layout = layout;
    draw.vertices = {12, 0};
    draw.topology = Topology::TrianglesWithAdjacency;
    draw.depthFormat = setup.depthFormat;
    draw.depthTest = draw.depthWrite = true;
    draw.depthCompare = reversed ? VK_COMPARE_OP_GREATER : VK_COMPARE_OP_LESS;
    EXPECT_EQ(createGraphicsPipeline(device, draw, &pipeline), Status::Ok);
    std::string error;
    readback = h.createHostBuffer(VkDeviceSize{64} * size.width * size.height,
                                  VK_BUFFER_USAGE_TRANSFER_DST_BIT, &error);
    EXPECT_TRUE(error.empty()) << error;
  }
  ~Target() {
    device.destroyObject(VK_OBJECT_TYPE_PIPELINE, pipeline);
    device.destroyObject(VK_OBJECT_TYPE_PIPELINE_LAYOUT, layout);
    destroyImage(device, &color);
    destroyImage(device, &depth);
    freeBlock(device, &block);
  }
  Target(const Target&) = delete;
  Target& operator=(const Target&) = delete;

  /// Appends a copy of the image to the readback buffer; returns its offset.
  VkDeviceSize copyBack(VkCommandBuffer commands, Image& image, VkImageAspectFlags aspect,
                        uint32_t texelBytes) {
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
  std::vector<float> floats(VkDeviceSize offset, size_t count) const {
    std::vector<float> values(count);
    std::memcpy(values.data(), static_cast<const char*>(readback.data()) + offset, count * 4);
    return values;
  }

  engine::Device& device;
  Image color, depth;
  MemoryBlock block;
  VkPipelineLayout layout = VK_NULL_HANDLE;
  VkPipeline pipeline = VK_NULL_HANDLE;
  headless::HostBuffer readback;
  VkDeviceSize used = 0;
};

Status ShaftTest::recordDepth(VkCommandBuffer commands, const ShaftSetup& setup,
                              const SkyDraw& draw, Target& target) {
  engine::Device& inner = *context()->device;
  const Dispatch& vk = inner.vk();
  const VkExtent2D size = draw.viewport.extent;
  Barriers barriers;
  barriers.discard(target.depth, kDepthDrawn);
  EXPECT_EQ(barriers.record(inner, commands), Status::Ok);
  auto depth = attachmentOf(target.depth, kDepthDrawn.layout, VK_ATTACHMENT_LOAD_OP_CLEAR,
                            VK_ATTACHMENT_STORE_OP_STORE);
  depth.clearValue.depthStencil = {setup.depth == DepthConvention::Reversed ? 0.0f : 1.0f, 0};
  auto rendering = structure<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
  rendering.renderArea = draw.viewport;
  rendering.layerCount = 1;
  rendering.pDepthAttachment = &depth;
  if (hasStencil(setup.depthFormat)) rendering.pStencilAttachment = &depth;
  vk.CmdBeginRendering(commands, &rendering);
  if (setup.hostDepth) {
    const VkViewport viewport = {0.0f, 0.0f, float(size.width), float(size.height), 0.0f, 1.0f};
    vk.CmdSetViewport(commands, 0, 1, &viewport);
    vk.CmdSetScissor(commands, 0, 1, &draw.viewport);
    vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, target.pipeline);
    HostConstants constants = {};
    clipFromCamera(setup.projection, setup.depth, draw, constants.clipFromCamera);
    const Vec origin = groundOrigin(parameters);
    for (size_t i = 0; i < 3; ++i)
      constants.fromCamera[i] = static_cast<float>(origin[i] - draw.camera.position_m[i]);
    vk.CmdPushConstants(commands, target.layout, VK_SHADER_STAGE_VERTEX_BIT, 0, sizeof constants,
                        &constants);
    drawAll(commands);
  }
  vk.CmdEndRendering(commands);
  barriers.image(target.depth, kDepthRead);
  return barriers.record(inner, commands);
}

Status ShaftTest::recordLight(VkCommandBuffer commands, const ShaftSetup& setup,
                              const SkyDraw& draw, View* view, Target& target) {
  engine::Device& inner = *context()->device;
  Barriers barriers;
  barriers.discard(target.color, kColorDrawn);
  EXPECT_EQ(barriers.record(inner, commands), Status::Ok);
  auto color = attachmentOf(target.color, kColorDrawn.layout, VK_ATTACHMENT_LOAD_OP_CLEAR,
                            VK_ATTACHMENT_STORE_OP_STORE);
  auto depth = attachmentOf(target.depth, kDepthRead.layout, VK_ATTACHMENT_LOAD_OP_LOAD,
                            VK_ATTACHMENT_STORE_OP_NONE);
  auto rendering = structure<VkRenderingInfo>(VK_STRUCTURE_TYPE_RENDERING_INFO);
  rendering.renderArea = draw.viewport;
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  rendering.pDepthAttachment = &depth;
  if (hasStencil(setup.depthFormat)) rendering.pStencilAttachment = &depth;
  inner.vk().CmdBeginRendering(commands, &rendering);
  Status status = recordAir(view, commands, device().frame(), baked, draw);
  if (status == Status::Ok) status = recordSky(view, commands, device().frame(), baked, draw);
  inner.vk().CmdEndRendering(commands);
  return status;
}

ShaftPicture ShaftTest::draw(const ShaftSetup& setup, const SkyDraw& draw) {
  engine::Device& inner = *context()->device;
  const VkExtent2D size = draw.viewport.extent;
  Target target(inner, device(), setup, size);
  const FrameInfo none{};

  // A view of the depth alone, as a host has one beside that of its attachment.
  VkImageViewCreateInfo viewInfo =
      structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  viewInfo.image = target.depth.handle;
  viewInfo.viewType = VK_IMAGE_VIEW_TYPE_2D;
  viewInfo.format = setup.depthFormat;
  viewInfo.subresourceRange = {VK_IMAGE_ASPECT_DEPTH_BIT, 0, 1, 0, 1};
  SceneDepth scene;
  scene.format = setup.depthFormat;
  scene.extent = size;
  EXPECT_EQ(inner.vk().CreateImageView(inner.handle(), &viewInfo, nullptr, &scene.view),
            VK_SUCCESS);

  ShaftsDesc shaftsDesc;
  shaftsDesc.method = setup.method;
  shaftsDesc.sceneDepth = scene;
  shaftsDesc.depth = setup.depth;
  shaftsDesc.projection = setup.projection;
  shaftsDesc.sunMapSize = setup.sunMapSize;
  shaftsDesc.samples = setup.samples;
  shaftsDesc.adjacency = true;
  shaftsDesc.reliefSize = setup.reliefSize;
  shaftsDesc.multipleLoss = setup.multipleLoss;
  Shafts* shafts = nullptr;
  if (setup.shafts) {
    EXPECT_EQ(createShafts(context(), shaftsDesc, &shafts), Status::Ok) << message();
  }
  ViewDesc viewDesc;
  viewDesc.colorFormat = kColor;
  viewDesc.depthFormat = setup.depthFormat;
  viewDesc.depth = setup.depth;
  viewDesc.projection = setup.projection;
  viewDesc.sceneDepth = scene;
  viewDesc.shafts = shafts;
  if (setup.sliced && setup.projection != Projection::Orthographic) viewDesc.skySlice = baked;
  View* view = nullptr;
  EXPECT_EQ(createView(context(), viewDesc, &view), Status::Ok) << message();

  ShaftPicture out;
  VkDeviceSize offsets[4] = {};
  const bool paper = setup.method == ShaftMethod::Paper, exact = setup.method == ShaftMethod::Exact;
  const auto step = [&](double* seconds, const std::function<Status(VkCommandBuffer)>& record) {
    headless::Timing timing;
    std::string error = "Recording failed: " + message();
    const bool ran = device().run(
        [&](VkCommandBuffer commands) { return record(commands) == Status::Ok; }, &error, &timing);
    EXPECT_TRUE(ran) << error << " " << message();
    *seconds = timing.cpuSeconds;
  };
  for (uint32_t pass = 0; pass < setup.passes; ++pass) {
    step(&out.seconds.depth,
         [&](VkCommandBuffer c) { return recordDepth(c, setup, draw, target); });
    if (viewDesc.skySlice != nullptr) {
      step(&out.seconds.slice, [&](VkCommandBuffer c) {
        return recordSkySlice(view, c, device().frame(), baked, draw);
      });
    }
    if (shafts != nullptr) {
      step(&out.seconds.sunMap, [&](VkCommandBuffer c) {
        return recordSunMap(shafts, c, device().frame(), draw.sun.direction, casters());
      });
      step(&out.seconds.shafts, [&](VkCommandBuffer c) {
        return recordShafts(shafts, view, c, device().frame(), baked, draw, casters());
      });
    }
    step(&out.seconds.air,
         [&](VkCommandBuffer c) { return recordLight(c, setup, draw, view, target); });
  }
  double unused = 0.0;
  step(&unused, [&](VkCommandBuffer commands) {
    offsets[0] = target.copyBack(commands, target.color, VK_IMAGE_ASPECT_COLOR_BIT, 16);
    offsets[1] = target.copyBack(commands, target.depth, VK_IMAGE_ASPECT_DEPTH_BIT, 4);
    if (shafts != nullptr && exact)
      offsets[2] = target.copyBack(commands, shafts->target(0), VK_IMAGE_ASPECT_COLOR_BIT, 16);
    if (shafts != nullptr && paper) {
      offsets[2] = target.copyBack(commands, shafts->target(0), VK_IMAGE_ASPECT_COLOR_BIT, 8);
      offsets[3] = target.copyBack(commands, shafts->target(1), VK_IMAGE_ASPECT_COLOR_BIT, 8);
    }
    return Status::Ok;
  });
  const size_t pixels = size_t{size.width} * size.height;
  out.light.width = size.width;
  out.light.height = size.height;
  out.light.data = target.floats(offsets[0], 4 * pixels);
  if (setup.depthFormat == VK_FORMAT_D32_SFLOAT) out.depth = target.floats(offsets[1], pixels);
  if (shafts != nullptr && exact) out.sums = target.floats(offsets[2], 4 * pixels);
  if (shafts != nullptr && paper) {
    out.sums = target.floats(offsets[2], 2 * pixels);
    out.bounds = target.floats(offsets[3], 2 * pixels);
  }
  destroyView(view, none);
  destroyShafts(shafts, none);
  inner.vk().DestroyImageView(inner.handle(), scene.view, nullptr);
  return out;
}

}  // namespace alpenglow::testing
