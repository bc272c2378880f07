// Frame numbers of the host, and the objects that are notified of them: the host may abandon a
// frame's commands, and what only a bake needs is freed when its last frame has completed.
#pragma once

#include <alpenglow/types.h>

#include <atomic>
#include <mutex>

namespace alpenglow::engine {

class Device;
class FrameList;

/// An object that lives in the list of its device from construction to destruction. No copies.
class FrameObject {
 public:
  explicit FrameObject(FrameList& list);
  FrameObject(const FrameObject&) = delete;
  FrameObject& operator=(const FrameObject&) = delete;

  /// Frames up to `completed` have finished.
  virtual void frameCompleted(uint64_t completed) = 0;
  /// Commands of `frame` will never execute.
  virtual void frameAbandoned(uint64_t frame) = 0;
  /// Another object is about to be destroyed.
  virtual void objectDestroyed(const FrameObject*) {}
  /// Destroys the object; the device has finished with it.
  virtual void destroyNow() = 0;

 protected:
  virtual ~FrameObject();

 private:
  friend class FrameList;
  FrameList& list_;
  FrameObject *previous_ = nullptr, *next_ = nullptr;
};

/// The numbers, and the objects that are alive. Thread-safe; but the calls of the objects happen
/// under its lock, so that they must not create or destroy others.
class FrameList {
 public:
  uint64_t submitting() const { return submitting_; }
  uint64_t completed() const { return completed_; }
  /// The numbers are checked by the caller.
  void advance(uint64_t submitting, uint64_t completed);
  void abandon(uint64_t frame);
  /// Counts a frame of an object. True once: after many of them without advance().
  bool forgotten();
  /// Notifies all others that this one is about to be destroyed.
  void announceDestruction(const FrameObject* object);
  /// Destroys all objects, the newest first.
  void destroyAll();

 private:
  friend class FrameObject;
  std::atomic<uint64_t> submitting_{1}, completed_{0};
  std::atomic<uint32_t> begun_{0};  ///< Since advance().
  std::mutex mutex_;
  FrameObject* newest_ = nullptr;
};

}  // namespace alpenglow::engine
