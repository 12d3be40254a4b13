# The package file: find_package(acs COMPONENTS Core Protocol …). Each component asks for its own dependencies only.
include(CMakePackageConfigHelpers)
configure_package_config_file("${CMAKE_CURRENT_LIST_DIR}/acsConfig.cmake.in" "${PROJECT_BINARY_DIR}/acsConfig.cmake"
  INSTALL_DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/acs")
write_basic_package_version_file("${PROJECT_BINARY_DIR}/acsConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${PROJECT_BINARY_DIR}/acsConfig.cmake" "${PROJECT_BINARY_DIR}/acsConfigVersion.cmake"
  "${CMAKE_CURRENT_LIST_DIR}/FindMosquitto.cmake" DESTINATION "${CMAKE_INSTALL_LIBDIR}/cmake/acs")
