# acs_install_pkg_config(NAME [PUBLIC …] [PRIVATE …]): a file for pkg-config beside the library, from what the library links:
# acs_core becomes acs-core.pc. What a program must link is in Requires and Libs, with and without --static: for an archive all that
# it uses, for a shared library only what its headers use. The prefix is relative to the file: an installed tree can be moved.
function(acs_install_pkg_config name)
  cmake_parse_arguments(arg "" "" "PUBLIC;PRIVATE" ${ARGN})
  set(requires "")
  set(libs "")
  set(folders "")
  if(ACS_BUILD_SHARED)
    # So that the linker finds the libraries of the SDK that this one uses and its headers do not.
    foreach(link IN LISTS arg_PRIVATE)
      if(link MATCHES "^ACS::" AND TARGET ${link})
        get_target_property(type ${link} TYPE)
        if(type STREQUAL "SHARED_LIBRARY")
          set(libs "-Wl,-rpath-link,\${libdir}")
        endif()
      endif()
    endforeach()
    set(arg_PRIVATE "")
  endif()
  foreach(link IN LISTS arg_PUBLIC arg_PRIVATE)
    if(TARGET ${link})
      get_target_property(aliased ${link} ALIASED_TARGET)
      if(aliased)
        set(link ${aliased})
      endif()
    endif()
    if(link MATCHES "^\\$<BUILD_INTERFACE:")
      continue()
    elseif(link MATCHES "^acs_")
      string(REPLACE "_" "-" module "${link}")
      list(APPEND requires "${module} = ${PROJECT_VERSION}")
    elseif(link STREQUAL "fmt::fmt")
      list(APPEND requires "fmt >= 9")
    elseif(link STREQUAL "OpenSSL::SSL")
      list(APPEND requires openssl)
    elseif(link STREQUAL "Mosquitto::mosquitto")
      list(APPEND requires libmosquitto)
    elseif(link STREQUAL "PostgreSQL::PostgreSQL")
      # Not in Requires: what it links itself is in the shared library that Debian has beside the archive.
      list(APPEND libs -lpq)
    elseif(link STREQUAL "prometheus-cpp::core")
      list(APPEND requires prometheus-cpp-core)
    elseif(link MATCHES "^(spdlog|tomlplusplus)::")
      list(APPEND requires "${CMAKE_MATCH_1}")
    elseif(link STREQUAL "SQLiteCpp")
      # It has no file of its own on Debian.
      list(APPEND requires sqlite3)
      list(APPEND libs -lSQLiteCpp)
    elseif(link STREQUAL "Threads::Threads")
      list(APPEND libs -pthread)
    elseif(link MATCHES "^(Boost::headers|tl::expected)$")
      # Headers without a file of their own: their folder, unless the compiler searches there anyway.
      get_target_property(found ${link} INTERFACE_INCLUDE_DIRECTORIES)
      list(APPEND folders ${found})
    else()
      message(FATAL_ERROR "${name} links ${link}, for which cmake/AcsPkgConfig.cmake has no entry")
    endif()
  endforeach()
  set(includes "")
  foreach(folder IN LISTS folders)
    cmake_path(NORMAL_PATH folder)
    string(REGEX REPLACE "/$" "" folder "${folder}")
    if(NOT folder IN_LIST CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES)
      list(APPEND includes "-I${folder}")
    endif()
  endforeach()

  set(prefix "${CMAKE_INSTALL_PREFIX}")
  if(NOT IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}")
    file(RELATIVE_PATH up "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
    string(REGEX REPLACE "/$" "" up "${up}")
    set(prefix "\${pcfiledir}/${up}")
  endif()
  cmake_path(APPEND libraryFolder "\${prefix}" "${CMAKE_INSTALL_LIBDIR}")
  cmake_path(APPEND includeFolder "\${prefix}" "${CMAKE_INSTALL_INCLUDEDIR}")
  string(REPLACE "_" "-" module "${name}")
  list(JOIN requires ", " requires)
  list(JOIN libs " " libs)
  list(JOIN includes " " includes)
  file(CONFIGURE OUTPUT "${PROJECT_BINARY_DIR}/pkgconfig/${module}.pc" @ONLY CONTENT "prefix=@prefix@
libdir=@libraryFolder@
includedir=@includeFolder@

Name: @module@
Description: Library @name@ of the ACS SDK for automated material handling
Version: @PROJECT_VERSION@
Requires: @requires@
Libs: -L\${libdir} -l@name@ @libs@
Cflags: -I\${includedir} @includes@
")
  install(FILES "${PROJECT_BINARY_DIR}/pkgconfig/${module}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig")
endfunction()
