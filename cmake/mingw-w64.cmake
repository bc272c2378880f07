# Toolchain file: 64-bit Windows by GCC of mingw-w64, for the core and headless (Debian:
# g++-mingw-w64-x86-64-posix). scripts/portability.sh says how it is used: the Vulkan headers, volk
# and GLM are those of the building machine, in ALPENGLOW_MINGW_ROOT, which
# scripts/mingw_root.sh makes.

set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_EXE_LINKER_FLAGS_INIT "-static")  # No DLL of the compiler beside the program.
set(CMAKE_SHARED_LINKER_FLAGS_INIT "-static")

list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES ALPENGLOW_MINGW_ROOT)
set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32 "${ALPENGLOW_MINGW_ROOT}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
set(Vulkan_INCLUDE_DIR "${ALPENGLOW_MINGW_ROOT}/include" CACHE PATH "")
set(Vulkan_LIBRARY "${ALPENGLOW_MINGW_ROOT}/lib/libvulkan-1.a" CACHE FILEPATH "")
