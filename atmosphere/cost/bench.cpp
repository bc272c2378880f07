#include "atmosphere/cost/bench.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numbers>

namespace alpenglow::cost {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr CapabilityFlags kWanted = kCapabilityBake | kCapabilitySky;
/// Of a submission, in work units.
constexpr uint64_t kSliceBudget = 50'000'000;

void keep(void* user, const Diagnostic& diagnostic) {
  *static_cast<std::string*>(user) = diagnostic.message;
}

}  // namespace

Bench::Bench(const std::string& device, VkExtent2D frame, bool validation) {
  headless::DeviceOptions options;
  options.select = device;
  options.validation = validation;
  options.requirements = [](PFN_vkGetInstanceProcAddr getProcAddr, VkInstance instance,
                            VkPhysicalDevice physical, Requirements* out, std::string* missing) {
    ContextDesc desc;
    desc.instance = instance;
    desc.physicalDevice = physical;
    desc.getInstanceProcAddr = getProcAddr;
    desc.capabilities = kWanted;
    desc.diagnostics = {keep, missing};
    return queryRequirements(desc, out);
  };
  device_ = headless::Device::create(options, &error_);
  if (!device_) throw Failure(error_);
  renew();
  headless::TargetDesc target;
  target.extent = frame;
  target.color = kFormat;
  target_ = headless::Target::create(*device_, target, &error_);
  if (target_ == nullptr) throw Failure(error_);
  describeDriver();
}

Bench::~Bench() { destroyContext(context_); }

void Bench::checkValidation() const {
  const std::vector<std::string> messages = device_->validationMessages();
  if (!messages.empty()) throw Failure("A validation layer says: " + messages.front());
}

void Bench::renew() {
  destroyContext(context_);
  context_ = nullptr;
  ContextDesc desc = device_->contextDesc();
  desc.capabilities = kWanted;
  desc.diagnostics = {keep, &error_};
  if (createContext(desc, &context_) != Status::Ok) throw Failure(error_);
}

void Bench::describeDriver() {
  VkPhysicalDeviceDriverProperties driver = {};
  driver.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DRIVER_PROPERTIES;
  VkPhysicalDeviceProperties2 properties = {};
  properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
  properties.pNext = &driver;
  reinterpret_cast<PFN_vkGetPhysicalDeviceProperties2>(
      device_->getInstanceProcAddr()(device_->instance(), "vkGetPhysicalDeviceProperties2"))(
      device_->physicalDevice(), &properties);
  software_ = properties.properties.deviceType == VK_PHYSICAL_DEVICE_TYPE_CPU;
  driver_ = std::string(driver.driverName) + " " + driver.driverInfo;
  const uint32_t version = properties.properties.apiVersion;
  vulkan_ = std::to_string(VK_API_VERSION_MAJOR(version)) + "." +
            std::to_string(VK_API_VERSION_MINOR(version)) + "." +
            std::to_string(VK_API_VERSION_PATCH(version));
}

void Bench::advance() {
  const uint64_t next = device_->skipFrame();
  if (advanceFrame(context_, next, next - 1) != Status::Ok) throw Failure(error_);
}

double Bench::run(const std::function<Status(VkCommandBuffer)>& record) {
  headless::Timing timing;
  std::string failed;
  error_.clear();
  const bool good = device_->run(
      [&](VkCommandBuffer commands) { return record(commands) == Status::Ok; }, &failed, &timing);
  if (!good) throw Failure(error_.empty() ? failed : error_);
  advance();
  return software_ || timing.gpuSeconds < 0.0 ? timing.cpuSeconds : timing.gpuSeconds;
}

TablesPointer Bench::bake(const Parameters& parameters, const TableDesc& desc, double* seconds) {
  Tables* made = nullptr;
  error_.clear();
  if (createTables(context_, parameters, desc, &made) != Status::Ok) return {};
  TablesPointer tables(made, TablesDeleter{device_.get()});
  *seconds = 0.0;
  BakeProgress progress;
  while (!progress.done) {
    *seconds += run([&](VkCommandBuffer commands) {
      return recordBake(made, commands, kSliceBudget, &progress);
    });
  }
  return tables;
}

ResourceReport Bench::resources() {
  advance();
  ResourceReport report;
  resourceReport(context_, &report);
  return report;
}

ViewPointer Bench::view(const Drawn& drawn) {
  ViewDesc desc;
  desc.colorFormat = kFormat;
  desc.disabledEffects = drawn.viewDisabledEffects;
  desc.sky = drawn.fromLut ? SkyMethod::Lut : SkyMethod::Integrate;
  View* made = nullptr;
  if (createView(context_, drawn.tables, desc, &made) != Status::Ok) throw Failure(error_);
  return ViewPointer(made, ViewDeleter{device_.get()});
}

double Bench::frame(View* view, const FrameDesc& draw) {
  return run([&](VkCommandBuffer commands) {
    Status status = beginFrame(view, draw, nullptr);
    if (status == Status::Ok) status = recordLuts(view, commands);
    if (status != Status::Ok) return status;
    target_->prepare(commands);
    target_->begin(commands, draw.cameras[0].viewport, VK_ATTACHMENT_LOAD_OP_DONT_CARE);
    status = recordSky(view, commands);
    target_->end(commands);
    return status;
  });
}

io::LinearImage Bench::read(VkExtent2D size) {
  run([&](VkCommandBuffer commands) {
    target_->copy(commands, size);
    return Status::Ok;
  });
  io::LinearImage image{size.width, size.height, {}};
  const std::vector<float> rgba = target_->pixels(size);
  for (size_t i = 0; i < rgba.size(); i += 4)
    image.pixels.insert(image.pixels.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
  return image;
}

Status Bench::recordRays(VkCommandBuffer commands, View* view,
                         const std::vector<FrameDesc>& draws) {
  target_->prepare(commands);
  for (size_t i = 0; i < draws.size(); ++i) {
    const FrameDesc& draw = draws[i];
    // Neighbours share altitude and sun: their LUT is reused.
    Status status = beginFrame(view, draw, nullptr);
    if (status == Status::Ok) status = recordLuts(view, commands);
    if (status != Status::Ok) return status;
    target_->begin(commands, draw.cameras[0].viewport,
                   i == 0 ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD);
    status = recordSky(view, commands);
    target_->end(commands);
    if (status != Status::Ok) return status;
  }
  return Status::Ok;
}

std::vector<Spectrum> Bench::radiance(View* view, const Parameters& parameters,
                                      const std::vector<ProbeQuery>& rays) {
  std::vector<Spectrum> result;
  const uint32_t width = target_->extent().width;
  for (size_t first = 0; first < rays.size(); first += width) {
    const size_t count = std::min<size_t>(rays.size() - first, width);
    std::vector<FrameDesc> draws;
    for (size_t i = 0; i < count; ++i)
      draws.push_back(drawOfRay(parameters, rays[first + i], static_cast<int32_t>(i)));
    run([&](VkCommandBuffer commands) { return recordRays(commands, view, draws); });
    const io::LinearImage row = read({static_cast<uint32_t>(count), 1});
    for (size_t i = 0; i < count; ++i)
      result.push_back({{row.pixels[3 * i], row.pixels[3 * i + 1], row.pixels[3 * i + 2]}});
  }
  return result;
}

ImageInfo Bench::imageOf(const Tables* tables, TableId id) {
  TablesInfo info;
  if (tablesInfo(tables, &info) != Status::Ok) throw Failure(error_);
  return info.images[id];
}

std::vector<float> Bench::readTable(Tables* tables, TableId id, ImageInfo* info) {
  *info = imageOf(tables, id);
  const headless::HostBuffer buffer =
      device_->createHostBuffer(info->bytes, VK_BUFFER_USAGE_TRANSFER_DST_BIT, &error_);
  if (buffer.data() == nullptr) throw Failure(error_);
  run([&](VkCommandBuffer commands) {
    return recordTableReadback(tables, commands, id, buffer.buffer(), 0);
  });
  const size_t count = size_t{4} * info->extent.width * info->extent.height * info->extent.depth;
  std::vector<float> rgba(count);
  const bool half = info->format == VK_FORMAT_R16G16B16A16_SFLOAT;
  for (size_t i = 0; i < count; ++i) {
    rgba[i] = half ? glm::unpackHalf1x16(static_cast<const uint16_t*>(buffer.data())[i])
                   : static_cast<const float*>(buffer.data())[i];
  }
  return rgba;
}

TablesPointer Bench::withSource(const Parameters& parameters, const TableDesc& desc, Tables* from,
                                const std::vector<float>& source) {
  Tables* made = nullptr;
  if (createTables(context_, parameters, desc, &made) != Status::Ok) throw Failure(error_);
  TablesPointer tables(made, TablesDeleter{device_.get()});
  for (const TableId id : {kTableOpticalDepth, kTableMoments, kTableSource}) {
    ImageInfo info;
    std::vector<float> rgba = readTable(from, id, &info);
    if (id == kTableSource) rgba = source;
    upload(made, id, rgba);
  }
  return tables;
}

void Bench::upload(Tables* tables, TableId id, const std::vector<float>& rgba) {
  const ImageInfo info = imageOf(tables, id);
  const headless::HostBuffer buffer =
      device_->createHostBuffer(info.bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT, &error_);
  if (buffer.data() == nullptr) throw Failure(error_);
  const bool half = info.format == VK_FORMAT_R16G16B16A16_SFLOAT;
  for (size_t i = 0; i < rgba.size(); ++i) {
    if (half) {
      static_cast<uint16_t*>(buffer.data())[i] = glm::packHalf1x16(rgba[i]);
    } else {
      static_cast<float*>(buffer.data())[i] = rgba[i];
    }
  }
  run([&](VkCommandBuffer commands) {
    return recordTableUpload(tables, commands, id, buffer.buffer(), 0);
  });
}

FrameDesc drawOfRay(const Parameters& parameters, const ProbeQuery& ray, int32_t x) {
  FrameDesc draw;
  Camera& camera = draw.cameras[0];
  camera.position[2] = parameters.bottomRadius_m + ray.altitude_m;
  const double sine = std::sin(ray.zenith), cosine = std::cos(ray.zenith);
  const double east = std::cos(ray.azimuth), north = std::sin(ray.azimuth);
  const double forward[3] = {sine * east, sine * north, cosine};
  const double up[3] = {-cosine * east, -cosine * north, sine};
  std::copy_n(forward, 3, camera.forward);
  std::copy_n(up, 3, camera.up);
  camera.fov = 1e-4;  // Of a single pixel, whose centre is the ray.
  draw.lights[0].direction[0] = std::sin(ray.sunZenith);
  draw.lights[0].direction[2] = std::cos(ray.sunZenith);
  draw.cameras[0].viewport = {{x, 0}, {1, 1}};
  return draw;
}

FrameDesc drawOfView(const Parameters& parameters, double altitude_m, double sun, double azimuth,
                     double pitch, double fov, VkExtent2D size) {
  FrameDesc draw;
  draw.cameras[0] =
      cameraAt(parameters, draw.world, 0.0, 0.0, altitude_m, 0.0, pitch * kDegree, 0.0);
  draw.cameras[0].fov = fov * kDegree;
  directionAt(draw.world, 0.0, 0.0, sun * kDegree, azimuth * kDegree, draw.lights[0].direction);
  draw.cameras[0].viewport = {{0, 0}, size};
  return draw;
}

}  // namespace alpenglow::cost
