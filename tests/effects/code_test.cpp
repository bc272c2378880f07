// Once specialization constants are set, the compiled code of disabled effects is gone: no branch,
// no selection and no instruction of it is left.
#include <alpenglow/shaders/aerial_perspective_fragment.h>
#include <alpenglow/shaders/aerial_perspective_fragment_lut.h>
#include <alpenglow/shaders/aerial_perspective_lut_float.h>
#include <alpenglow/shaders/effects_host.h>
#include <alpenglow/shaders/effects_host_molecules.h>
#include <alpenglow/shaders/effects_host_neither.h>
#include <alpenglow/shaders/effects_host_single.h>
#include <alpenglow/shaders/light_volume_mesh_fragment.h>
#include <alpenglow/shaders/moment_field.h>
#include <alpenglow/shaders/moment_light.h>
#include <alpenglow/shaders/moment_light_molecules.h>
#include <alpenglow/shaders/moment_modes.h>
#include <alpenglow/shaders/moment_single.h>
#include <alpenglow/shaders/moment_single_molecules.h>
#include <alpenglow/shaders/probe.h>
#include <alpenglow/shaders/sky_fragment.h>
#include <alpenglow/shaders/sky_fragment_lut.h>
#include <alpenglow/shaders/sky_view_lut_float.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <set>
#include <spirv-tools/optimizer.hpp>
#include <unordered_map>
#include <vector>

#include "atmosphere/passes/shader_choice.h"
#include "atmosphere/tables/effect_constants.h"

namespace alpenglow::testing {
namespace {

using Words = std::vector<uint32_t>;

#define ALPENGLOW_TEXT(name) \
  engine::Shader { shaders::name, sizeof shaders::name, #name }

// Of the SPIR-V specification.
constexpr uint32_t kHeaderWords = 5;
constexpr uint32_t kSpecId = 1, kBinding = 33, kDescriptorSet = 34;
/// Of shaders/glsl/tables/tile.glsl.
constexpr uint32_t kFirstOrder = 0;
enum Op : uint32_t {
  kOpConstantTrue = 41,
  kOpConstantFalse = 42,
  kOpSpecConstantTrue = 48,
  kOpSpecConstantComposite = 51,
  kOpFunction = 54,
  kOpDecorate = 71,
  kOpLogicalEqual = 164,
  kOpLogicalNot = 168,
  kOpSelect = 169,
  kOpBranchConditional = 250,
  kOpSwitch = 251,
};

/// Calls `visit` with opcode, words and their count, for each instruction.
template <class Visit>
void eachInstruction(Words& words, const Visit& visit) {
  for (size_t at = kHeaderWords; at < words.size(); at += words[at] >> 16)
    visit(words[at] & 0xffff, &words[at], words[at] >> 16);
}

Words wordsOf(const engine::Shader& shader) {
  return {shader.code, shader.code + shader.bytes / sizeof(uint32_t)};
}

using Constants = std::unordered_map<uint32_t, std::vector<uint32_t>>;

/// `first`: of a bake's first order, where one shader is used for it and the others.
Constants constantsOf(EffectFlags disabledEffects, bool first = false) {
  Constants constants;
  if (first) constants[kFirstOrder] = {1u};
  for (const engine::SpecConstant& constant : tables::effectConstants(disabledEffects))
    constants[constant.id] = {constant.value};
  return constants;
}

/// Specialized like a driver does: one function, constants in place. `clean`: unreachable and
/// unused code is removed.
Words specialized(const Words& text, const Constants& constants, bool clean = true) {
  spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
  std::string said;
  optimizer.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&,
                                   const char* message) { said = message; });
  optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(constants))
      .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
      .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass());
  if (clean) {
    optimizer.RegisterPass(spvtools::CreateMergeReturnPass())
        .RegisterPass(spvtools::CreateInlineExhaustivePass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
        .RegisterPass(spvtools::CreateLocalMultiStoreElimPass())
        .RegisterPass(spvtools::CreateCCPPass())
        .RegisterPass(spvtools::CreateSimplificationPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateBlockMergePass())
        .RegisterPass(spvtools::CreateSimplificationPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
  }
  Words out;
  spvtools::OptimizerOptions options;
  options.set_run_validator(false);
  EXPECT_TRUE(optimizer.Run(text.data(), text.size(), &out, options)) << said;
  return out;
}

size_t instructions(Words text) {
  size_t count = 0;
  bool inside = false;
  eachInstruction(text, [&](uint32_t op, const uint32_t*, uint32_t) {
    inside = inside || op == kOpFunction;
    count += inside ? 1 : 0;
  });
  return count;
}

/// Branches, selections and logic whose condition is known, and constants still to be set.
size_t leftOpen(Words text) {
  std::set<uint32_t> known;
  size_t count = 0;
  eachInstruction(text, [&](uint32_t op, const uint32_t* words, uint32_t) {
    if (op == kOpConstantTrue || op == kOpConstantFalse) known.insert(words[2]);
    if (op >= kOpSpecConstantTrue && op <= kOpSpecConstantComposite) ++count;
    if (op == kOpBranchConditional || op == kOpSwitch) count += known.count(words[1]);
    if (op == kOpSelect) count += known.count(words[3]);
    if (op >= kOpLogicalEqual && op < kOpLogicalNot)
      count += std::max(known.count(words[3]), known.count(words[4]));
    if (op == kOpLogicalNot) count += known.count(words[3]);
  });
  return count;
}

/// Whether the code with the effect off is less than that with all of them.
bool isLess(const Words& text, EffectFlags disabledEffects) {
  return instructions(specialized(text, constantsOf(disabledEffects))) <
         instructions(specialized(text, constantsOf(0)));
}

constexpr EffectFlags kRayleigh = effectBit(Effect::Rayleigh), kMie = effectBit(Effect::Mie),
                      kAbsorption = effectBit(Effect::Absorption),
                      kReflection = effectBit(Effect::GroundReflection),
                      kIrradiance = effectBit(Effect::GroundIrradiance),
                      kSpace = effectBit(Effect::SpaceViews);

struct Text {
  engine::Shader shader;
  EffectFlags has;  ///< Effects whose text it has.
  bool first = false;
};

const Text kTexts[] = {
    {ALPENGLOW_TEXT(kMomentSingle), kRayleigh | kMie | kAbsorption | kReflection},
    {ALPENGLOW_TEXT(kMomentLight), kRayleigh | kMie | kAbsorption | kReflection},
    {ALPENGLOW_TEXT(kMomentModes), kRayleigh | kMie | kReflection, true},
    {ALPENGLOW_TEXT(kMomentField), 0},
    {ALPENGLOW_TEXT(kSkyViewLutFloat), kRayleigh | kMie | kAbsorption | kSpace},
    {ALPENGLOW_TEXT(kAerialPerspectiveLutFloat), kRayleigh | kMie | kAbsorption | kSpace},
    {ALPENGLOW_TEXT(kSkyFragment), kRayleigh | kMie | kAbsorption | kIrradiance | kSpace},
    {ALPENGLOW_TEXT(kSkyFragmentLut), kRayleigh | kMie | kAbsorption | kIrradiance | kSpace},
    {ALPENGLOW_TEXT(kAerialPerspectiveFragment), kRayleigh | kMie | kAbsorption | kSpace},
    {ALPENGLOW_TEXT(kAerialPerspectiveFragmentLut), kSpace},
    {ALPENGLOW_TEXT(kLightVolumeMeshFragment), kRayleigh | kMie | kAbsorption | kSpace},
    {ALPENGLOW_TEXT(kProbe), kRayleigh | kMie | kAbsorption | kIrradiance},
};

TEST(EffectCode, DisabledEffectsLeaveNoInstruction) {
  for (const Text& each : kTexts) {
    const Words text = wordsOf(each.shader);
    const Words all = specialized(text, constantsOf(0, each.first));
    const size_t whole = instructions(all);
    EXPECT_EQ(leftOpen(all), 0u) << each.shader.name;
    std::printf("%-22s %6zu", each.shader.name, whole);
    for (const EffectFlags effect :
         {kRayleigh, kMie, kAbsorption, kReflection, kIrradiance, kSpace}) {
      const Words left = specialized(text, constantsOf(effect, each.first));
      std::printf(" %6zu", instructions(left));
      EXPECT_EQ(leftOpen(left), 0u) << each.shader.name << " without " << effect;
      if ((each.has & effect) != 0) {
        EXPECT_LT(instructions(left), whole) << each.shader.name << " without " << effect;
      } else {
        EXPECT_EQ(instructions(left), whole) << each.shader.name << " without " << effect;
      }
    }
    std::printf("\n");
  }
}

// E of the sky has two readers: the light that the ground sends back, and surfaces.
TEST(EffectCode, SharedCodeGoesWithItsLastEffect) {
  const Words text = wordsOf(ALPENGLOW_TEXT(kMomentField));
  EXPECT_FALSE(isLess(text, kReflection));
  EXPECT_FALSE(isLess(text, kIrradiance));
  EXPECT_TRUE(isLess(text, kReflection | kIrradiance));
}

// Separate shaders for tables that lack a table.
TEST(EffectCode, AbsentTablesAreNotDeclared) {
  const passes::SkyVariant plain;
  constexpr EffectFlags kMultiple = effectBit(Effect::MultipleScattering);
  const auto size = [](const engine::Shader& shader, EffectFlags disabledEffects) {
    return instructions(specialized(wordsOf(shader), constantsOf(disabledEffects)));
  };
  const auto compare = [&](const auto& shaderOf) {
    const size_t whole = size(shaderOf(EffectFlags{0}), 0);
    const size_t molecules = size(shaderOf(kMie), kMie);
    const size_t single = size(shaderOf(kMultiple), kMultiple);
    EXPECT_LT(molecules, whole) << shaderOf(EffectFlags{0}).name;
    EXPECT_LT(single, whole) << shaderOf(EffectFlags{0}).name;
  };
  compare([&](EffectFlags disabledEffects) {
    return passes::skyShader(Solver::Moments, disabledEffects, plain);
  });
  compare([&](EffectFlags disabledEffects) {
    return passes::aerialPerspectiveShader(Solver::Moments, disabledEffects, false, false);
  });
  compare([&](EffectFlags disabledEffects) {
    return passes::skyViewLutShader(Solver::Moments, disabledEffects, TableFormat::Float);
  });
  compare([&](EffectFlags disabledEffects) {
    return passes::aerialPerspectiveLutShader(disabledEffects, TableFormat::Float);
  });
  compare([&](EffectFlags disabledEffects) {
    return passes::probeShader(Solver::Moments, disabledEffects);
  });
  // The light-volume mesh sums single scattering alone.
  EXPECT_LT(size(passes::lightVolumeMeshShader(kMie, false), kMie),
            size(passes::lightVolumeMeshShader(0, false), 0));
  EXPECT_LT(size(ALPENGLOW_TEXT(kMomentLightMolecules), kMie),
            size(ALPENGLOW_TEXT(kMomentLight), 0));
  EXPECT_LT(size(ALPENGLOW_TEXT(kMomentSingleMolecules), kMie),
            size(ALPENGLOW_TEXT(kMomentSingle), 0));
}

/// Bindings of a set that a shader declares.
std::set<uint32_t> bindingsOf(Words text, uint32_t set) {
  std::set<uint32_t> members, bindings;
  const auto visit = [&](uint32_t decoration, const auto& found) {
    eachInstruction(text, [&](uint32_t op, const uint32_t* words, uint32_t count) {
      if (op == kOpDecorate && count == 4 && words[2] == decoration) found(words[1], words[3]);
    });
  };
  visit(kDescriptorSet, [&](uint32_t id, uint32_t value) {
    if (value == set) members.insert(id);
  });
  visit(kBinding, [&](uint32_t id, uint32_t value) {
    if (members.count(id) != 0) bindings.insert(value);
  });
  return bindings;
}

// Uniforms, optical depths, moments, sources.
TEST(EffectCode, HostShadersDeclareOnlyPresentTables) {
  using Bindings = std::set<uint32_t>;
  constexpr uint32_t kSet = 2;
  EXPECT_EQ(bindingsOf(wordsOf(ALPENGLOW_TEXT(kHostWhole)), kSet), (Bindings{0, 1, 2, 3}));
  EXPECT_EQ(bindingsOf(wordsOf(ALPENGLOW_TEXT(kHostMolecules)), kSet), (Bindings{0, 1, 2}));
  EXPECT_EQ(bindingsOf(wordsOf(ALPENGLOW_TEXT(kHostSingle)), kSet), (Bindings{0, 1}));
  EXPECT_EQ(bindingsOf(wordsOf(ALPENGLOW_TEXT(kHostNeither)), kSet), (Bindings{0, 1}));
}

// Both checks detect what they look for.
TEST(EffectCode, UnusedConstantsAreDetected) {
  Words text = wordsOf(ALPENGLOW_TEXT(kMomentSingle));
  EXPECT_TRUE(isLess(text, kRayleigh));
  EXPECT_GT(leftOpen(specialized(text, constantsOf(kRayleigh), false)), 0u);
  // Rayleigh's constant gets a number that nobody sets.
  const uint32_t number = tables::effectConstants(0)[0].id;
  uint32_t found = 0;
  eachInstruction(text, [&](uint32_t op, uint32_t* words, uint32_t count) {
    if (op != kOpDecorate || count != 4 || words[2] != kSpecId || words[3] != number) return;
    words[3] = 99;
    ++found;
  });
  ASSERT_EQ(found, 1u);
  EXPECT_FALSE(isLess(text, kRayleigh));
  EXPECT_TRUE(isLess(text, kAbsorption));
}

}  // namespace
}  // namespace alpenglow::testing
