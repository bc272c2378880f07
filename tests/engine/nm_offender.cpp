// What nm_test.cmake must catch: a direct call of Vulkan. Never linked.
#include <vulkan/vulkan_core.h>

void offend(VkCommandBuffer commands);
void offend(VkCommandBuffer commands) { vkCmdDispatch(commands, 1, 1, 1); }
void padOne();
void padOne() {}
void padTwo();
void padTwo() {}
void padThree();
void padThree() {}
void padFour();
void padFour() {}
