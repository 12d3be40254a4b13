# ACS_BUILD_SHARED: the libraries as shared libraries. acs_make_shared(NAME): exports what ACS_API marks and nothing else, neither
# internal classes nor what third parties bring; every symbol that it needs is linked.
option(ACS_BUILD_SHARED "Build shared libraries instead of static ones; the tests need static ones" ${BUILD_SHARED_LIBS})

# Before 1.0 each minor version may break a user's code, so each has a soversion of its own.
set(ACS_SOVERSION "${PROJECT_VERSION_MAJOR}")
if(PROJECT_VERSION_MAJOR EQUAL 0)
  set(ACS_SOVERSION "0.${PROJECT_VERSION_MINOR}")
endif()

if(ACS_BUILD_SHARED)
  configure_file("${CMAKE_CURRENT_LIST_DIR}/acs.map.in" "${PROJECT_BINARY_DIR}/acs.map" @ONLY)
  # Tests, benchmarks and fuzzers use classes that a shared library does not export.
  foreach(kind IN ITEMS TESTS BENCHMARKS FUZZERS)
    if(ACS_BUILD_${kind})
      message(STATUS "ACS_BUILD_${kind} is ignored: with ACS_BUILD_SHARED the classes that they use are hidden")
      set(ACS_BUILD_${kind} OFF)
    endif()
  endforeach()
endif()

# The dynamic linker searches /usr and /usr/local. What is installed elsewhere has a run path to its libraries.
function(acs_set_run_path target)
  if(ACS_BUILD_SHARED AND ACS_INSTALL AND NOT DEFINED CMAKE_INSTALL_RPATH AND
      NOT CMAKE_INSTALL_PREFIX MATCHES "^/(usr(/local)?/?)?$")
    set_target_properties(${target} PROPERTIES INSTALL_RPATH "${CMAKE_INSTALL_FULL_LIBDIR}")
  endif()
endfunction()

# For all that a shared library is made of.
function(acs_hide_symbols target)
  if(ACS_BUILD_SHARED)
    set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  endif()
endfunction()

function(acs_make_shared target)
  set_target_properties(${target} PROPERTIES VERSION "${PROJECT_VERSION}" SOVERSION "${ACS_SOVERSION}"
    LINK_DEPENDS "${PROJECT_BINARY_DIR}/acs.map")
  target_link_options(${target} PRIVATE "LINKER:--version-script=${PROJECT_BINARY_DIR}/acs.map")
  # The sanitizers leave symbols to the program.
  if(NOT ACS_SANITIZE)
    target_link_options(${target} PRIVATE "LINKER:-z,defs")
  endif()
  acs_harden_program(${target})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  acs_set_run_path(${target})
endfunction()
