# Everything that is looked for on the machine, in one place.

# alpenglow_need(VARIABLE what it is for and where it comes from): stops where VARIABLE is false.
function(alpenglow_need variable)
  list(JOIN ARGN "" sentence)
  if(NOT ${variable})
    message(FATAL_ERROR "${sentence}")
  endif()
endfunction()

find_package(Vulkan QUIET)  # The headers; no library of ours links to the loader.
if(TARGET Vulkan::Headers)
  set(vulkan_headers ON)
endif()
alpenglow_need(vulkan_headers "Alpenglow needs the Vulkan headers, 1.3.239 or later, which were not "
               "found (Debian: libvulkan-dev, elsewhere the Vulkan SDK).")
target_link_libraries(alpenglow_headers INTERFACE Vulkan::Headers)
target_link_libraries(alpenglow_options INTERFACE $<BUILD_INTERFACE:Vulkan::Headers>)

find_program(GLSLANG_VALIDATOR glslangValidator)
alpenglow_need(GLSLANG_VALIDATOR "Alpenglow's shaders are compiled by glslangValidator, which was "
               "not found (Debian: glslang-tools, elsewhere the Vulkan SDK).")
find_program(SPIRV_VAL spirv-val)
alpenglow_need(SPIRV_VAL "Alpenglow's shaders are checked by spirv-val, which was not found (Debian: "
               "spirv-tools, elsewhere the Vulkan SDK).")

# GLM compiles the physics of the shaders as C++; it is in no public header.
find_package(glm QUIET)
alpenglow_need(glm_FOUND "Alpenglow's core compiles the shaders' physics as C++ with GLM, whose CMake "
               "package was not found (Debian: libglm-dev, elsewhere GLM 0.9.9 or later).")
add_library(alpenglow_glm INTERFACE)
target_link_libraries(alpenglow_glm INTERFACE $<BUILD_INTERFACE:glm::glm>)

find_package(Threads REQUIRED)
if(ALPENGLOW_BUILD_IO)
  include(AlpenglowOpenImageIO)
  find_package(nlohmann_json 3.11 REQUIRED)
endif()
if(ALPENGLOW_BUILD_COST)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
endif()
if(ALPENGLOW_BUILD_SAMPLES)
  find_package(CLI11 REQUIRED)
endif()
if(ALPENGLOW_BUILD_VIEWER)
  find_package(glfw3 3.3 REQUIRED)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(imgui REQUIRED IMPORTED_TARGET imgui)
  # Its backend calls Vulkan by the loader's own names, and the package doesn't say so.
  target_link_libraries(PkgConfig::imgui INTERFACE Vulkan::Vulkan)
endif()
if(ALPENGLOW_BUILD_TESTS)
  find_package(GTest REQUIRED)
endif()
