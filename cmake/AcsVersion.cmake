# project() and acs/core/Version.hpp state the version. The header is not generated, so that the sources can be used without
# CMake; a difference between the two ends the configuration.
set(header "${PROJECT_SOURCE_DIR}/libacs-core/include/acs/core/Version.hpp")
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${header}")
file(READ "${header}" text)
foreach(expected IN ITEMS
    "#define ACS_VERSION_MAJOR ${PROJECT_VERSION_MAJOR}\n" "#define ACS_VERSION_MINOR ${PROJECT_VERSION_MINOR}\n"
    "#define ACS_VERSION_PATCH ${PROJECT_VERSION_PATCH}\n" "SDK_VERSION = \"${PROJECT_VERSION}\"")
  string(FIND "${text}" "${expected}" place)
  if(place EQUAL -1)
    message(FATAL_ERROR "project() has version ${PROJECT_VERSION}, but ${header} has no '${expected}': correct one of them")
  endif()
endforeach()
