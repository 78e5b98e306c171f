# cmake --install gives a prefix from which find_package(burnish) works.
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY BURNISH_MODULES)
list(TRANSFORM modules PREPEND burnish_ OUTPUT_VARIABLE targets)

install(TARGETS ${targets} EXPORT burnishTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT burnishTargets NAMESPACE burnish:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/burnish)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/burnish DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.h")
list(TRANSFORM modules PREPEND burnish:: OUTPUT_VARIABLE BURNISH_TARGETS)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/burnishConfig.cmake.in
    ${PROJECT_BINARY_DIR}/burnishConfig.cmake
    INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/burnish)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/burnishConfigVersion.cmake
    COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/burnishConfig.cmake ${PROJECT_BINARY_DIR}/burnishConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/burnish)
