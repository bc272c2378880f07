// A host's own SPIR-V in place of ours: ContextDesc::shaders.
#include <alpenglow/shaders/host_flat.h>
#include <alpenglow/shaders/host_flat_buffer.h>
#include <alpenglow/shaders/host_flat_more.h>
#include <alpenglow/shaders/moment_depth.h>
#include <alpenglow/shaders/moment_single.h>
#include <alpenglow/shaders/sky_fragment_lut.h>

#include <random>
#include <set>
#include <span>

#include "engine/spirv_interface.h"
#include "tests/passes/sky/sky_fixture.h"

namespace alpenglow::testing {
namespace {

using Words = std::span<const uint32_t>;

/// Answers for names that start with `prefix`.
struct Replacement {
  std::string prefix;
  Words code;
  std::set<std::string> asked;

  ShaderHook hook() {
    return {this, [](void* user, const char* name, const uint32_t** words, size_t* bytes) {
              auto* self = static_cast<Replacement*>(user);
              self->asked.insert(name);
              if (self->prefix.empty() || !std::string(name).starts_with(self->prefix))
                return false;
              *words = self->code.data();
              *bytes = self->code.size_bytes();
              return true;
            }};
  }
};

class ShaderHookTest : public SkyTest {
 protected:
  void SetUp() override {
    SkyTest::SetUp();
    ContextDesc desc = contextDesc();
    desc.shaders = replacement_.hook();
    ASSERT_EQ(createContext(desc, &hooked_), Status::Ok) << lastDiagnostic();
  }
  void TearDown() override {
    for (View* view : views_) destroyView(view);
    for (Tables* tables : tables_) destroyTables(tables);
    destroyContext(hooked_);
    SkyTest::TearDown();
  }

  Tables* bake() {
    TableDesc desc;
    desc.quality = Quality::Draft;
    Tables* tables = nullptr;
    EXPECT_EQ(createTables(hooked_, preset("earth"), desc, &tables), Status::Ok);
    if (tables != nullptr) tables_.push_back(tables);
    return tables;
  }
  Status makeView(const Tables* tables, View** out) {
    ViewDesc desc = viewDesc();
    desc.sky = SkyMethod::Integrate;
    const Status status = createView(hooked_, tables, desc, out);
    if (status == Status::Ok) views_.push_back(*out);
    return status;
  }
  Picture draw(View* view, const Tables* tables) {
    const TargetDesc target;
    EyeCamera camera = cameraFromGeodetic(preset("earth"), 0.0, 0.0, 100.0, 0.0, 0.3, 0.0, 1.0);
    const FrameState sky = makeDraw(camera, {0.7071, 0.0, 0.7071}, target.extent);
    return Target(device(), target).draw([&](VkCommandBuffer commands) {
      return testing::recordSky(view, commands, tables, sky) == Status::Ok;
    });
  }

  Replacement replacement_;
  Context* hooked_ = nullptr;
  std::vector<View*> views_;
  std::vector<Tables*> tables_;
};

TEST_F(ShaderHookTest, HookAppliesToTheNextViewOnly) {
  Tables* tables = bake();
  bakeAll(device(), tables);
  View *own = nullptr, *flat = nullptr, *again = nullptr;
  ASSERT_EQ(makeView(tables, &own), Status::Ok);
  EXPECT_TRUE(replacement_.asked.contains("kSkyFragment"));
  replacement_.prefix = "kSkyFragment";
  replacement_.code = shaders::kHostFlat;
  ASSERT_EQ(makeView(tables, &flat), Status::Ok) << lastDiagnostic();
  replacement_.prefix = "";
  ASSERT_EQ(makeView(tables, &again), Status::Ok);

  const Picture sky = draw(own, tables), painted = draw(flat, tables), same = draw(again, tables);
  EXPECT_EQ(painted.at(5, 5)[0], 3.0f);
  EXPECT_EQ(painted.at(5, 5)[2], 1.0f);
  EXPECT_GT(sky.at(5, 5)[2], sky.at(5, 5)[0]);  // Blue.
  EXPECT_EQ(sky.data, same.data);
}

TEST_F(ShaderHookTest, CodeThatDoesNotFitIsRefusedWithASentence) {
  const Tables* const tables = bake();
  const auto refused = [&](Words code, const char* parts) {
    replacement_.prefix = "kSkyFragment";
    replacement_.code = code;
    View* view = nullptr;
    EXPECT_EQ(makeView(tables, &view), Status::InvalidArgument);
    EXPECT_EQ(view, nullptr);
    EXPECT_TRUE(hasAll(lastDiagnostic(), parts)) << lastDiagnostic();
  };
  refused(shaders::kHostFlatBuffer, "kSkyFragment|a storage buffer at set 0, binding 7");
  refused(shaders::kHostFlatMore, "kSkyFragment|more push constants");
  refused(shaders::kMomentDepth, "kSkyFragment|another stage");
  refused(Words(shaders::kHostFlat).first(4), "kSkyFragment|0x07230203");
  refused(Words(shaders::kHostFlat).first(40), "kSkyFragment|cut off");
  refused({}, "kSkyFragment|0x07230203");
}

TEST_F(ShaderHookTest, BakeCodeIsRequestedForEachTables) {
  bakeAll(device(), bake());
  EXPECT_TRUE(replacement_.asked.contains("kMomentDepth"));
  // No pass fits in place of another.
  replacement_.prefix = "kMomentDepth";
  replacement_.code = shaders::kMomentSingle;
  TableDesc desc;
  desc.quality = Quality::Draft;
  Tables* tables = nullptr;
  EXPECT_EQ(createTables(hooked_, preset("earth"), desc, &tables), Status::InvalidArgument);
  EXPECT_EQ(tables, nullptr);
  EXPECT_TRUE(hasAll(lastDiagnostic(), "kMomentDepth|ContextDesc::shaders")) << lastDiagnostic();
  replacement_.prefix = "";
  bakeAll(device(), bake());
  EXPECT_TRUE(ready(tables_.back()));
}

TEST(SpirvInterface, OfOurOwnShadersNamesWhatTheyDeclare) {
  engine::SpirvInterface found;
  const auto sky = Words(shaders::kSkyFragmentLut);
  ASSERT_EQ(engine::readInterface(sky.data(), sky.size_bytes(), &found), nullptr);
  EXPECT_EQ(found.model, 4u);  // Fragment.
  EXPECT_TRUE(found.pushConstants);
  bool lut = false;
  for (const engine::SpirvResource& resource : found.resources) {
    lut |= resource.set == 1 && resource.binding == 1 &&
           std::string(engine::kindName(resource.kind)) == "a sampled image";
  }
  EXPECT_TRUE(lut);
  const auto depth = Words(shaders::kMomentDepth);
  ASSERT_EQ(engine::readInterface(depth.data(), depth.size_bytes(), &found), nullptr);
  EXPECT_EQ(found.localSize[0] * found.localSize[1] * found.localSize[2], 64u);
}

TEST(SpirvInterface, SizesOfBlocksAndArraysAreKnown) {
  engine::SpirvInterface found;
  const auto more = Words(shaders::kHostFlatMore);
  ASSERT_EQ(engine::readInterface(more.data(), more.size_bytes(), &found), nullptr);
  // Parts of 64 + 12 + 4 bytes, two of them, and a float.
  EXPECT_EQ(found.pushConstantEnd, 164u);
  ASSERT_EQ(found.resources.size(), 1u);
  EXPECT_EQ(found.resources[0].count, 2u);
  const auto sky = Words(shaders::kSkyFragmentLut);
  ASSERT_EQ(engine::readInterface(sky.data(), sky.size_bytes(), &found), nullptr);
  EXPECT_EQ(found.pushConstantEnd % 16, 0u);  // Its last member is a vec4.
  EXPECT_GE(found.pushConstantEnd, 96u);
}

TEST(SpirvInterface, MalformedFilesAreNotReadOutOfBounds) {
  const auto sky = Words(shaders::kSkyFragmentLut);
  engine::SpirvInterface found;
  for (size_t words = 0; words < sky.size(); ++words) {
    // A copy of exactly this size, so that sanitizers see a read behind it.
    const std::vector<uint32_t> cut(sky.begin(), sky.begin() + static_cast<std::ptrdiff_t>(words));
    engine::readInterface(cut.data(), cut.size() * sizeof(uint32_t), &found);
  }
  std::mt19937 random(1);
  for (int i = 0; i < 20000; ++i) {
    std::vector<uint32_t> spoilt(sky.begin(), sky.end());
    for (int k = 0; k < 3; ++k) {
      spoilt[random() % spoilt.size()] = static_cast<uint32_t>(random() >> random() % 32);
    }
    engine::readInterface(spoilt.data(), spoilt.size() * sizeof(uint32_t), &found);
  }
}

}  // namespace
}  // namespace alpenglow::testing
