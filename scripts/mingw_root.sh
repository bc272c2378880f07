#!/usr/bin/env bash
# mingw_root.sh FOLDER: what cmake/mingw-w64.cmake needs of this machine, in FOLDER: links to the
# headers of Vulkan, volk and GLM, and an import library of vulkan-1.dll made from the headers.
set -euo pipefail

root="$1"
mkdir -p "$root/include" "$root/lib" "$root/share/cmake"
for name in vulkan vk_video volk.h volk.c glm; do
  ln -sfn "/usr/include/$name" "$root/include/$name"
done
# GLM's package names /usr/include, where the headers of this machine's own C library are, too.
mkdir -p "$root/share/cmake/glm"
cat >"$root/share/cmake/glm/glmConfig.cmake" <<'END'
if(NOT TARGET glm::glm)
  add_library(glm::glm INTERFACE IMPORTED)
  get_filename_component(root "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
  set_target_properties(glm::glm PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${root}/include")
endif()
END
{
  echo "LIBRARY vulkan-1.dll"
  echo "EXPORTS"
  grep -ohE 'VKAPI_CALL vk[A-Z][A-Za-z0-9]*\(' /usr/include/vulkan/vulkan_core.h |
    sed -E 's/VKAPI_CALL (vk[A-Za-z0-9]*)\(/\1/' | sort -u
} >"$root/lib/vulkan-1.def"
x86_64-w64-mingw32-dlltool -d "$root/lib/vulkan-1.def" -l "$root/lib/libvulkan-1.a"
