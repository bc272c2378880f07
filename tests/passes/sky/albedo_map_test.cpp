// The ground's albedo from the host's map: the same light as a uniform albedo, the right way round.
#include <cmath>
#include <cstring>

#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

constexpr uint32_t kWidth = 64, kHeight = 32;

/// A float map with a sampler as ViewDesc::groundAlbedo asks for.
class Map {
 public:
  /// albedo(longitude, latitude), radians, at texel centres.
  Map(headless::Device& device, const std::function<Vec(double, double)>& albedo)
      : device_(device) {
    std::string error;
    image_ =
        device.createImage({kWidth, kHeight}, VK_FORMAT_R32G32B32A32_SFLOAT,
                           VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT, 1, &error);
    headless::HostBuffer texels = device.createHostBuffer(sizeof(float) * 4 * kWidth * kHeight,
                                                          VK_BUFFER_USAGE_TRANSFER_SRC_BIT, &error);
    auto* out = static_cast<float*>(texels.data());
    for (uint32_t y = 0; y < kHeight; ++y) {
      for (uint32_t x = 0; x < kWidth; ++x) {
        const Vec a =
            albedo(2.0 * kPi * ((x + 0.5) / kWidth - 0.5), kPi * (0.5 - (y + 0.5) / kHeight));
        for (size_t c = 0; c < 3; ++c) *out++ = static_cast<float>(a[c]);
        *out++ = 1.0f;
      }
    }
    upload(texels.buffer(), &error);
    VkSamplerCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    info.magFilter = info.minFilter = VK_FILTER_LINEAR;
    info.addressModeU = VK_SAMPLER_ADDRESS_MODE_REPEAT;
    info.addressModeV = info.addressModeW = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
    EXPECT_EQ(reinterpret_cast<PFN_vkCreateSampler>(device.function("vkCreateSampler"))(
                  device.device(), &info, nullptr, &sampler_),
              VK_SUCCESS);
  }
  ~Map() {
    reinterpret_cast<PFN_vkDestroySampler>(device_.function("vkDestroySampler"))(device_.device(),
                                                                                 sampler_, nullptr);
  }
  Map(const Map&) = delete;
  Map& operator=(const Map&) = delete;

  HostImage map() const {
    HostImage map;
    map.view = image_.view();
    map.sampler = sampler_;
    map.extent = {kWidth, kHeight};
    return map;
  }

 private:
  void upload(VkBuffer texels, std::string* error) {
    const bool ran = device_.run(
        [&](VkCommandBuffer commands) {
          transition(commands, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
          VkBufferImageCopy copy = {};
          copy.imageSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
          copy.imageExtent = {kWidth, kHeight, 1};
          reinterpret_cast<PFN_vkCmdCopyBufferToImage>(device_.function("vkCmdCopyBufferToImage"))(
              commands, texels, image_.image(), VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &copy);
          transition(commands, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL,
                     VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL);
          return true;
        },
        error);
    EXPECT_TRUE(ran) << *error;
  }
  void transition(VkCommandBuffer commands, VkImageLayout before, VkImageLayout after) {
    VkImageMemoryBarrier2 barrier = {};
    barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2;
    barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    barrier.srcAccessMask = barrier.dstAccessMask =
        VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    barrier.oldLayout = before;
    barrier.newLayout = after;
    barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
    barrier.image = image_.image();
    barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
    VkDependencyInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
    info.imageMemoryBarrierCount = 1;
    info.pImageMemoryBarriers = &barrier;
    reinterpret_cast<PFN_vkCmdPipelineBarrier2>(device_.function("vkCmdPipelineBarrier2"))(commands,
                                                                                           &info);
  }

  headless::Device& device_;
  headless::Image image_;
  VkSampler sampler_ = VK_NULL_HANDLE;
};

/// Draws with maps; one view for each. The maps live longer.
class MapDrawing {
 public:
  MapDrawing(headless::Device& device, Context* context, const Tables* tables)
      : device_(device), context_(context), tables_(tables) {}
  ~MapDrawing() {
    for (const auto& entry : views_) destroyView(entry.second);
  }
  MapDrawing(const MapDrawing&) = delete;
  MapDrawing& operator=(const MapDrawing&) = delete;

  Picture draw(const Map& map, const FrameState& sky) {
    ViewDesc desc;
    desc.sky = SkyMethod::Integrate;
    desc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
    desc.groundAlbedo = map.map();
    View*& view = views_[&map];
    if (view == nullptr) {
      EXPECT_EQ(createView(context_, tables_, desc, &view), Status::Ok);
    }
    TargetDesc targetDesc;
    targetDesc.extent = sky.viewport.extent;
    Target target(device_, targetDesc);
    return target.draw([&](VkCommandBuffer commands) {
      return testing::recordSky(view, commands, tables_, sky) == Status::Ok;
    });
  }

 private:
  headless::Device& device_;
  Context* context_;
  const Tables* tables_;
  std::map<const Map*, View*> views_;
};

/// Straight down, the sun in the zenith there; north is up in the picture.
FrameState lookDown(const Parameters& p, double latitude, double longitude, double altitude,
                    double fov, VkExtent2D extent) {
  const EyeCamera camera =
      cameraFromGeodetic(p, latitude, longitude, altitude, 0.0, radians(-90.0), 0.0, fov);
  return makeDraw(camera, unit(vec(camera.position_m)), extent);
}

TEST_F(SkyTest, UniformMapIsUniformAlbedo) {
  const Parameters earth = preset("earth");
  const Map map(device(), [&](double, double) { return vec(earth.groundAlbedo.value); });
  MapDrawing drawing(device(), context(), tables());
  for (const double altitude : {0.0, 2.0, 1e4, 3.6e7}) {
    const FrameState draw = lookDown(earth, 0.4, 0.5, altitude, radians(18.0), {24, 24});
    const Picture uniform = picture(draw);
    const Picture mapped = drawing.draw(map, draw);
    for (size_t i = 0; i < uniform.data.size(); ++i)
      EXPECT_NEAR(mapped.data[i], uniform.data[i], 1e-5f * uniform.data[i]) << altitude;
  }
}

// Red: the quarter from longitude 0 to 90 east; green: the northern hemisphere. Against a white and
// a black map, the pixel below the camera tells what it reads there.
TEST_F(SkyTest, MapIsTheRightWayRound) {
  const Parameters earth = preset("earth");
  const Map white(device(), [](double, double) { return Vec{1.0, 1.0, 1.0}; });
  const Map black(device(), [](double, double) { return Vec{0.0, 0.0, 0.0}; });
  const Map quarters(device(), [](double longitude, double latitude) {
    return Vec{longitude > 0.0 && longitude < radians(90.0) ? 1.0 : 0.0, latitude > 0.0 ? 1.0 : 0.0,
               longitude < radians(-90.0) ? 1.0 : 0.0};
  });
  MapDrawing drawing(device(), context(), tables());
  const auto check = [&](double latitude, double longitude, double row, const Vec& wanted) {
    FrameState draw =
        lookDown(earth, radians(latitude), radians(longitude), 2e6, radians(30.0), {9, 9});
    const auto y = static_cast<uint32_t>(row);
    const Picture w = drawing.draw(white, draw), b = drawing.draw(black, draw),
                  q = drawing.draw(quarters, draw);
    for (size_t c = 0; c < 3; ++c) {
      const float albedo = (q.at(4, y)[c] - b.at(4, y)[c]) / (w.at(4, y)[c] - b.at(4, y)[c]);
      EXPECT_NEAR(albedo, wanted[c], 1e-3) << latitude << " " << longitude << " channel " << c;
    }
  };
  check(45.0, 45.0, 4, {1.0, 1.0, 0.0});
  check(-45.0, 45.0, 4, {1.0, 0.0, 0.0});
  check(45.0, -45.0, 4, {0.0, 1.0, 0.0});
  check(45.0, -135.0, 4, {0.0, 1.0, 1.0});
  check(-45.0, 135.0, 4, {0.0, 0.0, 0.0});
  // From above the equator, north is up.
  check(0.0, 45.0, 0, {1.0, 1.0, 0.0});
  check(0.0, 45.0, 8, {1.0, 0.0, 0.0});
}

// A map that is smooth across 180 degrees is drawn smooth there.
TEST_F(SkyTest, NoLineAtTheSeam) {
  const Parameters earth = preset("earth");
  const Map smooth(device(), [](double longitude, double latitude) {
    const double value =
        0.5 + 0.3 * std::cos(longitude - 0.5) * std::cos(latitude) + 0.1 * std::sin(2.0 * latitude);
    return Vec{value, value, value};
  });
  MapDrawing drawing(device(), context(), tables());
  for (const double latitude : {0.0, 50.0, 75.0}) {
    for (const double altitude : {1e4, 3e5, 3.6e7}) {
      const FrameState draw = lookDown(earth, radians(latitude), radians(180.0), altitude,
                                       altitude > 1e7 ? radians(3.0) : radians(60.0), {64, 32});
      const Picture drawn = drawing.draw(smooth, draw);
      // A line would be a bend; the map's own texels bend it by under 1 %.
      for (uint32_t y = 0; y < drawn.height; ++y) {
        for (uint32_t x = 1; x + 1 < drawn.width; ++x) {
          const float* p = drawn.at(x, y);
          const float bend = drawn.at(x - 1, y)[1] - 2.0f * p[1] + drawn.at(x + 1, y)[1];
          EXPECT_LT(std::abs(bend), 0.02f * p[1])
              << x << " " << y << " " << latitude << " " << altitude;
        }
      }
    }
  }
}

}  // namespace
}  // namespace alpenglow::testing
