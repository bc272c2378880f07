# alpenglow_add_test(NAME name SOURCES file... [LIBS target...] [LABELS label...] [TIMEOUT seconds]
#                    [PROCESS] [POISON | POISON_LONG])
#
# A GoogleTest program build/bin/<name>, with main() from GTest::gtest_main unless it has its own.
# Each of its tests becomes a CTest of its own, found when CTest runs; with PROCESS the program is
# one CTest instead (for tests that share a costly fixture). Vulkan means lavapipe, wherever the
# tests run. POISON runs it a second time, named poison.*, with new device memory filled with 0x80;
# POISON_LONG does so with the label long, where that takes the better part of a minute.

set(ALPENGLOW_TEST_DRIVER "/usr/share/vulkan/icd.d/lvp_icd.x86_64.json" CACHE FILEPATH
    "Vulkan driver manifest that the tests use")

if(ALPENGLOW_BUILD_TESTS)
  include(GoogleTest)
endif()

function(alpenglow_add_test)
  cmake_parse_arguments(PARSE_ARGV 0 arg "PROCESS;POISON;POISON_LONG" "NAME;TIMEOUT" "SOURCES;LIBS;LABELS")
  if(arg_UNPARSED_ARGUMENTS OR NOT arg_NAME OR NOT arg_SOURCES)
    message(FATAL_ERROR "alpenglow_add_test needs NAME and SOURCES; unknown arguments: "
                        "\"${arg_UNPARSED_ARGUMENTS}\"")
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_executable(${arg_NAME} ${arg_SOURCES})
  target_link_libraries(${arg_NAME} PRIVATE alpenglow_internal ${arg_LIBS} GTest::gtest
                                            GTest::gtest_main)
  set(environment "VK_DRIVER_FILES=${ALPENGLOW_TEST_DRIVER}")
  alpenglow_register_test("" "${environment}")
  if(arg_POISON_LONG)
    list(APPEND arg_LABELS long)
  endif()
  if(arg_POISON OR arg_POISON_LONG)
    alpenglow_register_test("poison." "${environment};LVP_POISON_MEMORY=1")
  endif()
endfunction()

# Registers target ${arg_NAME} of the caller once, under a prefix and with an environment.
function(alpenglow_register_test prefix environment)
  if(arg_PROCESS)
    add_test(NAME ${prefix}${arg_NAME} COMMAND ${arg_NAME})
    set_tests_properties(${prefix}${arg_NAME} PROPERTIES ENVIRONMENT "${environment}"
                         LABELS "${arg_LABELS}" TIMEOUT ${arg_TIMEOUT})
  else()
    # gtest_discover_tests can't hand on a property that is a list, so a file that CTest reads
    # after the discovery sets them.
    set(list_name "${arg_NAME}_${prefix}tests")
    gtest_discover_tests(${arg_NAME} TEST_PREFIX "${prefix}${arg_NAME}." TEST_LIST "${list_name}"
                         DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60)
    set(script "${CMAKE_CURRENT_BINARY_DIR}/${list_name}.cmake")
    file(WRITE "${script}" "foreach(name IN LISTS ${list_name})
  set_tests_properties(\"\${name}\" PROPERTIES ENVIRONMENT \"${environment}\"
                       LABELS \"${arg_LABELS}\" TIMEOUT ${arg_TIMEOUT})
endforeach()
")
    set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES "${script}")
  endif()
endfunction()
