# Installed: libraries with their CMake package and pkg-config file, the licence, public headers, the program,
# and under share/alpenglow the GLSL that hosts include, the sample scenes and their data.
include(CMakePackageConfigHelpers)

set(share "${CMAKE_INSTALL_DATADIR}/alpenglow")
set(package "${CMAKE_INSTALL_LIBDIR}/cmake/Alpenglow")

install(TARGETS alpenglow_headers alpenglow_glsl alpenglow_atmosphere
                alpenglow_headless alpenglow_reference
        EXPORT AlpenglowTargets
        ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
        LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}"
        RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
install(EXPORT AlpenglowTargets NAMESPACE Alpenglow:: DESTINATION "${package}")
install(DIRECTORY "${PROJECT_SOURCE_DIR}/atmosphere/include/alpenglow"
                  "${PROJECT_SOURCE_DIR}/engine/headless/include/alpenglow"
        DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" FILES_MATCHING PATTERN "*.h"
        PATTERN "io" EXCLUDE)
install(DIRECTORY "${ALPENGLOW_GLSL_SOURCE_DIR}/" DESTINATION "${share}/glsl"
        FILES_MATCHING REGEX "\\.(glsl|comp|vert|geom|frag)$")
install(FILES "${PROJECT_BINARY_DIR}/shaders/shaders.json" DESTINATION "${share}/glsl")

if(ALPENGLOW_BUILD_IO)
  install(TARGETS alpenglow_io EXPORT AlpenglowIoTargets
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
          LIBRARY DESTINATION "${CMAKE_INSTALL_LIBDIR}")
  install(EXPORT AlpenglowIoTargets NAMESPACE Alpenglow:: DESTINATION "${package}")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/atmosphere/include/alpenglow/io"
          DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/alpenglow" FILES_MATCHING PATTERN "*.h")
  install(FILES "${PROJECT_SOURCE_DIR}/cmake/AlpenglowOpenImageIO.cmake"
          DESTINATION "${package}")
endif()
if(ALPENGLOW_BUILD_SAMPLES)
  if(ALPENGLOW_SHARED AND UNIX AND NOT APPLE)
    file(RELATIVE_PATH libraries "/p/${CMAKE_INSTALL_BINDIR}" "/p/${CMAKE_INSTALL_LIBDIR}")
    foreach(program alpenglow alpenglow_view)
      if(TARGET ${program})
        set_target_properties(${program} PROPERTIES INSTALL_RPATH "$ORIGIN/${libraries}")
      endif()
    endforeach()
  endif()
  install(TARGETS alpenglow RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  if(ALPENGLOW_BUILD_VIEWER)
    install(TARGETS alpenglow_view RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
    install(FILES "${PROJECT_SOURCE_DIR}/samples/view/view.json" DESTINATION "${share}")
  endif()
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/samples/scenes" "${PROJECT_SOURCE_DIR}/samples/flythroughs"
                    "${PROJECT_SOURCE_DIR}/samples/data"
          DESTINATION "${share}")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/samples/embed_minimal" DESTINATION "${share}/samples")
  install(DIRECTORY "${PROJECT_SOURCE_DIR}/tests/data/truth" DESTINATION "${share}"
          FILES_MATCHING PATTERN "earth.*" PATTERN "evening.*")
endif()

set(ALPENGLOW_SHARE_DIR "${share}")
configure_package_config_file("${PROJECT_SOURCE_DIR}/cmake/AlpenglowConfig.cmake.in"
  "${PROJECT_BINARY_DIR}/AlpenglowConfig.cmake" INSTALL_DESTINATION "${package}"
  PATH_VARS ALPENGLOW_SHARE_DIR)
write_basic_package_version_file("${PROJECT_BINARY_DIR}/AlpenglowConfigVersion.cmake"
                                 COMPATIBILITY SameMajorVersion)
install(FILES "${PROJECT_BINARY_DIR}/AlpenglowConfig.cmake"
              "${PROJECT_BINARY_DIR}/AlpenglowConfigVersion.cmake"
        DESTINATION "${package}")

# From the .pc file to the prefix, so that the whole may be moved.
file(RELATIVE_PATH ALPENGLOW_PC_PREFIX "/p/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/p")
string(REGEX REPLACE "/$" "" ALPENGLOW_PC_PREFIX "${ALPENGLOW_PC_PREFIX}")
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}" OR IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  message(WARNING "alpenglow.pc expects CMAKE_INSTALL_LIBDIR and CMAKE_INSTALL_INCLUDEDIR below the "
                  "prefix, and one of them is an absolute path.")
endif()
set(ALPENGLOW_PC_DEFINE "")
if(ALPENGLOW_SHARED)
  set(ALPENGLOW_PC_DEFINE " -DALPENGLOW_SHARED")
endif()
configure_file("${PROJECT_SOURCE_DIR}/cmake/alpenglow.pc.in" "${PROJECT_BINARY_DIR}/alpenglow.pc"
               @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/alpenglow.pc"
        DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
install(FILES "${PROJECT_SOURCE_DIR}/LICENSE" DESTINATION "${CMAKE_INSTALL_DOCDIR}")
