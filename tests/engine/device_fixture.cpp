#include "tests/engine/device_fixture.h"

#include <dlfcn.h>

#include <mutex>

/// Read by the leak checker, where there is one: blocks that the validation layer of Debian 12
/// (vulkan-validationlayers 1.3.239) keeps for ever.
extern "C" __attribute__((visibility("default"))) const char* __lsan_default_suppressions();
const char* __lsan_default_suppressions() { return "leak:libVkLayer_khronos_validation.so\n"; }

namespace alpenglow::testing {
namespace {

/// Messages of every device of the program since the last `take`.
class Messages {
 public:
  void add(std::string_view message) {
    const std::lock_guard<std::mutex> lock(mutex_);
    messages_.emplace_back(message);
  }
  std::vector<std::string> take() {
    const std::lock_guard<std::mutex> lock(mutex_);
    return std::exchange(messages_, {});
  }

 private:
  std::mutex mutex_;
  std::vector<std::string> messages_;
};

Messages& messages() {
  static Messages instance;
  return instance;
}

std::unique_ptr<headless::Device> createDevice(headless::RequirementsFn requirements,
                                               std::string* error) {
  // Once unloaded, a module takes with it the pointers and names by which a leak checker tells its
  // memory from ours. One that isn't there isn't used either.
  (void)dlopen("libvulkan_lvp.so", RTLD_NOW | RTLD_NODELETE);
  (void)dlopen("libVkLayer_khronos_validation.so", RTLD_NOW | RTLD_NODELETE);
  headless::DeviceOptions options;
  options.validation = true;
  options.requirements = std::move(requirements);
  options.onValidationMessage = [](std::string_view message) { messages().add(message); };
  return headless::Device::create(options, error);
}

/// Vulkan 1.3 and the features that any capability of the library needs.
Status everyFeature(PFN_vkGetInstanceProcAddr, VkInstance, VkPhysicalDevice, Requirements* out,
                    std::string*) {
  out->apiVersion = VK_API_VERSION_1_3;
  out->deviceFeatures = kFeatureSynchronization2 | kFeatureDynamicRendering;
  out->features.dualSrcBlend = out->features.geometryShader = VK_TRUE;
  out->features.depthClamp = out->features.shaderClipDistance = VK_TRUE;
  out->features.independentBlend = VK_TRUE;
  return Status::Ok;
}

std::unique_ptr<headless::Device>& sharedDevice() {
  static std::unique_ptr<headless::Device> instance;
  return instance;
}

/// Destroys the shared device while a failure still counts.
class SharedDeviceEnvironment : public ::testing::Environment {
 public:
  void TearDown() override {
    sharedDevice().reset();
    for (const std::string& message : messages().take()) {
      ADD_FAILURE() << "Validation, as the device went: " << message;
    }
  }
};

[[maybe_unused]] const auto* const kEnvironment =
    ::testing::AddGlobalTestEnvironment(new SharedDeviceEnvironment);

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

void DeviceTest::SetUp() {
  if (sharedDevice() == nullptr) {
    std::string error;
    sharedDevice() = createDevice(everyFeature, &error);
    ASSERT_NE(sharedDevice(), nullptr) << error;
  }
}

void DeviceTest::TearDown() {
  const std::vector<std::string> came = messages().take();
  for (const std::string& message : came) {
    bool known = false;
    for (const std::string& part : expected_) known |= contains(message, part);
    if (!known) ADD_FAILURE() << "Validation: " << message;
  }
  for (const std::string& part : expected_) {
    bool seen = false;
    for (const std::string& message : came) seen |= contains(message, part);
    if (!seen) ADD_FAILURE() << "Validation was expected to say \"" << part << "\", but didn't.";
  }
}

headless::Device& DeviceTest::device() { return *sharedDevice(); }

ContextDesc DeviceTest::contextDesc() {
  ContextDesc desc = device().contextDesc();
  desc.diagnostics.user = &diagnostics_;
  desc.diagnostics.report = [](void* user, const Diagnostic& diagnostic) {
    static_cast<std::vector<std::string>*>(user)->emplace_back(diagnostic.message);
  };
  return desc;
}

std::unique_ptr<headless::Device> DeviceTest::makeDevice(headless::RequirementsFn requirements) {
  std::string error;
  std::unique_ptr<headless::Device> made = createDevice(std::move(requirements), &error);
  if (made == nullptr) ADD_FAILURE() << error;
  return made;
}

void DeviceTest::run(const std::function<bool(VkCommandBuffer)>& record) {
  std::string error = "The recording function returned false.";
  ASSERT_TRUE(device().run(record, &error)) << error;
}

const std::string& DeviceTest::lastDiagnostic() const {
  static const std::string kNone;
  return diagnostics_.empty() ? kNone : diagnostics_.back();
}

}  // namespace alpenglow::testing
