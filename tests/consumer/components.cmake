# What find_package says of the package PREFIX: of components that it has, lacks and doesn't know.
# expect(SENTENCE arguments...): configuring a project that calls find_package(Alpenglow arguments...)
# prints SENTENCE, a regular expression.
function(expect sentence)
  list(JOIN ARGN " " arguments)
  string(MD5 name "${arguments}")
  set(source "${WORK}/${name}")
  file(REMOVE_RECURSE "${source}")
  file(WRITE "${source}/CMakeLists.txt" "cmake_minimum_required(VERSION 3.22)
project(asks LANGUAGES CXX)
find_package(Alpenglow ${arguments})
message(STATUS \"Alpenglow_FOUND is ${dollar}{Alpenglow_FOUND}.\")
")
  execute_process(COMMAND "${CMAKE_COMMAND}" -S "${source}" -B "${source}/build" -G Ninja
                          "-DCMAKE_CXX_COMPILER=${CXX}" "-DCMAKE_PREFIX_PATH=${PREFIX}"
                          -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF ${extra}
                  OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(NOT output MATCHES "${sentence}")
    message(FATAL_ERROR "find_package(Alpenglow ${arguments}) was expected to say \"${sentence}\", "
                        "but said:\n${output}")
  endif()
  message(STATUS "${arguments}: ${CMAKE_MATCH_0}")
endfunction()
set(dollar "$")
set(extra "")

expect("Alpenglow_FOUND is (1|TRUE)" 1 CONFIG REQUIRED COMPONENTS atmosphere headless reference shaders)
expect("Alpenglow has no component \"clouds\", only atmosphere, headless, reference, shaders, io\\."
       1 CONFIG REQUIRED COMPONENTS atmosphere clouds)
expect("Alpenglow_FOUND is (1|TRUE)" 1 CONFIG REQUIRED COMPONENTS atmosphere OPTIONAL_COMPONENTS clouds)
expect("Alpenglow_FOUND is (0|FALSE)" 1 CONFIG QUIET COMPONENTS clouds)
expect("compatible with requested version \"2\"" 2 CONFIG REQUIRED)
# A package without io, and one whose OpenImageIO is gone.
file(REMOVE_RECURSE "${WORK}/prefix")
file(COPY "${PREFIX}/" DESTINATION "${WORK}/prefix")
set(PREFIX "${WORK}/prefix")
set(extra -DCMAKE_DISABLE_FIND_PACKAGE_OpenImageIO=ON)
expect("component io needs OpenImageIO, which was not found" 1 CONFIG REQUIRED COMPONENTS io)
expect("Alpenglow_FOUND is (1|TRUE)" 1 CONFIG REQUIRED)
set(extra "")
file(GLOB_RECURSE files "${PREFIX}/*/AlpenglowIoTargets*.cmake")
if(files)
  file(REMOVE ${files})
endif()
expect("was built without its component io" 1 CONFIG REQUIRED COMPONENTS io)
