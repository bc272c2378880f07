#include <alpenglow/types.h>

namespace alpenglow {
inline namespace v1_0 {

const char* statusName(Status status) {
  switch (status) {
    case Status::Ok:
      return "Ok";
    case Status::NotReady:
      return "NotReady";
    case Status::InvalidArgument:
      return "InvalidArgument";
    case Status::Unsupported:
      return "Unsupported";
    case Status::OutOfHostMemory:
      return "OutOfHostMemory";
    case Status::OutOfDeviceMemory:
      return "OutOfDeviceMemory";
    case Status::DeviceLost:
      return "DeviceLost";
    case Status::VulkanError:
      return "VulkanError";
  }
  return "an unknown status";
}

}  // namespace v1_0
}  // namespace alpenglow
