// The compute pass that answers point queries from the tables.
#pragma once

#include <alpenglow/query.h>

#include <map>
#include <mutex>
#include <tuple>

#include "atmosphere/tables/table_set.h"

namespace alpenglow::passes {

/// Mirrors Query in shaders/glsl/passes/probe.comp.
struct PreparedQuery {
  float h, mu, muS, nu;
  float d, extent, muSGround;
  uint32_t flags;
};
static_assert(sizeof(PreparedQuery) == 32);

/// Ok, or a sentence that names the query by its index and the field.
Status checkQueries(const engine::Device& device, const ProbeQuery* queries, uint32_t count);
PreparedQuery prepareQuery(const physics_f64::Medium& medium, const ProbeQuery& query);

/// Layouts and pipelines of the pass; one for each context. Thread-safe.
class ProbePass {
 public:
  static Status create(tables::Resources& resources, ProbePass** out);
  static void destroy(ProbePass* pass);
  Status record(const Tables& tables, VkCommandBuffer commands, const ProbeQuery* queries,
                uint32_t count, VkBuffer answers);

 private:
  explicit ProbePass(tables::Resources& resources)
      : resources_(resources), device_(resources.device()) {}
  Status makeLayouts();
  Status pipeline(const TableDesc& desc, VkPipeline* out);

  /// Objects of one call until its frame completes.
  struct Call {
    engine::Buffer queries;
    engine::MemoryBlock block;
    VkDescriptorPool pool = VK_NULL_HANDLE;
    VkDescriptorSet set = VK_NULL_HANDLE;
  };
  Status prepareCall(const Tables& tables, const ProbeQuery* queries, uint32_t count,
                     VkBuffer answers, Call* call);

  tables::Resources& resources_;
  engine::Device& device_;
  VkDescriptorSetLayout setLayout_ = VK_NULL_HANDLE;
  VkPipelineLayout layout_ = VK_NULL_HANDLE;
  std::mutex mutex_;
  /// By kind of tables; made when first used.
  std::map<std::tuple<Solver, MieStorage, EffectFlags>, VkPipeline> pipelines_;
};

}  // namespace alpenglow::passes
