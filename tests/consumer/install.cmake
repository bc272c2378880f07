cmake_minimum_required(VERSION 3.22)
# cmake -DBUILD=... -DPREFIX=... -DCONFIG=... -P install.cmake: installs into an empty prefix.
file(REMOVE_RECURSE "${PREFIX}")
execute_process(COMMAND "${CMAKE_COMMAND}" --install "${BUILD}" --prefix "${PREFIX}"
                        --config "${CONFIG}"
                OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "Installing failed:\n${output}")
endif()

foreach(file bin/alpenglow include/alpenglow/alpenglow.h include/alpenglow/headless.h
        include/alpenglow/reference/reference.h share/alpenglow/glsl/alpenglow/atmosphere.glsl
        share/alpenglow/scenes/clear_noon.json share/alpenglow/data/earth.jpg
        share/alpenglow/data/stars.LICENSE)
  if(NOT EXISTS "${PREFIX}/${file}")
    message(FATAL_ERROR "The installed package lacks ${file}.")
  endif()
endforeach()
# Where they stand depends on the machine's layout.
foreach(file alpenglow.pc LICENSE)
  file(GLOB_RECURSE found "${PREFIX}/${file}")
  if(NOT found)
    message(FATAL_ERROR "The installed package lacks ${file}.")
  endif()
endforeach()
# A package that names a folder of this machine's checkout works here and nowhere else.
file(GLOB_RECURSE packages "${PREFIX}/*.cmake")
foreach(file IN LISTS packages)
  file(READ "${file}" text)
  if(text MATCHES "alpenglow_options|alpenglow_glm|_objects")
    message(FATAL_ERROR "${file} names ${CMAKE_MATCH_0}, which is no affair of users.")
  endif()
  foreach(folder "${BUILD}/" "${CMAKE_CURRENT_LIST_DIR}")
    string(FIND "${text}" "${folder}" position)
    if(NOT position EQUAL -1)
      message(FATAL_ERROR "${file} names ${folder}, which users don't have.")
    endif()
  endforeach()
endforeach()
