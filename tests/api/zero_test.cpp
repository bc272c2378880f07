// Every struct of the core is plain data whose default is zero: `{}`, memset and a language without
// constructors all begin with the same description.
#include <alpenglow/alpenglow.h>
#include <alpenglow/mesh/adjacency.h>
#include <alpenglow/plan.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <new>
#include <type_traits>

namespace alpenglow {
namespace {

template <typename T>
class Zero : public ::testing::Test {};

/// tests/health/count_api.py prints their names.
using Structs =
    ::testing::Types<AbsorptionParameters, AdjacencyReport, BakeProgress, Box, Camera, CasterPass,
                     Casters, ContextDesc, Diagnostic, DiagnosticSink, FrameDesc, FrameWork,
                     HostImage, ImageInfo, Light, LightDesc, LightShaftDesc, MemoryHooks,
                     MemoryRange, MeshView, MieParameters, Parameters, Plan, PlanChoice, PlanCost,
                     PlanRequest, Preset, ProbeAnswer, ProbeQuery, RayleighParameters, Requirements,
                     ResourceReport, ShaderHook, Spectrum, TableDesc, TableSizes, TablesInfo,
                     ViewDesc, ViewInfo, World>;
TYPED_TEST_SUITE(Zero, Structs);

/// Over bytes that are zero, since what pads a struct is nobody's.
template <typename T>
void makeIn(unsigned char* bytes) {
  new (bytes) T{};
}

TYPED_TEST(Zero, IsTheDefaultOfPlainData) {
  static_assert(std::is_standard_layout_v<TypeParam>);
  static_assert(std::is_trivially_copyable_v<TypeParam>);
  static_assert(std::is_trivially_destructible_v<TypeParam>);
  alignas(TypeParam) static unsigned char bytes[sizeof(TypeParam)];
  makeIn<TypeParam>(bytes);
  const auto* const wrong = std::find_if(std::begin(bytes), std::end(bytes),
                                         [](unsigned char byte) { return byte != 0; });
  EXPECT_EQ(wrong, std::end(bytes)) << "Byte " << wrong - bytes << " of " << sizeof bytes;
}

}  // namespace
}  // namespace alpenglow
