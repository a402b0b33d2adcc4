# Installation and the CMake package: find_package(morsel) gives morsel::core, morsel::morse, …
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY MORSEL_MODULES)
foreach(module IN LISTS modules)
  install(TARGETS morsel_${module} EXPORT morselTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${module} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/morsel
          FILES_MATCHING PATTERN "*.h")
endforeach()
install(EXPORT morselTargets NAMESPACE morsel:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/morsel)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/morselConfig.cmake.in ${PROJECT_BINARY_DIR}/morselConfig.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/morsel)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/morselConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/morselConfig.cmake ${PROJECT_BINARY_DIR}/morselConfigVersion.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/morsel)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
