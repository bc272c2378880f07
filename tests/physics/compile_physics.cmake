# Compiles the physics text as GLSL and as C++ (float and double) with g++ and clang++. A compiler
# that is not installed is skipped; at least one must be there. Run by CTest, see CMakeLists.txt.

set(here "${CMAKE_CURRENT_LIST_DIR}")

function(check what)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${what} refuses the physics:\n${output}")
  endif()
  message(STATUS "${what}: ok")
endfunction()

check("glslangValidator" "${GLSLANG}" --quiet -V --target-env vulkan1.2
      "-I${SOURCE_DIR}/shaders/glsl" -o "${BINARY_DIR}/physics.spv" "${here}/physics.comp")

set(compilers 0)
foreach(compiler "${GXX}" "${CLANGXX}")
  if(NOT compiler)
    message(STATUS "a C++ compiler is not installed: skipped")
    continue()
  endif()
  foreach(precision f32 f64)
    check("${compiler} (${precision})" "${compiler}" -std=c++20 -fsyntax-only -Wall -Wextra
          -Wconversion -Wshadow -Werror "-DPRECISION=physics_${precision}" "-I${SOURCE_DIR}"
          "-I${SOURCE_DIR}/atmosphere/include" "${here}/physics_as_cpp.cpp")
  endforeach()
  math(EXPR compilers "${compilers} + 1")
endforeach()
if(compilers EQUAL 0)
  message(FATAL_ERROR "No C++ compiler was found: neither g++ nor clang++.")
endif()
