#include "table_pictures.h"

#include <alpenglow/shaders/view_table_2d_1.h>
#include <alpenglow/shaders/view_table_2d_2.h>
#include <alpenglow/shaders/view_table_3d_2.h>
#include <alpenglow/shaders/view_table_3d_3.h>
#include <alpenglow/shaders/view_table_3d_4.h>
#include <alpenglow/shaders/view_tone_vertex.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "common/tables_info.h"
#include "interface.h"
#include "picture.h"
#include "widgets.h"

namespace alpenglow::view {
namespace {

samples::Code codeOf(uint32_t binding, bool volume) {
  if (!volume) return binding == 1 ? samples::Code(shaders::kViewTable2d1) : shaders::kViewTable2d2;
  return binding == 2   ? samples::Code(shaders::kViewTable3d2)
         : binding == 3 ? samples::Code(shaders::kViewTable3d3)
                        : samples::Code(shaders::kViewTable3d4);
}

}  // namespace

TablePictures::TablePictures(const samples::Gpu* gpu, VkRenderPass renderPass)
    : gpu_(gpu), renderPass_(renderPass), vk_(*gpu) {}

std::vector<TablePictures::Shown> TablePictures::tablesOf(const TableDesc& desc) {
  std::vector<Shown> all;
  const auto disabledEffects = [&](Effect effect) {
    return !hasEffect(desc.disabledEffects, effect);
  };
  switch (desc.solver) {
    case Solver::Moments:
      all.push_back({"optical depth", "mu, r", 1, false, {0.0f, 16.0f, false}});
      if (disabledEffects(Effect::MultipleScattering)) break;
      all.push_back({"moments",
                     "mu_s, r; five below each other, logarithms",
                     2,
                     false,
                     {-12.0f, 2.0f, false}});
      if (!disabledEffects(Effect::Mie))
        all.push_back({"source", "gamma and psi, mu_s; r", 3, true, {0.0f, 2.0f, false}});
      break;
    case Solver::Standard:
      all = {{"optical depth", "mu, r", 1, false, {0.0f, 16.0f, false}},
             {"irradiance E", "mu_s, r", 2, false, {1e-5f, 0.2f, true}},
             {"scattering S", "mu_s and nu, mu; r", 3, true, {1e-5f, 1.0f, true}},
             {"single Mie", "mu_s and nu, mu; r", 4, true, {1e-5f, 1.0f, true}}};
      break;
    case Solver::Schafhitzel:
      all = {{"transmittance", "mu, r", 1, false, {0.0f, 1.0f, false}},
             {"Rayleigh", "mu, mu_s; r", 2, true, {1e-5f, 1.0f, true}},
             {"Mie", "mu, mu_s; r", 3, true, {1e-5f, 1.0f, true}}};
      break;
    case Solver::Hillaire:
      all = {{"transmittance", "mu, r", 1, false, {0.0f, 1.0f, false}},
             {"multiple", "mu_s, r", 2, false, {1e-5f, 0.2f, true}}};
      break;
    case Solver::HoffmanPreetham:
      break;
    case Solver::ONeil:
      all = {{"transmittance", "mu, r", 1, false, {0.0f, 1.0f, false}}};
      break;
  }
  return all;
}

VkPipeline TablePictures::pipelineFor(const Shown& shown) {
  samples::Owned<VkPipeline>& pipeline = pipelines_[{shown.binding, shown.volume}];
  if (pipeline.get() == VK_NULL_HANDLE) {
    samples::PipelineDesc desc;
    desc.vertex = shaders::kViewToneVertex;
    desc.fragment = codeOf(shown.binding, shown.volume);
    desc.layout = layout_.get();
    desc.color = kRadianceFormat;
    desc.renderPass = renderPass_;
    pipeline = gpu_->pipeline(desc);
  }
  return pipeline.get();
}

void TablePictures::make(const Tables* tables, const TableDesc& desc) {
  const std::vector<Shown> all = tablesOf(desc);
  draws_.clear();
  if (all.empty()) {
    ImGui::TextWrapped("This model has no table.");
    return;
  }
  const TablesInfo info = samples::infoOf(tables);
  if (layout_.get() == VK_NULL_HANDLE) {
    layout_ =
        gpu_->pipelineLayout({&info.setLayout, 1}, {VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(Push)});
  }
  chosen_ = std::min(chosen_, all.size() - 1);
  list(
      "table", all[chosen_].name, all.size(), chosen_, [&](size_t i) { return all[i].name; },
      &chosen_);
  const Shown& shown = all[chosen_];
  ImGui::TextDisabled("across, down%s: %s", shown.volume ? "; layer" : "", shown.axes);
  if (shown.volume) ImGui::SliderFloat("layer", &layer_, 0.0f, 1.0f, "%.3f of the layers");
  Look& look = looks_.emplace(shown.name, shown.look).first->second;
  const float speed = 0.01f * (look.logarithm ? look.from : look.to - look.from);
  ImGui::DragFloatRange2("black, white", &look.from, &look.to, std::max(speed, 1e-9f), 0.0f, 0.0f,
                         "%.3g");
  ImGui::Checkbox("logarithm", &look.logarithm);
  if (look.logarithm) look.from = std::max(look.from, 1e-6f * look.to);

  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = std::max(ImGui::GetContentRegionAvail().x, 16.0f);
  const float height = 0.6f * width;
  const ImVec2 pixels = ImGui::GetIO().DisplayFramebufferScale;
  const Push push = {{at.x * pixels.x, at.y * pixels.y, width * pixels.x, height * pixels.y},
                     {std::min(layer_, 0.9999f), look.from, look.to, look.logarithm ? 1.0f : 0.0f}};
  draws_.push_back({this, pipelineFor(shown), info.set, push});
  ImDrawList* drawing = ImGui::GetWindowDrawList();
  drawing->AddCallback(draw, &draws_.back());
  drawing->AddCallback(ImDrawCallback_ResetRenderState, nullptr);
  ImGui::Dummy({width, height});
}

void TablePictures::draw(const ImDrawList*, const ImDrawCmd* command) {
  const Draw& draw = *static_cast<const Draw*>(command->UserCallbackData);
  const Functions& vk = draw.owner->vk_;
  const VkCommandBuffer commands = Interface::recording();
  const ImVec2 pixels = ImGui::GetIO().DisplayFramebufferScale;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const float* area = draw.push.area;
  // The part of the picture that the panel's window shows.
  const ImVec4& clip = command->ClipRect;
  const float left = std::max({area[0], clip.x * pixels.x, 0.0f});
  const float top = std::max({area[1], clip.y * pixels.y, 0.0f});
  const float right = std::min({area[0] + area[2], clip.z * pixels.x, display.x * pixels.x});
  const float bottom = std::min({area[1] + area[3], clip.w * pixels.y, display.y * pixels.y});
  if (right <= left || bottom <= top) return;
  const VkViewport viewport = {area[0], area[1], area[2], area[3], 0.0f, 1.0f};
  const VkRect2D scissor = {
      {static_cast<int32_t>(left), static_cast<int32_t>(top)},
      {static_cast<uint32_t>(right - left), static_cast<uint32_t>(bottom - top)}};
  const VkPipelineLayout layout = draw.owner->layout_.get();
  vk.CmdSetViewport(commands, 0, 1, &viewport);
  vk.CmdSetScissor(commands, 0, 1, &scissor);
  vk.CmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, draw.pipeline);
  vk.CmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, 1, &draw.set, 0,
                           nullptr);
  vk.CmdPushConstants(commands, layout, VK_SHADER_STAGE_FRAGMENT_BIT, 0, sizeof(Push), &draw.push);
  vk.CmdDraw(commands, 3, 1, 0, 0);
}

}  // namespace alpenglow::view
