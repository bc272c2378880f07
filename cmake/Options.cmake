# What every room compiles with. `alpenglow_options` never leaves the build tree: what is installed
# links it as $<BUILD_INTERFACE:alpenglow_options>.

option(ALPENGLOW_BUILD_TESTS "Build the tests" ${PROJECT_IS_TOP_LEVEL})
option(ALPENGLOW_BUILD_SAMPLES "Build the program alpenglow (needs io)" ${PROJECT_IS_TOP_LEVEL})
option(ALPENGLOW_BUILD_VIEWER "Build the program alpenglow-view (needs the samples, GLFW and Dear ImGui)"
       ${ALPENGLOW_BUILD_SAMPLES})
option(ALPENGLOW_BUILD_IO "Build Alpenglow::io (needs OpenImageIO and nlohmann-json)"
       ${PROJECT_IS_TOP_LEVEL})
option(ALPENGLOW_BUILD_COST "Build Alpenglow::cost (needs io and cairo)" ${ALPENGLOW_BUILD_IO})
option(ALPENGLOW_SHARED "Make Alpenglow::atmosphere and Alpenglow::reference shared libraries"
       ${BUILD_SHARED_LIBS})
option(ALPENGLOW_CORE_WITHOUT_EXCEPTIONS
       "Compile the core with -fno-exceptions -fno-rtti: where host memory ends, the process does"
       OFF)
option(ALPENGLOW_INSTALL "Add install rules" ${PROJECT_IS_TOP_LEVEL})
option(ALPENGLOW_WARNINGS_AS_ERRORS "Stop at the first warning" ${PROJECT_IS_TOP_LEVEL})

if(ALPENGLOW_BUILD_COST AND NOT ALPENGLOW_BUILD_IO)
  message(FATAL_ERROR "ALPENGLOW_BUILD_COST needs ALPENGLOW_BUILD_IO, which is off.")
endif()
if(ALPENGLOW_BUILD_VIEWER AND NOT ALPENGLOW_BUILD_SAMPLES)
  message(FATAL_ERROR "ALPENGLOW_BUILD_VIEWER needs ALPENGLOW_BUILD_SAMPLES, which is off.")
endif()
if(ALPENGLOW_BUILD_SAMPLES AND NOT ALPENGLOW_BUILD_IO)
  message(FATAL_ERROR "ALPENGLOW_BUILD_SAMPLES needs ALPENGLOW_BUILD_IO, which is off.")
endif()

if(PROJECT_IS_TOP_LEVEL)
  get_property(multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
  if(NOT multi_config AND NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
  endif()
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")
  find_program(CCACHE_PROGRAM ccache)
  mark_as_advanced(CCACHE_PROGRAM)
  if(CCACHE_PROGRAM AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CCACHE_PROGRAM}")
  endif()
  enable_testing()
endif()
set(CMAKE_CXX_EXTENSIONS OFF)

add_library(alpenglow_options INTERFACE)
target_compile_features(alpenglow_options INTERFACE $<BUILD_INTERFACE:cxx_std_20>)
target_compile_definitions(alpenglow_options INTERFACE
  $<BUILD_INTERFACE:$<$<BOOL:${ALPENGLOW_SHARED}>:ALPENGLOW_SHARED>>)
set(gnu_like $<OR:$<CXX_COMPILER_ID:GNU>,$<CXX_COMPILER_ID:Clang>,$<CXX_COMPILER_ID:AppleClang>>)
target_compile_options(alpenglow_options INTERFACE
  $<BUILD_INTERFACE:$<${gnu_like}:-Wall;-Wextra;-Wconversion;-Wshadow>>
  $<BUILD_INTERFACE:$<$<AND:${gnu_like},$<NOT:$<BOOL:${WIN32}>>>:-fPIC>>
  $<BUILD_INTERFACE:$<${gnu_like}:-fvisibility=hidden;-fvisibility-inlines-hidden>>
  $<BUILD_INTERFACE:$<$<AND:${gnu_like},$<BOOL:${ALPENGLOW_WARNINGS_AS_ERRORS}>>:-Werror>>)

# What the library's own rooms and the tests see besides: every header, by its path from the top. The
# samples don't: they link the libraries as any user does.
add_library(alpenglow_internal INTERFACE)
target_link_libraries(alpenglow_internal INTERFACE alpenglow_options)
target_include_directories(alpenglow_internal INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/atmosphere/include>
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/engine/headless/include>)

# The headers a host includes, as a target: what our own libraries hand on to their users.
add_library(alpenglow_headers INTERFACE)
add_library(Alpenglow::headers ALIAS alpenglow_headers)
set_target_properties(alpenglow_headers PROPERTIES EXPORT_NAME headers)
target_compile_features(alpenglow_headers INTERFACE cxx_std_17)
if(ALPENGLOW_SHARED)
  target_compile_definitions(alpenglow_headers INTERFACE ALPENGLOW_SHARED)
endif()
target_include_directories(alpenglow_headers INTERFACE
  $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/atmosphere/include>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

# What hosts include in their own shaders: Alpenglow::shaders is a name with a property,
# ALPENGLOW_GLSL_DIR, the include path for their GLSL compiler.
add_library(alpenglow_glsl INTERFACE)
add_library(Alpenglow::shaders ALIAS alpenglow_glsl)
set_target_properties(alpenglow_glsl PROPERTIES EXPORT_NAME shaders
                      ALPENGLOW_GLSL_DIR "${PROJECT_SOURCE_DIR}/shaders/glsl")
