#include "tests/passes/light_shafts/light_shaft_fixture.h"

#include <alpenglow/mesh/adjacency.h>
#include <algorithm>
#include <cmath>
#include <cstring>

#include "atmosphere/api/context_impl.h"
#include "atmosphere/passes/light_shaft_pass.h"
#include "engine/barriers.h"
#include "engine/structure.h"

namespace alpenglow::testing {
namespace {

using namespace engine;

constexpr ImageState kDepthRead = {
    VK_IMAGE_LAYOUT_DEPTH_STENCIL_READ_ONLY_OPTIMAL,
    kDepthDrawn.stage | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT | VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};

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

std::vector<std::unique_ptr<LightShaftRig>>& LightShaftTest::rigs() {
  static std::vector<std::unique_ptr<LightShaftRig>> all;
  return all;
}

LightShaftRig& LightShaftTest::rigOf(const LightShaftSetup& setup, VkExtent2D size) {
  for (const auto& rig : rigs())
    if (rig->isValidFor(setup, size)) return *rig;
  return *rigs().emplace_back(
      std::make_unique<LightShaftRig>(context(), device(), setup, size, baked));
}

void LightShaftTest::TearDownTestSuite() {
  rigs().clear();
  SkyTest::TearDownTestSuite();
}

void LightShaftTest::SetUp() {
  SkyTest::SetUp();
  useEarth();
}

void LightShaftTest::useEarth() {
  parameters = preset("earth");
  parameters.groundAlbedo = {};
  baked = tables("earth, black ground", parameters);
}

void LightShaftTest::useThinMedium() {
  parameters = preset("earth");
  parameters.mie.present = parameters.absorption.present = false;
  parameters.rayleigh.scattering_per_m = {{1e-9, 1e-9, 1e-9}};
  parameters.rayleigh.scaleHeight_m = 1e8;  // the validator's greatest
  parameters.groundAlbedo = {};
  baked = tables("thin", parameters);
}

void LightShaftTest::TearDown() {
  clearCasters();
  SkyTest::TearDown();
}

void LightShaftTest::clearCasters() {
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

void LightShaftTest::addCaster(const reference::test::Mesh& mesh) {
  engine::Device& device = *context()->device;
  std::vector<float> positions(mesh.positions.begin(), mesh.positions.end());
  std::vector<uint32_t> adjacency(2 * mesh.indices.size());
  MeshView view;
  view.positions = positions.data();
  view.vertexCount = static_cast<uint32_t>(positions.size() / 3);
  view.indices = mesh.indices.data();
  view.indexCount = static_cast<uint32_t>(mesh.indices.size());
  ASSERT_EQ(buildAdjacency(view, adjacency.data(), nullptr, {}), Status::Ok);

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
    bounds_.center[i] = origin[i] + 0.5 * (low[i] + high[i]);
    bounds_.halfExtents[i] = 0.5 * (high[i] - low[i]);
  }
}

const reference::MeshRays& LightShaftTest::rays() {
  if (rays_ == nullptr) {
    const Vec o = groundOrigin(parameters);
    rays_ = std::make_unique<reference::MeshRays>(
        reference::test::raysOf(meshes_, reference::Vector(o[0], o[1], o[2])));
  }
  return *rays_;
}

FrameState LightShaftTest::drawFrom(const Vec& local, double heading, double pitch, double fov,
                                    VkExtent2D extent, double sunElevation, double sunAzimuth) {
  EyeCamera camera = cameraFromGeodetic(parameters, 0.0, 0.0, 0.0, radians(heading), radians(pitch),
                                        0.0, radians(fov));
  const Vec origin = groundOrigin(parameters);
  for (size_t i = 0; i < 3; ++i) camera.position_m[i] = origin[i] + local[i];
  Vec sun;
  sunDirection(0.0, 0.0, radians(sunElevation), radians(sunAzimuth), sun.data());
  FrameState draw = makeDraw(camera, sun, extent);
  draw.depth.near_m = 0.1;
  return draw;
}

std::pair<Vec, Vec> LightShaftTest::pixelRay(const LightShaftSetup& setup, const FrameState& draw,
                                             double x, double y) {
  const EyeCamera& c = draw.camera;
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

Casters LightShaftTest::casters(uint64_t version) {
  Casters casters;
  casters.version = version;
  casters.bounds = bounds_;
  casters.user = this;
  casters.draw = [](void* user, VkCommandBuffer commands, const CasterPass& pass) {
    auto* test = static_cast<LightShaftTest*>(user);
    placeCaster(pass, commands, groundOrigin(test->parameters).data(), nullptr);
    if (!test->drawNothing) test->drawAll(commands);
  };
  return casters;
}

FrameDesc LightShaftTest::frameOf(const LightShaftRig& target, const FrameState& draw) {
  FrameDesc desc = frameDesc(draw, baked);
  desc.sceneDepth = target.scene;
  desc.casters = casters();
  return desc;
}

void LightShaftTest::drawAll(VkCommandBuffer commands) {
  const Dispatch& vk = context()->device->vk();
  for (const CasterBuffers& b : buffers_) {
    const VkDeviceSize zero = 0;
    vk.CmdBindVertexBuffers(commands, 0, 1, &b.vertices.handle, &zero);
    vk.CmdBindIndexBuffer(commands, b.indices.handle, 0, VK_INDEX_TYPE_UINT32);
    vk.CmdDrawIndexed(commands, b.indexCount, 1, 0, 0, 0);
  }
}

Status LightShaftTest::recordDepth(VkCommandBuffer commands, const LightShaftSetup& setup,
                                   const FrameState& draw, LightShaftRig& target) {
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
    EXPECT_EQ(clipFromCamera(setup.projection, setup.depth, frameDesc(draw).cameras[0],
                             constants.clipFromCamera),
              Status::Ok);
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

Status LightShaftTest::recordLight(VkCommandBuffer commands, const LightShaftSetup& setup,
                                   const FrameState& draw, View* view, LightShaftRig& target) {
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
  Status status = recordAerialPerspective(view, commands);
  if (status == Status::Ok) status = alpenglow::recordSky(view, commands);
  inner.vk().CmdEndRendering(commands);
  return status;
}

LightShaftPicture LightShaftTest::draw(const LightShaftSetup& setup, const FrameState& draw,
                                       View* with) {
  const VkExtent2D size = draw.viewport.extent;
  LightShaftRig& target = rigOf(setup, size);
  View* view = with != nullptr ? with : target.view;
  target.used = 0;

  LightShaftPicture out;
  VkDeviceSize offsets[4] = {};
  const bool paper = setup.method == LightShaftMethod::ShadowVolume,
             exact = setup.method == LightShaftMethod::LightVolume;
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
    EXPECT_EQ(beginFrame(view, frameOf(target, draw), nullptr), Status::Ok) << message();
    if (setup.fromLut)
      step(&out.seconds.luts, [&](VkCommandBuffer c) { return alpenglow::recordLuts(view, c); });
    if (setup.shafts) {
      step(&out.seconds.shadowMap, [&](VkCommandBuffer c) { return recordShadowMap(view, c); });
      step(&out.seconds.shafts, [&](VkCommandBuffer c) { return recordLightShafts(view, c); });
    }
    step(&out.seconds.air,
         [&](VkCommandBuffer c) { return recordLight(c, setup, draw, view, target); });
  }
  double unused = 0.0;
  step(&unused, [&](VkCommandBuffer commands) {
    offsets[0] = target.copyBack(commands, target.color, VK_IMAGE_ASPECT_COLOR_BIT, 16);
    offsets[1] = target.copyBack(commands, target.depth, VK_IMAGE_ASPECT_DEPTH_BIT, 4);
    if (setup.shafts && exact)
      offsets[2] =
          target.copyBack(commands, view->lightShafts().target(0), VK_IMAGE_ASPECT_COLOR_BIT, 16);
    if (setup.shafts && paper) {
      for (uint32_t i = 0; i < 2; ++i) {
        offsets[2 + i] =
            target.copyBack(commands, view->lightShafts().target(i), VK_IMAGE_ASPECT_COLOR_BIT, 8);
      }
    }
    return Status::Ok;
  });
  const size_t pixels = size_t{size.width} * size.height;
  out.light.width = size.width;
  out.light.height = size.height;
  out.light.data = target.floats(offsets[0], 4 * pixels);
  if (setup.depthFormat == VK_FORMAT_D32_SFLOAT) out.depth = target.floats(offsets[1], pixels);
  if (setup.shafts && exact) out.sums = target.floats(offsets[2], 4 * pixels);
  if (setup.shafts && paper) {
    out.sums = target.floats(offsets[2], 2 * pixels);
    out.bounds = target.floats(offsets[3], 2 * pixels);
  }
  return out;
}

}  // namespace alpenglow::testing
