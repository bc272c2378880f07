// The second way to use the library: a host's own compute shader samples the tables through
// alpenglow/atmosphere.glsl, with the set bound where the host wants it, and gets what probes
// answer.
#include <alpenglow/shaders/host_compute.h>
#include <alpenglow/shaders/host_compute_standard.h>

#include <cmath>
#include <cstdio>
#include <cstring>

#include "tests/passes/sky/sky_fixture.h"
#include "tests/passes/sky/steps.h"

namespace alpenglow::testing {
namespace {

struct Question {
  float upAltitude[4], viewDistance[4], sun[4];
};
struct Answer {
  float whole[4], toPoint[4], transmittance[4], toSpace[4], direct[4], sky[4];
};

/// The host's side: layouts, pool, set and pipeline of host.comp.
class HostCompute {
 public:
  HostCompute(headless::Device& device, VkDescriptorSetLayout tables, Solver solver)
      : device_(device) {
    const VkDescriptorSetLayoutBinding bindings[] = {
        {0, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr},
        {1, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr}};
    VkDescriptorSetLayoutCreateInfo set = {};
    set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_LAYOUT_CREATE_INFO;
    const auto createSet = call<PFN_vkCreateDescriptorSetLayout>("vkCreateDescriptorSetLayout");
    EXPECT_EQ(createSet(device.device(), &set, nullptr, &empty_), VK_SUCCESS);
    set.bindingCount = 2;
    set.pBindings = bindings;
    EXPECT_EQ(createSet(device.device(), &set, nullptr, &own_), VK_SUCCESS);
    const VkDescriptorSetLayout sets[] = {own_, empty_, tables};
    VkPipelineLayoutCreateInfo layout = {};
    layout.sType = VK_STRUCTURE_TYPE_PIPELINE_LAYOUT_CREATE_INFO;
    layout.setLayoutCount = 3;
    layout.pSetLayouts = sets;
    EXPECT_EQ(call<PFN_vkCreatePipelineLayout>("vkCreatePipelineLayout")(device.device(), &layout,
                                                                         nullptr, &layout_),
              VK_SUCCESS);
    makePipeline(solver);
    makeSet();
  }
  ~HostCompute() {
    call<PFN_vkDestroyDescriptorPool>("vkDestroyDescriptorPool")(device_.device(), pool_, nullptr);
    call<PFN_vkDestroyPipeline>("vkDestroyPipeline")(device_.device(), pipeline_, nullptr);
    call<PFN_vkDestroyPipelineLayout>("vkDestroyPipelineLayout")(device_.device(), layout_,
                                                                 nullptr);
    for (VkDescriptorSetLayout one : {own_, empty_})
      call<PFN_vkDestroyDescriptorSetLayout>("vkDestroyDescriptorSetLayout")(device_.device(), one,
                                                                             nullptr);
  }
  HostCompute(const HostCompute&) = delete;
  HostCompute& operator=(const HostCompute&) = delete;

  std::vector<Answer> ask(const std::vector<Question>& questions, VkDescriptorSet tables) {
    std::string error;
    const headless::HostBuffer in = device_.createHostBuffer(
        questions.size() * sizeof(Question), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &error);
    const headless::HostBuffer out = device_.createHostBuffer(
        questions.size() * sizeof(Answer), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT, &error);
    std::memcpy(in.data(), questions.data(), in.size());
    write(0, in.buffer());
    write(1, out.buffer());
    const bool ran = device_.run(
        [&](VkCommandBuffer commands) {
          const auto bind = call<PFN_vkCmdBindDescriptorSets>("vkCmdBindDescriptorSets");
          call<PFN_vkCmdBindPipeline>("vkCmdBindPipeline")(commands, VK_PIPELINE_BIND_POINT_COMPUTE,
                                                           pipeline_);
          bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 0, 1, &set_, 0, nullptr);
          bind(commands, VK_PIPELINE_BIND_POINT_COMPUTE, layout_, 2, 1, &tables, 0, nullptr);
          call<PFN_vkCmdDispatch>("vkCmdDispatch")(
              commands, (static_cast<uint32_t>(questions.size()) + 7) / 8, 1, 1);
          VkMemoryBarrier2 toHost = {};
          toHost.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
          toHost.srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
          toHost.srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
          toHost.dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT;
          toHost.dstAccessMask = VK_ACCESS_2_HOST_READ_BIT;
          VkDependencyInfo info = {};
          info.sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO;
          info.memoryBarrierCount = 1;
          info.pMemoryBarriers = &toHost;
          call<PFN_vkCmdPipelineBarrier2>("vkCmdPipelineBarrier2")(commands, &info);
          return true;
        },
        &error);
    EXPECT_TRUE(ran) << error;
    std::vector<Answer> answers(questions.size());
    std::memcpy(answers.data(), out.data(), out.size());
    return answers;
  }

 private:
  template <class Function>
  Function call(const char* name) {
    return reinterpret_cast<Function>(device_.function(name));
  }

  void makePipeline(Solver solver) {
    VkShaderModuleCreateInfo code = {};
    code.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
    const bool standard = solver == Solver::Standard;
    code.codeSize = standard ? sizeof shaders::kHostStandard : sizeof shaders::kHostCompute;
    code.pCode = standard ? shaders::kHostStandard : shaders::kHostCompute;
    VkComputePipelineCreateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage.sType = VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO;
    info.stage.stage = VK_SHADER_STAGE_COMPUTE_BIT;
    info.stage.pName = "main";
    info.layout = layout_;
    EXPECT_EQ(call<PFN_vkCreateShaderModule>("vkCreateShaderModule")(device_.device(), &code,
                                                                     nullptr, &info.stage.module),
              VK_SUCCESS);
    EXPECT_EQ(call<PFN_vkCreateComputePipelines>("vkCreateComputePipelines")(
                  device_.device(), VK_NULL_HANDLE, 1, &info, nullptr, &pipeline_),
              VK_SUCCESS);
    call<PFN_vkDestroyShaderModule>("vkDestroyShaderModule")(device_.device(), info.stage.module,
                                                             nullptr);
  }

  void makeSet() {
    const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 2};
    VkDescriptorPoolCreateInfo pool = {};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = 1;
    pool.pPoolSizes = &size;
    EXPECT_EQ(call<PFN_vkCreateDescriptorPool>("vkCreateDescriptorPool")(device_.device(), &pool,
                                                                         nullptr, &pool_),
              VK_SUCCESS);
    VkDescriptorSetAllocateInfo info = {};
    info.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    info.descriptorPool = pool_;
    info.descriptorSetCount = 1;
    info.pSetLayouts = &own_;
    EXPECT_EQ(call<PFN_vkAllocateDescriptorSets>("vkAllocateDescriptorSets")(device_.device(),
                                                                             &info, &set_),
              VK_SUCCESS);
  }

  void write(uint32_t binding, VkBuffer buffer) {
    const VkDescriptorBufferInfo info = {buffer, 0, VK_WHOLE_SIZE};
    VkWriteDescriptorSet one = {};
    one.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
    one.dstSet = set_;
    one.dstBinding = binding;
    one.descriptorCount = 1;
    one.descriptorType = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    one.pBufferInfo = &info;
    call<PFN_vkUpdateDescriptorSets>("vkUpdateDescriptorSets")(device_.device(), 1, &one, 0,
                                                               nullptr);
  }

  headless::Device& device_;
  VkDescriptorSetLayout empty_ = VK_NULL_HANDLE, own_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  VkPipeline pipeline_ = VK_NULL_HANDLE;
  VkDescriptorPool pool_ = VK_NULL_HANDLE;
  VkDescriptorSet set_ = VK_NULL_HANDLE;
};

/// The same ray for the host: its vertical is z, the sun lies in the x-z plane.
Question questionOf(const ProbeQuery& q) {
  const double s = std::sin(q.zenith), t = std::sin(q.sunZenith);
  const auto f = [](double value) { return static_cast<float>(value); };
  Question question = {};
  question.upAltitude[2] = 1.0f;
  question.upAltitude[3] = f(q.altitude_m);
  question.viewDistance[0] = f(s * std::cos(q.azimuth));
  question.viewDistance[1] = f(s * std::sin(q.azimuth));
  question.viewDistance[2] = f(std::cos(q.zenith));
  question.viewDistance[3] = q.bounded ? f(q.distance_m) : 1e9f;
  question.sun[0] = f(t);
  question.sun[2] = f(std::cos(q.sunZenith));
  return question;
}

class HostShaderTest : public EitherSkyTest {
 protected:
  /// Errors up to 1e-3 of the value plus `absolute`.
  void expectTheSame(double absolute);
};
INSTANTIATE_TEST_SUITE_P(Solvers, HostShaderTest, kBothSolvers, solverName);

void HostShaderTest::expectTheSame(double absolute) {
  std::vector<ProbeQuery> rays, surfaces;
  for (const double altitude : {0.0, 2.0, 8000.0, 1e5, 3.6e7}) {
    for (const double sunZenith : {0.4, 1.4, 1.65}) {
      for (const double viewZenith : {0.3, 1.5, 1.9, 3.1, 2.995}) {
        for (const double distance : {-1.0, 1000.0, 3e5}) {
          ProbeQuery query;
          query.altitude_m = altitude;
          query.zenith = viewZenith;
          query.sunZenith = sunZenith;
          query.azimuth = 0.6;
          query.bounded = distance >= 0.0;
          query.distance_m = std::max(distance, 0.0);
          rays.push_back(query);
          query = {};
          query.kind = QueryKind::Irradiance;
          query.sunZenith = sunZenith;
          query.altitude_m = std::min(altitude, 59999.0);
          surfaces.push_back(query);
        }
      }
    }
  }
  std::vector<Question> questions, below;
  for (size_t i = 0; i < rays.size(); ++i) {
    questions.push_back(questionOf(rays[i]));
    below.push_back(questionOf(surfaces[i]));
  }
  HostCompute host(device(), infoOf(tables()).setLayout, solver());
  const std::vector<Answer> got = host.ask(questions, infoOf(tables()).set);
  const std::vector<Answer> light = host.ask(below, infoOf(tables()).set);
  const std::vector<ProbeAnswer> wanted = probeAll(rays);
  const std::vector<ProbeAnswer> wantedLight = probeAll(surfaces);
  for (size_t i = 0; i < rays.size(); ++i) {
    const bool whole = !rays[i].bounded;
    for (uint32_t c = 0; c < kSpectrumSize; ++c) {
      const auto near = [&](double value, double reference, const char* what) {
        EXPECT_NEAR(value, reference, 1e-3 * reference + absolute)
            << what << " " << c << ": altitude " << rays[i].altitude_m << ", view "
            << rays[i].zenith << ", sun " << rays[i].sunZenith << ", distance "
            << rays[i].distance_m;
      };
      if (whole) near(got[i].whole[c], wanted[i].skyRadiance[c], "whole");
      near(got[i].toPoint[c], wanted[i].skyRadiance[c], "to a point");
      near(got[i].transmittance[c], wanted[i].transmittance[c], "transmittance");
      const double muS = std::max(std::cos(rays[i].sunZenith), 0.0);
      near(light[i].direct[c] * muS, wantedLight[i].direct[c], "direct");
      near(light[i].sky[c], wantedLight[i].sky[c], "sky");
    }
    if (wanted[i].hitsGround) {
      EXPECT_EQ(got[i].toSpace[0], 0.0f);
    }
  }
}

// A mountainside as far away as the horizon or nearer is seen above it and below: rays past the
// ground and rays that would meet it behind. Its haze has no stripe there.
TEST_F(SkyTest, AnObjectAcrossTheHorizonHasNoStripe) {
  constexpr size_t kRays = 201;
  HostCompute host(device(), infoOf(tables()).setLayout, Solver::Moments);
  const Parameters earth = preset("earth");
  Steps light, dimming;
  for (const auto& [altitude, distance] :
       {std::pair{2.0, 3e3}, {100.0, 1e4}, {100.0, 3e4}, {1e3, 1e5}, {1e4, 3e5}}) {
    const double dip = horizonDip(earth, altitude);
    for (const double sunZenith : {0.7, 1.5, 1.57, 1.65, 1.8}) {
      for (const double azimuth : {0.0, 1.0, kPi}) {
        std::vector<Question> column;
        for (size_t i = 0; i < kRays; ++i) {
          ProbeQuery query;
          query.altitude_m = altitude;
          query.zenith = 0.5 * kPi + dip * (1.0 + 0.2 * (double(i) - 100.3) / 100.0);
          query.sunZenith = sunZenith;
          query.azimuth = azimuth;
          query.bounded = true;
          query.distance_m = distance;
          column.push_back(questionOf(query));
        }
        const std::vector<Answer> got = host.ask(column, infoOf(tables()).set);
        for (uint32_t c = 0; c < kSpectrumSize; ++c) {
          light.add(stepsOf(kRays, 1e-12, [&](size_t i) { return double(got[i].toPoint[c]); }));
          dimming.add(
              stepsOf(kRays, 1e-3, [&](size_t i) { return double(got[i].transmittance[c]); }));
        }
      }
    }
  }
  std::printf("across the horizon: haze's largest step %.1e, jump %.1e; transmittance %.1e, %.1e\n",
              light.largest, light.jump, dimming.largest, dimming.jump);
  EXPECT_LT(light.jump, 3e-4);
  EXPECT_LT(dimming.jump, 3e-4);
}

// As between pictures and probes: the host's ray is float, ours was double on the CPU. Of the
// standard tables a segment's light is a difference of two reads, hence the absolute part.
TEST_P(HostShaderTest, GetsWhatProbesAnswer) {
  expectTheSame(solver() == Solver::Moments ? 1e-12 : 3e-6);
}

}  // namespace
}  // namespace alpenglow::testing
