# OpenImageIO, for our build and for users of the installed package, who have found it by then.

if(NOT TARGET OpenImageIO::OpenImageIO)
  find_package(OpenImageIO QUIET)
endif()
if(NOT TARGET OpenImageIO::OpenImageIO)
  message(FATAL_ERROR "Alpenglow::io reads and writes pictures with OpenImageIO, which was not found "
                      "(Debian: libopenimageio-dev); ALPENGLOW_BUILD_IO=OFF builds without io.")
endif()

# Debian's target names include folders of packages that it doesn't depend on (opencv4), and CMake
# refuses a target with a missing folder; so those go.
foreach(target OpenImageIO::OpenImageIO OpenImageIO::OpenImageIO_Util)
  if(TARGET ${target})
    get_target_property(folders ${target} INTERFACE_INCLUDE_DIRECTORIES)
    set(present "")
    foreach(folder IN LISTS folders)
      if(IS_DIRECTORY "${folder}")
        list(APPEND present "${folder}")
      endif()
    endforeach()
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${present}")
  endif()
endforeach()
