// A validated device for tests: core and synchronisation checks are on, and one message fails the
// test. Link alpenglow_device_fixture.
#pragma once

#include <alpenglow/headless.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace alpenglow::testing {

/// All tests of a program share one device, made at the first use and destroyed after the last
/// test; what validation says then fails the program.
class DeviceTest : public ::testing::Test {
 protected:
  void SetUp() override;     ///< Fails the test when there is no device.
  void TearDown() override;  ///< Fails the test on any message that nobody expected.

  headless::Device& device();
  /// ContextDesc of the shared device whose diagnostics go to `diagnostics()`.
  ContextDesc contextDesc();
  /// Another device, whose messages count in the same way; null after a failure.
  std::unique_ptr<headless::Device> makeDevice(headless::RequirementsFn requirements = nullptr);

  /// At least one message with this text must come before the test ends; such messages don't fail
  /// it.
  void expectMessage(std::string part) { expected_.push_back(std::move(part)); }
  /// Records, submits and waits; fails the test when that fails.
  void run(const std::function<bool(VkCommandBuffer)>& record);

  /// All that was recorded has completed: frees what objects of the context left behind.
  void finishFrames(Context* context) {
    const uint64_t next = device().skipFrame();
    EXPECT_EQ(advanceFrame(context, next, next - 1), Status::Ok) << lastDiagnostic();
  }

  /// What came to the callback of contextDesc(), oldest first.
  const std::vector<std::string>& diagnostics() const { return diagnostics_; }
  const std::string& lastDiagnostic() const;

 private:
  std::vector<std::string> expected_;
  std::vector<std::string> diagnostics_;
};

}  // namespace alpenglow::testing
