# acs_add_library(NAME acs_protocol EXPORT Protocol SOURCES … HEADERS … [PUBLIC ACS::Core] [PRIVATE …] [BASE_DIR dir])
# One static library: its public headers as a file set (installed, each compiled alone by
# all_verify_interface_header_sets), its export, and the warnings of this project at build time only.
function(acs_add_library)
  cmake_parse_arguments(arg "" "NAME;EXPORT;BASE_DIR" "SOURCES;HEADERS;PUBLIC;PRIVATE" ${ARGN})
  if(NOT arg_BASE_DIR)
    set(arg_BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}/include")
  endif()
  add_library(${arg_NAME} STATIC)
  add_library(ACS::${arg_EXPORT} ALIAS ${arg_NAME})
  target_sources(${arg_NAME} PRIVATE ${arg_SOURCES}
    PUBLIC FILE_SET HEADERS BASE_DIRS "${arg_BASE_DIR}" FILES ${arg_HEADERS})
  target_link_libraries(${arg_NAME} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:acs_warnings>)
  target_compile_features(${arg_NAME} PUBLIC cxx_std_20)
  set_target_properties(${arg_NAME} PROPERTIES EXPORT_NAME ${arg_EXPORT} CXX_EXTENSIONS OFF
    POSITION_INDEPENDENT_CODE ON VERIFY_INTERFACE_HEADER_SETS ON)
  if(ACS_INSTALL)
    install(TARGETS ${arg_NAME} EXPORT acs${arg_EXPORT}Targets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}"
      FILE_SET HEADERS DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}")
    install(EXPORT acs${arg_EXPORT}Targets NAMESPACE ACS:: DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/acs")
    acs_install_pkg_config(${arg_NAME} ${arg_PUBLIC} ${arg_PRIVATE})
  endif()
endfunction()

# acs_add_internal_library(NAME acs_json EXPORT Json … [BASE_DIR dir]): archive installed and exported because static libraries link
# it, headers never.
function(acs_add_internal_library)
  cmake_parse_arguments(arg "" "NAME;EXPORT;BASE_DIR" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  if(NOT arg_BASE_DIR)
    set(arg_BASE_DIR "${CMAKE_CURRENT_SOURCE_DIR}/include")
  endif()
  add_library(${arg_NAME} STATIC ${arg_SOURCES})
  add_library(ACS::${arg_EXPORT} ALIAS ${arg_NAME})
  target_include_directories(${arg_NAME} PUBLIC $<BUILD_INTERFACE:${arg_BASE_DIR}>)
  target_link_libraries(${arg_NAME} PUBLIC ${arg_PUBLIC} PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:acs_warnings>)
  target_compile_features(${arg_NAME} PUBLIC cxx_std_20)
  set_target_properties(${arg_NAME} PROPERTIES EXPORT_NAME ${arg_EXPORT} POSITION_INDEPENDENT_CODE ON)
  if(ACS_INSTALL)
    install(TARGETS ${arg_NAME} EXPORT acs${arg_EXPORT}Targets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}")
    install(EXPORT acs${arg_EXPORT}Targets NAMESPACE ACS:: DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/acs")
    acs_install_pkg_config(${arg_NAME} ${arg_PUBLIC} ${arg_PRIVATE})
  endif()
endfunction()

# acs_add_program(NAME acsd SOURCES … LINK …): a thin program over its own library.
function(acs_add_program)
  cmake_parse_arguments(arg "" "NAME" "SOURCES;LINK" ${ARGN})
  add_executable(${arg_NAME} ${arg_SOURCES})
  target_link_libraries(${arg_NAME} PRIVATE ${arg_LINK} acs_warnings)
  acs_harden_program(${arg_NAME})
  if(ACS_INSTALL)
    install(TARGETS ${arg_NAME} RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}")
  endif()
endfunction()
