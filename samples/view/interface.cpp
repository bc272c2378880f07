#include "interface.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_vulkan.h>
#include <imgui.h>

#include <set>
#include <utility>

namespace alpenglow::view {
namespace {

constexpr float kFontPixels = 15.0f;
VkCommandBuffer g_recording = VK_NULL_HANDLE;  // ImGui itself is one for the whole program.

void checkResult(VkResult result) { samples::Gpu::check(result, "Dear ImGui's Vulkan call"); }

}  // namespace

Interface::Interface(const samples::Gpu* gpu, Window* window, const Presenter* presenter,
                     double scale)
    : gpu_(gpu), window_(window), presenter_(presenter), ownScale_(static_cast<float>(scale)) {
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;  // Nothing is written behind the user's back.
  ImGui::GetIO().ConfigWindowsMoveFromTitleBarOnly = true;
  ImGui_ImplGlfw_InitForVulkan(window->handle(), true);
  window->listenToKeys();
  setScale(ownScale_ * window->scale());
}

void Interface::startDrawing() {
  const headless::Device& device = gpu_->device();
  const VkDescriptorPoolSize size = {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1};
  const VkDescriptorPoolCreateInfo pool = {VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
                                           nullptr,
                                           VK_DESCRIPTOR_POOL_CREATE_FREE_DESCRIPTOR_SET_BIT,
                                           1,
                                           1,
                                           &size};
  pool_ = make<VkDescriptorPool>(*gpu_, Functions(*gpu_).CreateDescriptorPool, pool,
                                 "vkDestroyDescriptorPool");
  ImGui_ImplVulkan_InitInfo info = {};
  info.Instance = device.instance();
  info.PhysicalDevice = device.physicalDevice();
  info.Device = device.device();
  info.QueueFamily = device.queueFamily();
  info.Queue = device.queue();
  info.DescriptorPool = pool_.get();
  info.MinImageCount = kFramesInFlight;
  info.ImageCount = kFramesInFlight + 1;
  info.MSAASamples = VK_SAMPLE_COUNT_1_BIT;
  info.CheckVkResultFn = checkResult;
  ImGui_ImplVulkan_Init(&info, presenter_->renderPass());
  gpu_->run("font",
            [](VkCommandBuffer commands) { ImGui_ImplVulkan_CreateFontsTexture(commands); });
  ImGui_ImplVulkan_DestroyFontUploadObjects();
}

Interface::~Interface() {
  gpu_->device().waitIdle();
  ImGui_ImplVulkan_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Interface::setScale(float scale) {
  if (scale == scale_) return;
  if (scale_ != 0.0f) {
    gpu_->device().waitIdle();
    ImGui_ImplVulkan_Shutdown();
  }
  scale_ = scale;
  ImGuiStyle style;
  ImGui::StyleColorsDark(&style);
  style.WindowRounding = 4.0f;
  style.Colors[ImGuiCol_WindowBg].w = 0.88f;
  style.Colors[ImGuiCol_PopupBg].w = 1.0f;
  style.Colors[ImGuiCol_SliderGrab].w = 0.45f;  // Numbers are read through it.
  style.Colors[ImGuiCol_SliderGrabActive].w = 0.6f;
  style.Colors[ImGuiCol_TextDisabled] = {0.66f, 0.66f, 0.66f, 1.0f};
  style.ScaleAllSizes(scale);
  ImGui::GetStyle() = style;
  ImFontConfig font;
  font.SizePixels = kFontPixels * scale;
  ImFontAtlas* fonts = ImGui::GetIO().Fonts;
  fonts->Clear();
  fonts->AddFontDefault(&font);
  startDrawing();
}

// This version of ImGui looks at keys once a frame, so one that goes down and up within a frame
// must be seen down for one.
void Interface::handOnKeys() {
  const auto handOn = [this](const KeyEvent& e) {
    ImGui_ImplGlfw_KeyCallback(window_->handle(), e.key, e.scancode, e.action, e.modifiers);
  };
  for (const KeyEvent& event : std::exchange(held_, {})) handOn(event);
  std::set<int> pressed;
  for (const KeyEvent& event : window_->keys) {
    if (event.action == GLFW_RELEASE && pressed.contains(event.key)) {
      held_.push_back(event);
      continue;
    }
    if (event.action == GLFW_PRESS) pressed.insert(event.key);
    handOn(event);
  }
}

void Interface::begin() {
  handOnKeys();
  setScale(ownScale_ * window_->scale());
  ImGui_ImplVulkan_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
}

void Interface::end() { ImGui::Render(); }

void Interface::record(VkCommandBuffer commands) {
  g_recording = commands;
  ImGui_ImplVulkan_RenderDrawData(ImGui::GetDrawData(), commands);
  g_recording = VK_NULL_HANDLE;
}

bool Interface::wantsKeyboard() {
  return ImGui::GetIO().WantTextInput || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
}
bool Interface::wantsMouse() { return ImGui::GetIO().WantCaptureMouse; }
VkCommandBuffer Interface::recording() { return g_recording; }

}  // namespace alpenglow::view
