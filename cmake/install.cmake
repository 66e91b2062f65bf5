# Installs library, headers and what find_package(facemap) reads.
include(CMakePackageConfigHelpers)
set(FACEMAP_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/facemap)

install(TARGETS facemap EXPORT facemap-targets)
install(DIRECTORY include/facemap DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT facemap-targets NAMESPACE facemap:: DESTINATION ${FACEMAP_PACKAGE_DIR})

configure_package_config_file(cmake/facemap-config.cmake.in ${PROJECT_BINARY_DIR}/facemap-config.cmake
                              INSTALL_DESTINATION ${FACEMAP_PACKAGE_DIR})
# Until 1.0 a new minor version may change what a program sees.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/facemap-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/facemap-config.cmake ${PROJECT_BINARY_DIR}/facemap-config-version.cmake
              cmake/FindGMP.cmake
        DESTINATION ${FACEMAP_PACKAGE_DIR})
