cmake_minimum_required(VERSION 3.22)
# Configures, builds and runs the project SOURCE in the folder WORK, which is emptied first; the
# picture of embed_minimal goes to CHECK. ARGUMENTS: cmake's, separated by "|"; -DPLAIN=ON among
# them: compiled without exceptions and RTTI.
string(REPLACE "|" ";" arguments "${ARGUMENTS}")
if("-DPLAIN=ON" IN_LIST arguments)
  list(REMOVE_ITEM arguments "-DPLAIN=ON")
  string(APPEND FLAGS " -fno-exceptions -fno-rtti")
endif()

function(run step)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY "${WORK}" RESULT_VARIABLE result
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${step} failed (${result}):\n${output}")
  endif()
  message(STATUS "${step}: done")
endfunction()

file(REMOVE_RECURSE "${WORK}")
file(MAKE_DIRECTORY "${WORK}")
run("Configuring" "${CMAKE_COMMAND}" -S "${SOURCE}" -B "${WORK}/build" -G Ninja
    "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}"
    "-DCMAKE_CXX_FLAGS=${FLAGS} -Wall -Wextra -Wno-missing-field-initializers -Werror"
    -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF ${arguments})

# A package found elsewhere on the machine would prove nothing.
load_cache("${WORK}/build" READ_WITH_PREFIX cache_ Alpenglow_DIR EXPECT_PREFIX)
if(cache_EXPECT_PREFIX)
  string(FIND "${cache_Alpenglow_DIR}" "${cache_EXPECT_PREFIX}/" position)
  if(NOT position EQUAL 0)
    message(FATAL_ERROR "Alpenglow was found in \"${cache_Alpenglow_DIR}\", expected below "
                        "\"${cache_EXPECT_PREFIX}\".")
  endif()
endif()

get_filename_component(project "${SOURCE}" NAME)
if(project STREQUAL "embed_minimal")
  run("Building" "${CMAKE_COMMAND}" --build "${WORK}/build" --target embed_minimal -j 2)
  run("Running" "${WORK}/build/embed_minimal" "${WORK}/sky.ppm" --small)
  run("Checking the picture" "${CHECK}" "${WORK}/sky.ppm" 640 360)
else()
  run("Building" "${CMAKE_COMMAND}" --build "${WORK}/build" -j 2)
  run("Running" "${WORK}/build/consumer_${project}")
endif()
