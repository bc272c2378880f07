# Everything that is looked for on the machine, in one place.

find_package(Vulkan REQUIRED)  # The headers; no library of ours links to the loader.
target_link_libraries(alpenglow_headers INTERFACE Vulkan::Headers)
target_link_libraries(alpenglow_options INTERFACE $<BUILD_INTERFACE:Vulkan::Headers>)

find_program(GLSLANG_VALIDATOR glslangValidator REQUIRED)
find_program(SPIRV_VAL spirv-val REQUIRED)

# GLM compiles the physics of the shaders as C++; it is in no public header.
find_package(glm REQUIRED)
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
