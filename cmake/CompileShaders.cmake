# alpenglow_embed_shader(TARGET target SOURCE file.comp NAME kName OUTPUT name.h
#                        [DEFINES A B=2...])
#
# Compiles a shader of Vulkan 1.2 to SPIR-V, checks it with spirv-val (an invalid module fails the
# build) and embeds it: `#include <alpenglow/shaders/name.h>` then has
#   namespace alpenglow::shaders { inline constexpr uint32_t kName[] = {...}; }
# `target` may be of any type, INTERFACE included; whoever links it can include the header and is
# built after it. The shader is compiled again when a file that it includes changes. SOURCE is
# relative to the calling folder; includes are found beside the source and in shaders/glsl.
#
# With ALPENGLOW_SHADERS_FROM nothing is compiled that another build of the same sources has.

set(ALPENGLOW_SHADERS_FROM "" CACHE PATH
    "shaders/generated of another, finished build of the same sources; empty: compile the shaders")
set(ALPENGLOW_GENERATED_SHADER_DIR "${PROJECT_BINARY_DIR}/shaders/generated")
set(ALPENGLOW_GLSL_SOURCE_DIR "${PROJECT_SOURCE_DIR}/shaders/glsl")
set(ALPENGLOW_EMBED_SCRIPT "${PROJECT_SOURCE_DIR}/cmake/EmbedSpirv.cmake")

# Keeps name, source and defines of a shader below shaders/glsl, as a line of shaders.json.
function(alpenglow_note_shader source name defines)
  file(RELATIVE_PATH path "${ALPENGLOW_GLSL_SOURCE_DIR}" "${source}")
  if(path MATCHES "^\\.\\./")
    return()
  endif()
  list(TRANSFORM defines PREPEND "\"")
  list(TRANSFORM defines APPEND "\"")
  string(REPLACE ";" ", " defines "${defines}")
  set_property(GLOBAL APPEND PROPERTY ALPENGLOW_SHADERS
               "  {\"name\": \"${name}\", \"source\": \"${path}\", \"defines\": [${defines}]}")
endfunction()

# Writes shaders.json, an array of the shaders noted until now: docs/shaders.md.
function(alpenglow_write_shader_list file)
  get_property(lines GLOBAL PROPERTY ALPENGLOW_SHADERS)
  list(JOIN lines ",\n" text)
  file(CONFIGURE OUTPUT "${file}" CONTENT "[\n${text}\n]\n" @ONLY)
endfunction()

function(alpenglow_embed_shader)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "TARGET;SOURCE;NAME;OUTPUT" "DEFINES")
  if(arg_UNPARSED_ARGUMENTS OR NOT (arg_TARGET AND arg_SOURCE AND arg_NAME AND arg_OUTPUT))
    message(FATAL_ERROR "alpenglow_embed_shader needs TARGET, SOURCE, NAME and OUTPUT; unknown "
                        "arguments: \"${arg_UNPARSED_ARGUMENTS}\"")
  endif()
  get_filename_component(source "${arg_SOURCE}" ABSOLUTE)
  get_filename_component(stem "${arg_OUTPUT}" NAME_WE)
  set(spirv "${ALPENGLOW_GENERATED_SHADER_DIR}/spirv/${stem}.spv")
  set(header "${ALPENGLOW_GENERATED_SHADER_DIR}/alpenglow/shaders/${stem}.h")
  alpenglow_note_shader("${source}" "${arg_NAME}" "${arg_DEFINES}")
  get_target_property(type ${arg_TARGET} TYPE)
  if(type STREQUAL "INTERFACE_LIBRARY")
    set(scope INTERFACE)
  else()
    set(scope PUBLIC)
  endif()
  if(ALPENGLOW_SHADERS_FROM AND EXISTS "${ALPENGLOW_SHADERS_FROM}/alpenglow/shaders/${stem}.h")
    target_include_directories(${arg_TARGET} ${scope}
                               "$<BUILD_INTERFACE:${ALPENGLOW_SHADERS_FROM}>")
    return()
  endif()
  file(MAKE_DIRECTORY "${ALPENGLOW_GENERATED_SHADER_DIR}/spirv")
  list(TRANSFORM arg_DEFINES PREPEND "-D")

  add_custom_command(
    OUTPUT "${spirv}"
    COMMAND "${GLSLANG_VALIDATOR}" --quiet -V --target-env vulkan1.2 -g0 ${arg_DEFINES}
            "-I${ALPENGLOW_GLSL_SOURCE_DIR}" --depfile "${spirv}.d" -o "${spirv}" "${source}"
    COMMAND "${SPIRV_VAL}" --target-env vulkan1.2 "${spirv}"
    DEPENDS "${source}"
    DEPFILE "${spirv}.d"
    COMMENT "Compiling shader ${stem}" VERBATIM)
  add_custom_command(
    OUTPUT "${header}"
    COMMAND "${CMAKE_COMMAND}" "-DINPUT=${spirv}" "-DOUTPUT=${header}" "-DNAME=${arg_NAME}"
            -P "${ALPENGLOW_EMBED_SCRIPT}"
    DEPENDS "${spirv}" "${ALPENGLOW_EMBED_SCRIPT}"
    COMMENT "Embedding shader ${stem}" VERBATIM)
  add_custom_target(alpenglow_shader_${stem} DEPENDS "${header}")
  add_dependencies(${arg_TARGET} alpenglow_shader_${stem})

  target_include_directories(${arg_TARGET} ${scope}
                             $<BUILD_INTERFACE:${ALPENGLOW_GENERATED_SHADER_DIR}>)
endfunction()
