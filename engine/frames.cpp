#include "engine/frames.h"

namespace alpenglow::engine {

FrameObject::FrameObject(FrameList& list) : list_(list) {
  const std::lock_guard<std::mutex> lock(list.mutex_);
  previous_ = list.newest_;
  if (previous_ != nullptr) previous_->next_ = this;
  list.newest_ = this;
}

FrameObject::~FrameObject() {
  const std::lock_guard<std::mutex> lock(list_.mutex_);
  if (previous_ != nullptr) previous_->next_ = next_;
  (next_ != nullptr ? next_->previous_ : list_.newest_) = previous_;
}

void FrameList::advance(uint64_t submitting, uint64_t completed) {
  const std::lock_guard<std::mutex> lock(mutex_);
  begun_ = 0;
  submitting_ = submitting;
  completed_ = completed;
  for (FrameObject* object = newest_; object != nullptr; object = object->previous_)
    object->frameCompleted(completed);
}

bool FrameList::forgotten() {
  constexpr uint32_t kMany = 1000;
  return ++begun_ == kMany;
}

void FrameList::abandon(uint64_t frame) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (FrameObject* object = newest_; object != nullptr; object = object->previous_)
    object->frameAbandoned(frame);
}

void FrameList::announceDestruction(const FrameObject* gone) {
  const std::lock_guard<std::mutex> lock(mutex_);
  for (FrameObject* object = newest_; object != nullptr; object = object->previous_)
    if (object != gone) object->objectDestroyed(gone);
}

void FrameList::destroyAll() {
  while (newest_ != nullptr) newest_->destroyNow();
}

}  // namespace alpenglow::engine
