#include "picture.h"

#include <cstring>

namespace alpenglow::cli {
namespace {

struct ViewDeleter {
  Session* session = nullptr;
  void operator()(View* view) const { destroyView(view, session->device().frame()); }
};
using ViewPointer = std::unique_ptr<View, ViewDeleter>;

class Sampler {
 public:
  explicit Sampler(Session* session) : session_(session) {
    VkSamplerCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = VK_FILTER_LINEAR;
    info.minFilter = VK_FILTER_LINEAR;
    info.mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR;
    info.addressModeU = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    info.addressModeV = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    info.maxLod = VK_LOD_CLAMP_NONE;
    const auto create = session->function<PFN_vkCreateSampler>("vkCreateSampler");
    const VkResult result = create(session->device().device(), &info, nullptr, &sampler_);
    session->check(result == VK_SUCCESS ? Status::Ok : Status::VulkanError);
  }
  Sampler(const Sampler&) = delete;
  Sampler& operator=(const Sampler&) = delete;
  ~Sampler() {
    session_->function<PFN_vkDestroySampler>("vkDestroySampler")(session_->device().device(),
                                                                 sampler_, nullptr);
  }
  VkSampler get() const { return sampler_; }

 private:
  Session* session_;
  VkSampler sampler_ = VK_NULL_HANDLE;
};

void transition(Session* session, VkCommandBuffer commands, const headless::Image& image,
                const ImageState& from, const ImageState& to) {
  VkImageMemoryBarrier2 barrier = {};
  barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
  barrier.srcStageMask = from.stage;
  barrier.srcAccessMask = from.access;
  barrier.dstStageMask = to.stage;
  barrier.dstAccessMask = to.access;
  barrier.oldLayout = from.layout;
  barrier.newLayout = to.layout;
  barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image.image();
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, image.levels(), 0, 1};
  VkDependencyInfo dependency = {};
  dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  session->function<PFN_vkCmdPipelineBarrier2>("vkCmdPipelineBarrier2")(commands, &dependency);
}

constexpr ImageState kUndefined = {};
constexpr ImageState kUploaded = {VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                                  VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT};
constexpr ImageState kSampled = {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                                 VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                                 VK_ACCESS_2_SHADER_SAMPLED_READ_BIT};
constexpr ImageState kDrawn = {
    VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
    VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT};
constexpr ImageState kCopied = {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT,
                                VK_ACCESS_2_TRANSFER_READ_BIT};

VkBufferImageCopy wholeLevel(VkDeviceSize offset, uint32_t level, uint32_t width, uint32_t height) {
  VkBufferImageCopy copy = {};
  copy.bufferOffset = offset;
  copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, level, 0, 1};
  copy.imageExtent = {width, height, 1};
  return copy;
}

headless::Image uploadAlbedo(Session* session, const io::AlbedoMap& map) {
  std::vector<VkBufferImageCopy> copies;
  VkDeviceSize bytes = 0;
  for (const io::AlbedoMap::Level& level : map.levels) {
    copies.push_back(
        wholeLevel(bytes, static_cast<uint32_t>(copies.size()), level.width, level.height));
    bytes += level.rgba.size();
  }
  const headless::HostBuffer buffer = session->hostBuffer(bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  for (size_t i = 0; i < copies.size(); ++i) {
    std::memcpy(static_cast<char*>(buffer.data()) + copies[i].bufferOffset,
                map.levels[i].rgba.data(), map.levels[i].rgba.size());
  }
  const uint32_t levels = static_cast<uint32_t>(map.levels.size());
  headless::Image image =
      session->image({map.levels[0].width, map.levels[0].height}, VK_FORMAT_R8G8B8A8_SRGB,
                     VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, levels);
  const auto copy = session->function<PFN_vkCmdCopyBufferToImage>("vkCmdCopyBufferToImage");
  session->run([&](VkCommandBuffer commands) {
    transition(session, commands, image, kUndefined, kUploaded);
    copy(commands, buffer.buffer(), image.image(), kUploaded.layout, levels, copies.data());
    transition(session, commands, image, kUploaded, kSampled);
    return "upload";
  });
  return image;
}

SkyDraw describeDraw(const io::Scene& scene) {
  const io::SceneCamera& c = scene.camera;
  SkyDraw draw;
  draw.camera = cameraFromGeodetic(scene.atmosphere, c.latitude, c.longitude, c.altitude_m,
                                   c.heading, c.pitch, c.roll, c.fov);
  sunDirection(c.latitude, c.longitude, scene.sun.elevation, scene.sun.azimuth, draw.sun.direction);
  draw.sun.irradiance = scene.atmosphere.solarIrradiance;
  draw.sun.discRadius = scene.sun.discRadius;
  draw.viewport = {{0, 0}, {scene.width, scene.height}};
  return draw;
}

void recordPicture(Session* session, VkCommandBuffer commands, const headless::Image& target,
                   View* view, const Tables* tables, const SkyDraw& draw) {
  VkRenderingAttachmentInfo color = {};
  color.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
  color.imageView = target.view();
  color.imageLayout = kDrawn.layout;
  color.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
  color.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
  VkRenderingInfo rendering = {};
  rendering.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
  rendering.renderArea = draw.viewport;
  rendering.layerCount = 1;
  rendering.colorAttachmentCount = 1;
  rendering.pColorAttachments = &color;
  const FrameInfo frame = session->device().frame();
  session->check(recordSkySlice(view, commands, frame, tables, draw));
  transition(session, commands, target, kUndefined, kDrawn);
  session->function<PFN_vkCmdBeginRendering>("vkCmdBeginRendering")(commands, &rendering);
  session->check(recordSky(view, commands, frame, tables, draw));
  session->function<PFN_vkCmdEndRendering>("vkCmdEndRendering")(commands);
  transition(session, commands, target, kDrawn, kCopied);
}

io::LinearImage readPicture(Session* session, const PictureTarget& target) {
  const VkExtent2D size = target.image.extent();
  const size_t pixels = size_t{size.width} * size.height;
  session->run([&](VkCommandBuffer commands) {
    const VkBufferImageCopy copy = wholeLevel(0, 0, size.width, size.height);
    session->function<PFN_vkCmdCopyImageToBuffer>("vkCmdCopyImageToBuffer")(
        commands, target.image.image(), kCopied.layout, target.readback.buffer(), 1, &copy);
    VkMemoryBarrier2 toHost = {};
    toHost.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
    toHost.srcStageMask = VK_PIPELINE_STAGE_2_COPY_BIT;
    toHost.srcAccessMask = VK_ACCESS_2_TRANSFER_WRITE_BIT;
    toHost.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
    toHost.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
    VkDependencyInfo dependency = {};
    dependency.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    dependency.memoryBarrierCount = 1;
    dependency.pMemoryBarriers = &toHost;
    session->function<PFN_vkCmdPipelineBarrier2>("vkCmdPipelineBarrier2")(commands, &dependency);
    return "readback";
  });
  io::LinearImage image{size.width, size.height, std::vector<float>(pixels * 3)};
  const float* rgba = static_cast<const float*>(target.readback.data());
  for (size_t i = 0; i < pixels; ++i) {
    std::memcpy(&image.pixels[i * 3], rgba + i * 4, 3 * sizeof(float));
  }
  return image;
}

}  // namespace

io::LinearImage drawScene(Session* session, const io::Scene& scene, const io::AlbedoMap* albedo,
                          const ReadyTables& ready, const PictureTarget& target) {
  const Sampler sampler(session);
  headless::Image albedoImage;
  ViewDesc desc;
  desc.colorFormat = kPictureFormat;
  desc.projection = scene.camera.projection;
  desc.solver = ready.desc.solver;
  desc.mie = ready.desc.mie;
  desc.skySlice = ready.tables.get();
  if (albedo != nullptr) {
    albedoImage = uploadAlbedo(session, *albedo);
    desc.groundAlbedo = {albedoImage.view(), sampler.get(), kSampled.layout,
                         albedoImage.extent().width, albedoImage.extent().height};
  }
  View* made = nullptr;
  session->check(createView(session->context(), desc, &made));
  const ViewPointer view(made, ViewDeleter{session});
  session->run([&](VkCommandBuffer commands) {
    recordPicture(session, commands, target.image, view.get(), ready.tables.get(),
                  describeDraw(scene));
    return "sky";
  });
  return readPicture(session, target);
}

}  // namespace alpenglow::cli
