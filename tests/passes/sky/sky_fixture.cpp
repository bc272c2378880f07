#include "tests/passes/sky/sky_fixture.h"

#include <cmath>
#include <tuple>

namespace alpenglow::testing {
namespace {

/// What the tests of a program share.
struct Shared {
  std::unique_ptr<VulkanWrap> vulkan;
  Context* context = nullptr;
  std::map<std::tuple<std::string, Solver, MieStorage>, Tables*> tables;
  std::map<std::pair<Projection, Solver>, View*> views, lutViews;
  std::vector<View*> otherViews;
  std::string message;
};

Shared& shared() {
  static Shared instance;
  return instance;
}

}  // namespace

double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec cross(const Vec& a, const Vec& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
double length(const Vec& a) { return std::sqrt(dot(a, a)); }
Vec unit(const Vec& a) {
  const double l = length(a);
  return {a[0] / l, a[1] / l, a[2] / l};
}
Vec vec(const double v[3]) { return {v[0], v[1], v[2]}; }

TableDesc smallTables(MieStorage mie) {
  TableDesc desc;
  desc.solver = Solver::Standard;
  desc.orders = 2;
  desc.mie = mie;
  desc.sizes = {.transmittanceMu = 64,
                .transmittanceR = 16,
                .irradianceMuS = 16,
                .irradianceR = 4,
                .scatteringR = 8,
                .scatteringMu = 32,
                .scatteringMuS = 16,
                .scatteringNu = 4};
  return desc;
}

Parameters preset(const char* name) {
  Parameters parameters;
  EXPECT_EQ(findPreset(name, &parameters, {}), Status::Ok) << name;
  return parameters;
}

void bakeAll(headless::Device& device, Tables* tables) {
  BakeProgress progress;
  std::string error = "A LUT was refused.";
  while (!progress.done) {
    const bool ran = device.run(
        [&](VkCommandBuffer commands) {
          return recordBake(tables, commands, 0, &progress) == Status::Ok;
        },
        &error);
    ASSERT_TRUE(ran) << error;
  }
}

std::vector<ProbeAnswer> probe(headless::Device& device, const Tables* tables,
                               const std::vector<ProbeQuery>& queries) {
  const auto count = static_cast<uint32_t>(queries.size());
  std::string error = "The probe was refused.";
  const headless::HostBuffer buffer = device.createHostBuffer(
      count * kProbeAnswerBytes, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &error);
  const bool ran = device.run(
      [&](VkCommandBuffer commands) {
        return recordProbe(tables, commands, queries.data(), count, buffer.buffer()) == Status::Ok;
      },
      &error);
  EXPECT_TRUE(ran) << error;
  if (!ran) return {};
  std::vector<ProbeAnswer> answers(count);
  EXPECT_EQ(answerQueries(tables, queries.data(), count, buffer.data(), answers.data()),
            Status::Ok);
  return answers;
}

FrameState makeDraw(const EyeCamera& camera, const Vec& sun, VkExtent2D extent) {
  FrameState draw;
  draw.camera = camera;
  for (size_t i = 0; i < 3; ++i) draw.sun.direction[i] = sun[i];
  draw.sun.irradiance = {{1.0, 1.0, 1.0}};
  draw.viewport.extent = extent;
  return draw;
}

std::optional<Vec> pixelDirection(const FrameState& draw, Projection projection, double x,
                                  double y) {
  const double width = draw.viewport.extent.width, height = draw.viewport.extent.height;
  const Vec forward = vec(draw.camera.forward), up = vec(draw.camera.up);
  const Vec right = cross(forward, up);
  // From the centre of the viewport, in pixels, to the right and up.
  const double dx = x + 0.5 - 0.5 * width, dy = 0.5 * height - (y + 0.5);
  double ahead = 1.0, scale = 2.0 * std::tan(0.5 * draw.camera.fov) / height;
  if (projection == Projection::Fisheye) {
    const double radius = std::hypot(dx, dy), circle = 0.5 * std::min(width, height);
    if (radius > circle) return std::nullopt;
    const double theta = radius / circle * 0.5 * draw.camera.fov;
    ahead = std::cos(theta);
    scale = radius > 0.0 ? std::sin(theta) / radius : 0.0;
  }
  Vec direction;
  for (size_t i = 0; i < 3; ++i)
    direction[i] = ahead * forward[i] + scale * (dx * right[i] + dy * up[i]);
  return unit(direction);
}

ProbeQuery rayQuery(const Parameters& parameters, const EyeCamera& camera, const Vec& direction,
                    const Vec& sun) {
  const Vec position = vec(camera.position_m);
  const Vec up = unit(position);
  const auto zenith = [&up](const Vec& v) { return std::atan2(length(cross(up, v)), dot(up, v)); };
  const Vec acrossView = cross(up, direction), acrossSun = cross(up, sun);
  ProbeQuery query;
  query.altitude_m = std::max(length(position) - parameters.bottomRadius_m, 0.0);
  query.zenith = zenith(direction);
  query.sunZenith = zenith(sun);
  query.azimuth = std::atan2(length(cross(acrossView, acrossSun)), dot(acrossView, acrossSun));
  return query;
}

double horizonDip(const Parameters& parameters, double altitude) {
  return std::acos(parameters.bottomRadius_m / (parameters.bottomRadius_m + altitude));
}

void SkyTest::SetUp() {
  DeviceTest::SetUp();
  message().clear();
}

void SkyTest::TearDownTestSuite() {
  Shared& s = shared();
  for (const auto& entry : s.views) destroyView(entry.second);
  for (const auto& entry : s.lutViews) destroyView(entry.second);
  for (View* one : s.otherViews) destroyView(one);
  for (const auto& entry : s.tables) destroyTables(entry.second);
  destroyContext(s.context);
  s = Shared{};
}

std::string& SkyTest::message() { return shared().message; }

VulkanWrap& SkyTest::vulkan() {
  context();
  return *shared().vulkan;
}

Context* SkyTest::context() {
  Shared& s = shared();
  if (s.context != nullptr) return s.context;
  s.vulkan = std::make_unique<VulkanWrap>(device().getInstanceProcAddr());
  ContextDesc desc = device().contextDesc();
  desc.getInstanceProcAddr = s.vulkan->getInstanceProcAddr();
  desc.capabilities = kCapabilityBake | kCapabilitySky | kCapabilityAerialPerspective |
                      kCapabilityLightShafts | kCapabilityShadowVolumes;
  desc.diagnostics.report = [](void*, const Diagnostic& diagnostic) {
    shared().message = diagnostic.message;
  };
  EXPECT_EQ(createContext(desc, &s.context), Status::Ok) << message();
  return s.context;
}

Tables* SkyTest::tables(const char* presetName, MieStorage mie) {
  return tables(presetName, preset(presetName), mie);
}

Tables* SkyTest::tables(const char* name, const Parameters& parameters, MieStorage mie) {
  Tables*& slot = shared().tables[{name, solver_, mie}];
  if (slot == nullptr) {
    TableDesc draft;
    draft.quality = Quality::Draft;
    TableDesc desc = solver_ == Solver::Moments ? draft : smallTables(mie);
    if (solver_ > Solver::Standard) {  // The simpler models have no sizes.
      desc = {};
      desc.solver = solver_;
    }
    EXPECT_EQ(createTables(context(), parameters, desc, &slot), Status::Ok) << message();
    bakeAll(device(), slot);
  }
  return slot;
}

ViewDesc SkyTest::viewDesc() const {
  ViewDesc desc;
  desc.sky = SkyMethod::Integrate;
  desc.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  return desc;
}

View* SkyTest::view(Projection projection) {
  View*& slot = shared().views[{projection, solver_}];
  if (slot == nullptr) {
    ViewDesc desc = viewDesc();
    desc.projection = projection;
    EXPECT_EQ(createView(context(), tables(), desc, &slot), Status::Ok) << message();
  }
  return slot;
}

View* SkyTest::makeView(const ViewDesc& desc, Tables* with) {
  ViewDesc full = desc;
  if (full.colorFormat == VK_FORMAT_UNDEFINED) full.colorFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
  View* made = nullptr;
  EXPECT_EQ(createView(context(), with != nullptr ? with : tables(), full, &made), Status::Ok)
      << message();
  if (made != nullptr) shared().otherViews.push_back(made);
  return made;
}

View* SkyTest::lutView(Projection projection) {
  View*& slot = shared().lutViews[{projection, solver_}];
  if (slot == nullptr) {
    ViewDesc desc = viewDesc();
    desc.projection = projection;
    desc.sky = SkyMethod::Lut;
    // Only the shape counts: that of the default level, which these drafts don't have.
    Tables* shape = nullptr;
    if (solver_ == Solver::Moments) {
      EXPECT_EQ(createTables(context(), preset("earth"), {}, &shape), Status::Ok) << message();
    }
    EXPECT_EQ(createView(context(), shape != nullptr ? shape : tables(), desc, &slot), Status::Ok)
        << message();
    destroyTables(shape);
  }
  return slot;
}

void SkyTest::recordViewLuts(View* fromLut, const Tables* with, const FrameState& draw) {
  run([&](VkCommandBuffer commands) {
    return testing::recordLuts(fromLut, commands, with, draw) == Status::Ok;
  });
}

void SkyTest::expectNeedsSlice(View* fromLut, const Tables* with, const FrameState& draw) {
  run([&](VkCommandBuffer commands) {
    message().clear();
    EXPECT_EQ(testing::recordSky(fromLut, commands, with, draw), Status::InvalidArgument);
    EXPECT_TRUE(hasAll(message(), "recordSky|sky-view LUT|recordLuts")) << message();
    return true;
  });
}

Picture SkyTest::picture(const FrameState& draw, Projection projection, Tables* with) {
  return picture(view(projection), with != nullptr ? with : tables(), draw);
}

Picture SkyTest::picture(View* with, Tables* baked, const FrameState& draw) {
  TargetDesc target;
  target.extent = draw.viewport.extent;
  return picture(with, baked, draw, target);
}

Picture SkyTest::picture(View* with, Tables* baked, const FrameState& draw,
                         const TargetDesc& targetDesc) {
  Target target(device(), targetDesc);
  return target.draw([&](VkCommandBuffer commands) {
    const Status status = testing::recordSky(with, commands, baked, draw);
    EXPECT_EQ(status, Status::Ok) << message();
    return status == Status::Ok;
  });
}

std::vector<ProbeAnswer> SkyTest::probeAll(const std::vector<ProbeQuery>& queries, Tables* with) {
  return probe(device(), with != nullptr ? with : tables(), queries);
}

bool hasAll(const std::string& text, const std::string& parts) {
  size_t begin = 0;
  while (begin <= parts.size()) {
    const size_t end = std::min(parts.find('|', begin), parts.size());
    if (text.find(parts.substr(begin, end - begin)) == std::string::npos) return false;
    begin = end + 1;
  }
  return !text.empty() && text.back() == '.' && text.find('\n') == std::string::npos;
}

std::string badValue(const Picture& picture) {
  for (uint32_t y = 0; y < picture.height; ++y) {
    for (uint32_t x = 0; x < picture.width; ++x) {
      for (int c = 0; c < 3; ++c) {
        const float value = picture.at(x, y)[c];
        if (std::isfinite(value) && value >= 0.0f) continue;
        return "channel " + std::to_string(c) + " of pixel (" + std::to_string(x) + ", " +
               std::to_string(y) + ") is " + std::to_string(value);
      }
    }
  }
  return "";
}

}  // namespace alpenglow::testing
