#include "stars.h"

#include <alpenglow/shaders/sample_stars.h>
#include <alpenglow/shaders/sample_stars_standard.h>
#include <alpenglow/shaders/sample_stars_vertex.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "common/tables_info.h"

namespace alpenglow::samples {
namespace {

/// As stars.vert takes it, three times for each star.
struct StarVertex {
  float direction[3];
  float share;
};
constexpr VkVertexInputAttributeDescription kAttribute = {0, 0, VK_FORMAT_R32G32B32A32_SFLOAT, 0};
constexpr uint32_t kCorners = 3;

/// StarView of stars.glsl.
struct StarView {
  float rightAltitude[4];
  float downFocal[4];
  float forwardFisheye[4];
  float up[4];
  float irradiance[4];
  float viewport[4];
};
constexpr VkPushConstantRange kPush = {VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                                       sizeof(StarView)};

float narrow(double value) { return static_cast<float>(value); }

std::vector<StarVertex> starVertices() {
  std::vector<StarVertex> vertices;
  for (const Star& star : starCatalogue()) {
    double d[3];
    starDirection(star, 0.0, d);
    const StarVertex vertex = {{narrow(d[0]), narrow(d[1]), narrow(d[2])},
                               narrow(shareOfSun(star))};
    vertices.insert(vertices.end(), kCorners, vertex);
  }
  return vertices;
}

// A vector of the planet's frame in the axes of the catalogue: the planet turns eastwards.
void toCatalogue(const double vector[3], double siderealHours, float out[4]) {
  const double turn = siderealHours * (3.14159265358979323846 / 12.0);
  out[0] = narrow(std::cos(turn) * vector[0] - std::sin(turn) * vector[1]);
  out[1] = narrow(std::sin(turn) * vector[0] + std::cos(turn) * vector[1]);
  out[2] = narrow(vector[2]);
}

StarView starView(const Parameters& parameters, Projection projection, const FrameDesc& draw,
                  double siderealHours) {
  const Camera& c = draw.cameras[0];
  const double r = std::hypot(c.position[0], c.position[1], c.position[2]);
  const double right[3] = {c.forward[1] * c.up[2] - c.forward[2] * c.up[1],
                           c.forward[2] * c.up[0] - c.forward[0] * c.up[2],
                           c.forward[0] * c.up[1] - c.forward[1] * c.up[0]};
  const double down[3] = {-c.up[0], -c.up[1], -c.up[2]};
  const double vertical[3] = {c.position[0] / r, c.position[1] / r, c.position[2] / r};
  StarView view = {};
  toCatalogue(right, siderealHours, view.rightAltitude);
  toCatalogue(down, siderealHours, view.downFocal);
  toCatalogue(c.forward, siderealHours, view.forwardFisheye);
  toCatalogue(vertical, siderealHours, view.up);
  view.rightAltitude[3] = narrow(std::max(r - parameters.bottomRadius_m, 0.0));
  const VkRect2D& area = draw.cameras[0].viewport;
  const double width = area.extent.width, height = area.extent.height;
  const bool fisheye = projection == Projection::Fisheye;
  view.downFocal[3] =
      narrow(fisheye ? std::min(width, height) / c.fov : 0.5 * height / std::tan(0.5 * c.fov));
  view.forwardFisheye[3] = fisheye ? narrow(0.5 * c.fov) : 0.0f;
  const double scale = draw.radianceScale == 0.0 ? 1.0 : draw.radianceScale;
  for (uint32_t i = 0; i < kSpectrumSize; ++i) {
    view.irradiance[i] = narrow(parameters.solarIrradiance[i] * scale);
  }
  view.viewport[0] = narrow(area.offset.x);
  view.viewport[1] = narrow(area.offset.y);
  view.viewport[2] = narrow(width);
  view.viewport[3] = narrow(height);
  return view;
}

}  // namespace

Stars::Stars(const Gpu* gpu, const StarsDesc& desc) : gpu_(gpu), projection_(desc.projection) {
  if (projection_ == Projection::Orthographic) return;
  const std::vector<StarVertex> vertices = starVertices();
  count_ = static_cast<uint32_t>(vertices.size());
  vertices_ = gpu->buffer(vertices.size() * sizeof vertices[0], VK_BUFFER_USAGE_VERTEX_BUFFER_BIT,
                          vertices.data());
  const VkDescriptorSetLayout set = infoOf(desc.tables).setLayout;
  layout_ = gpu->pipelineLayout({&set, 1}, kPush);
  PipelineDesc pipeline;
  pipeline.vertex = shaders::kSampleStarsVertex;
  pipeline.fragment = desc.solver == Solver::Standard ? Code(shaders::kSampleStarsStandard)
                                                      : Code(shaders::kSampleStars);
  pipeline.layout = layout_.get();
  pipeline.vertexStride = sizeof(StarVertex);
  pipeline.attributes = {&kAttribute, 1};
  pipeline.color = desc.colorFormat;
  pipeline.depth = desc.depthFormat;
  pipeline.blending = Blending::Add;
  pipeline_ = gpu->pipeline(pipeline);
}

void Stars::record(VkCommandBuffer commands, const Parameters& parameters, const Tables* tables,
                   const FrameDesc& draw, double siderealHours) const {
  if (count_ == 0) return;
  const VkRect2D& area = draw.cameras[0].viewport;
  const VkViewport viewport = {narrow(area.offset.x),
                               narrow(area.offset.y),
                               narrow(area.extent.width),
                               narrow(area.extent.height),
                               0.0f,
                               1.0f};
  const VkDescriptorSet set = infoOf(tables).set;
  const VkBuffer vertices = vertices_.buffer();
  const VkDeviceSize offset = 0;
  const StarView view = starView(parameters, projection_, draw, siderealHours);
  gpu_->function<PFN_vkCmdSetViewport>("vkCmdSetViewport")(commands, 0, 1, &viewport);
  gpu_->function<PFN_vkCmdSetScissor>("vkCmdSetScissor")(commands, 0, 1, &area);
  gpu_->function<PFN_vkCmdBindPipeline>("vkCmdBindPipeline")(
      commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline_.get());
  gpu_->function<PFN_vkCmdBindDescriptorSets>("vkCmdBindDescriptorSets")(
      commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout_.get(), 0, 1, &set, 0, nullptr);
  gpu_->function<PFN_vkCmdPushConstants>("vkCmdPushConstants")(
      commands, layout_.get(), kPush.stageFlags, 0, sizeof view, &view);
  gpu_->function<PFN_vkCmdBindVertexBuffers>("vkCmdBindVertexBuffers")(commands, 0, 1, &vertices,
                                                                       &offset);
  gpu_->function<PFN_vkCmdDraw>("vkCmdDraw")(commands, count_, 1, 0, 0);
}

}  // namespace alpenglow::samples
