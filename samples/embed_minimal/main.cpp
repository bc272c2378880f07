// A host in one file: makes its own Vulkan device, bakes the tables in slices, draws the sky from
// its LUT and writes the picture: embed_minimal OUT.ppm [--small]   (--small: two orders of
// scattering)
#ifdef EMBED_USE_VOLK
#define VOLK_IMPLEMENTATION
#include <volk.h>
#else
#include <vulkan/vulkan.h>
static VkResult volkInitialize() { return VK_SUCCESS; }  // A linked loader needs no loading.
static void volkLoadInstance(VkInstance) {}
#endif

#include <alpenglow/alpenglow.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <string>

namespace {
namespace ag = alpenglow;
constexpr uint32_t kWidth = 640, kHeight = 360;
constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr uint64_t kSliceUnits = 50'000'000;  // About so many table fetches in a frame, at most.
constexpr double kDegree = 3.14159265358979323846 / 180.0;

struct Host {
  ag::ContextDesc vulkan;  // Instance, devices and what is enabled: what Alpenglow gets.
  uint32_t family = 0;
  VkQueue queue{};
  VkCommandPool pool{};
  VkCommandBuffer commands{};
  VkImage image{};  // The sky is drawn into it ...
  VkImageView view{};
  VkBuffer buffer{};  // ... and read through this.
  VkDeviceMemory imageMemory{}, bufferMemory{};
  ag::Context* context{};
  uint64_t frame = 0;  // The newest that was recorded, and has finished.
};

[[noreturn]] void fail(const std::string& sentence) {
  std::fprintf(stderr, "%s\n", sentence.c_str());
  std::exit(1);
}

template <typename Result>  // A VkResult or a Status: success is 0 in both.
void check(Result result, const char* what) {
  if (result != Result{}) fail(std::string(what) + " failed.");
}

void makeDevice(Host& host) {
  ag::ContextDesc& vk = host.vulkan;
  check(volkInitialize(), "Finding the Vulkan loader");
  VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
  application.apiVersion = VK_API_VERSION_1_3;
  VkInstanceCreateInfo instance{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO, nullptr, 0, &application};
  check(vkCreateInstance(&instance, nullptr, &vk.instance), "Making the instance");
  volkLoadInstance(vk.instance);
  uint32_t count = 1;  // The first device will do.
  vkEnumeratePhysicalDevices(vk.instance, &count, &vk.physicalDevice);
  if (count == 0) fail("There is no Vulkan device.");
  vk.getInstanceProcAddr = vkGetInstanceProcAddr;
  vk.diagnostics.report = [](void*, const ag::Diagnostic& diagnostic) {
    std::fprintf(stderr, "%s\n", diagnostic.message);
  };
  check(ag::queryRequirements(vk, &vk.enabled), "Asking the device for what is needed");
  VkQueueFamilyProperties families[16];
  count = 16;
  vkGetPhysicalDeviceQueueFamilyProperties(vk.physicalDevice, &count, families);
  constexpr VkQueueFlags kWanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
  while (host.family < count && (families[host.family].queueFlags & kWanted) != kWanted)
    ++host.family;
  if (host.family == count) fail("The device has no queue for both graphics and compute.");
  VkPhysicalDeviceVulkan13Features features13{
      VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
  features13.synchronization2 = features13.dynamicRendering = VK_TRUE;
  VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &features13,
                                     vk.enabled.features};
  const float priority = 1.0f;
  VkDeviceQueueCreateInfo queue{
      VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO, nullptr, 0, host.family, 1, &priority};
  VkDeviceCreateInfo device{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features, 0, 1, &queue};
  check(vkCreateDevice(vk.physicalDevice, &device, nullptr, &vk.device), "Making the device");
  vkGetDeviceQueue(vk.device, host.family, 0, &host.queue);
  VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO, nullptr, 0, host.family};
  check(vkCreateCommandPool(vk.device, &pool, nullptr, &host.pool), "Making the pool");
  VkCommandBufferAllocateInfo commands{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO, nullptr,
                                       host.pool, VK_COMMAND_BUFFER_LEVEL_PRIMARY, 1};
  check(vkAllocateCommandBuffers(vk.device, &commands, &host.commands), "Making commands");
}

VkDeviceMemory allocate(const Host& host, const VkMemoryRequirements& request,
                        VkMemoryPropertyFlags flags) {
  VkPhysicalDeviceMemoryProperties memory;
  vkGetPhysicalDeviceMemoryProperties(host.vulkan.physicalDevice, &memory);
  uint32_t type = 0;  // Vulkan promises that one fits.
  while (!(request.memoryTypeBits >> type & 1) ||
         (memory.memoryTypes[type].propertyFlags & flags) != flags)
    ++type;
  VkMemoryAllocateInfo info{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO, nullptr, request.size, type};
  VkDeviceMemory result{};
  check(vkAllocateMemory(host.vulkan.device, &info, nullptr, &result), "Allocating memory");
  return result;
}

void makeImage(Host& host) {
  const VkDevice device = host.vulkan.device;
  VkMemoryRequirements request;
  VkImageCreateInfo image{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
  image.imageType = VK_IMAGE_TYPE_2D;
  image.format = kFormat;
  image.extent = {kWidth, kHeight, 1};
  image.mipLevels = image.arrayLayers = 1;
  image.samples = VK_SAMPLE_COUNT_1_BIT;
  image.usage = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
  check(vkCreateImage(device, &image, nullptr, &host.image), "Making the image");
  vkGetImageMemoryRequirements(device, host.image, &request);
  host.imageMemory = allocate(host, request, 0);
  check(vkBindImageMemory(device, host.image, host.imageMemory, 0), "Binding memory");
  VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO, nullptr, 0, host.image};
  view.viewType = VK_IMAGE_VIEW_TYPE_2D;
  view.format = kFormat;
  view.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  check(vkCreateImageView(device, &view, nullptr, &host.view), "Making the image view");
  VkBufferCreateInfo buffer{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO, nullptr, 0,
                            kWidth * kHeight * 4 * sizeof(float), VK_BUFFER_USAGE_TRANSFER_DST_BIT};
  check(vkCreateBuffer(device, &buffer, nullptr, &host.buffer), "Making the buffer");
  vkGetBufferMemoryRequirements(device, host.buffer, &request);
  host.bufferMemory = allocate(
      host, request, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT);
  check(vkBindBufferMemory(device, host.buffer, host.bufferMemory, 0), "Binding memory");
}

// One frame: record, submit, wait. A game keeps several in flight and states which have completed.
void runFrame(Host& host, const std::function<void()>& record) {
  check(ag::advanceFrame(host.context, host.frame + 1, host.frame), "Advancing the frame");
  check(vkResetCommandPool(host.vulkan.device, host.pool, 0), "Resetting the pool");
  VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO, nullptr, 0, nullptr};
  check(vkBeginCommandBuffer(host.commands, &begin), "Beginning to record");
  record();
  check(vkEndCommandBuffer(host.commands), "Recording");
  VkSubmitInfo submit{
      VK_STRUCTURE_TYPE_SUBMIT_INFO, nullptr, 0, nullptr, nullptr, 1, &host.commands};
  check(vkQueueSubmit(host.queue, 1, &submit, VK_NULL_HANDLE), "Submitting");
  check(vkQueueWaitIdle(host.queue), "Waiting");
  ++host.frame;
}

void transition(const Host& host, VkImageLayout from, VkImageLayout to) {
  constexpr VkAccessFlags kAny = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
  VkImageMemoryBarrier barrier{
      VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER, nullptr, kAny, kAny, from, to};
  barrier.image = host.image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  vkCmdPipelineBarrier(host.commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT,
                       VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0, nullptr, 0, nullptr, 1, &barrier);
}

void recordPicture(Host& host, ag::View* view, const ag::FrameDesc& frame) {
  constexpr VkImageLayout kLayout = VK_IMAGE_LAYOUT_GENERAL;  // A game uses the optimal ones.
  VkRenderingAttachmentInfo color{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO, nullptr, host.view,
                                  kLayout};
  VkRenderingInfo rendering{
      VK_STRUCTURE_TYPE_RENDERING_INFO, nullptr, 0, {{}, {kWidth, kHeight}}, 1, 0, 1, &color};
  check(ag::beginFrame(view, frame, nullptr), "Beginning the frame");
  check(ag::recordLuts(view, host.commands), "Updating the LUTs");
  transition(host, VK_IMAGE_LAYOUT_UNDEFINED, kLayout);
  vkCmdBeginRendering(host.commands, &rendering);
  check(ag::recordSky(view, host.commands), "Drawing the sky");
  vkCmdEndRendering(host.commands);
  transition(host, kLayout, kLayout);
  VkBufferImageCopy copy{0, 0, 0, {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1}, {}, {kWidth, kHeight, 1}};
  vkCmdCopyImageToBuffer(host.commands, host.image, kLayout, host.buffer, 1, &copy);
}

void writePicture(const Host& host, const std::string& path) {
  float* pixels = nullptr;
  check(vkMapMemory(host.vulkan.device, host.bufferMemory, 0, VK_WHOLE_SIZE, 0,
                    reinterpret_cast<void**>(&pixels)),
        "Mapping");
  std::ofstream file(path, std::ios::binary);
  file << "P6\n" << kWidth << ' ' << kHeight << "\n255\n";
  for (uint32_t i = 0; i < kWidth * kHeight * 4; ++i) {
    if (!std::isfinite(pixels[i])) fail("A value of the picture is not finite.");
    const double shown = std::pow(1.0 - std::exp(-10.0 * pixels[i]), 1.0 / 2.2);
    if (i % 4 != 3) file.put(static_cast<char>(std::lround(255.0 * shown)));
  }
  if (!file.flush()) fail("The picture " + path + " could not be written.");
}

void drawSky(Host& host, const std::string& path, bool small) {
  check(ag::createContext(host.vulkan, &host.context), "Making the context");
  ag::Parameters earth;
  check(ag::findPreset("earth", &earth, host.vulkan.diagnostics), "Finding the Earth");
  ag::TableDesc desc;
  if (small) desc.orders = 2, desc.quality = ag::Quality::Draft;
  ag::Tables* tables = nullptr;
  check(ag::createTables(host.context, earth, desc, &tables), "Making the tables");
  ag::BakeProgress bake;
  const auto slice = [&] {
    check(ag::recordBake(tables, host.commands, kSliceUnits, &bake), "Baking");
  };
  while (!bake.done) runFrame(host, slice);
  ag::ViewDesc viewDesc;
  viewDesc.colorFormat = kFormat;
  ag::View* view = nullptr;
  check(ag::createView(host.context, tables, viewDesc, &view), "Making the view");
  ag::FrameDesc frame;  // Its world is the planet frame; a game calls placeWorld.
  frame.cameras[0] =
      ag::cameraAt(earth, frame.world, 0.0, 0.0, 500.0, 90 * kDegree, 15 * kDegree, 0.0);
  frame.cameras[0].viewport.extent = {kWidth, kHeight};
  ag::directionAt(frame.world, 0.0, 0.0, 30 * kDegree, 140 * kDegree, frame.lights[0].direction);
  runFrame(host, [&] { recordPicture(host, view, frame); });
  writePicture(host, path);
  ag::destroyContext(host.context);  // With the view and the tables.
}

void destroy(const Host& host) {
  vkDestroyImageView(host.vulkan.device, host.view, nullptr);
  vkDestroyImage(host.vulkan.device, host.image, nullptr);
  vkDestroyBuffer(host.vulkan.device, host.buffer, nullptr);
  vkFreeMemory(host.vulkan.device, host.imageMemory, nullptr);
  vkFreeMemory(host.vulkan.device, host.bufferMemory, nullptr);
  vkDestroyCommandPool(host.vulkan.device, host.pool, nullptr);
  vkDestroyDevice(host.vulkan.device, nullptr);
  vkDestroyInstance(host.vulkan.instance, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) fail("Usage: embed_minimal OUT.ppm [--small]");
  Host host;
  makeDevice(host), makeImage(host);
  drawSky(host, argv[1], argc > 2 && std::string(argv[2]) == "--small");
  destroy(host);
}
