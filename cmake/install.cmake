# Installation, in two components, and the CMake package: find_package(morsel) gives morsel::core,
# morsel::morse, …
#   runtime      the program, its man pages, completions and schemas
#   development  libraries, headers, CMake package, pkg-config files
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/morsel)
get_property(modules GLOBAL PROPERTY MORSEL_MODULES)

# What find_package(morsel) must find first, module by module: the packages of all that consumers are linked
# with. The targets are named PACKAGE::TARGET, or morsel::MODULE.
set(needs "")
foreach(module IN LISTS modules)
  install(TARGETS morsel_${module} EXPORT morselTargets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  get_property(linked GLOBAL PROPERTY MORSEL_LINKED_${module})
  set(packages ${linked})
  list(FILTER packages EXCLUDE REGEX "^morsel::")
  list(TRANSFORM packages REPLACE "::.*" "")
  list(REMOVE_DUPLICATES packages)
  list(FILTER linked INCLUDE REGEX "^morsel::")
  list(TRANSFORM linked REPLACE "^morsel::" "")
  string(APPEND needs
    "set(_morsel_${module}_packages ${packages})\nset(_morsel_${module}_modules ${linked})\n")
endforeach()

install(EXPORT morselTargets NAMESPACE morsel:: DESTINATION ${package_folder} COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/morselConfig.cmake.in
  ${PROJECT_BINARY_DIR}/morselConfig.cmake
                              INSTALL_DESTINATION ${package_folder} NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/morselConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/morselConfig.cmake ${PROJECT_BINARY_DIR}/morselConfigVersion.cmake
              ${CMAKE_CURRENT_LIST_DIR}/FindCairo.cmake ${CMAKE_CURRENT_LIST_DIR}/FindOpenVDB.cmake
        DESTINATION ${package_folder} COMPONENT development)

# pkg-config, of what find_package(morsel) finds by default: morsel-core, morsel-morse, … The files may be
# moved with what they name.
file(RELATIVE_PATH prefix_from_here /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" prefix_from_here "${prefix_from_here}")
foreach(module core persistence morse mscomplex study)
  get_property(linked GLOBAL PROPERTY MORSEL_LINKED_${module})
  set(requires "")
  foreach(target IN LISTS linked)
    if(target MATCHES "^morsel::(.*)")
      list(APPEND requires morsel-${CMAKE_MATCH_1})
    elseif(target MATCHES "^Eigen3::")
      list(APPEND requires "eigen3 >= 3.4")
    elseif(target MATCHES "^TBB::")
      list(APPEND requires tbb)
    elseif(target MATCHES "^ZLIB::")
      list(APPEND requires zlib)
    elseif(target MATCHES "^pugixml::")
      list(APPEND requires pugixml)
    elseif(target MATCHES "^LibLZMA::")
      list(APPEND requires liblzma)
    elseif(target MATCHES "^zstd::")
      list(APPEND requires libzstd)
    elseif(target MATCHES "^GDAL::")
      list(APPEND requires gdal)
    endif()
  endforeach()
  list(JOIN requires ", " requires)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/module.pc.in ${PROJECT_BINARY_DIR}/morsel-${module}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/morsel-${module}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
    COMPONENT development)
endforeach()

set(pages_folder ${CMAKE_INSTALL_DATADIR}/doc/morsel)
set(schema_folder "")
if(MORSEL_BUILD_TOOLS)
  set(schema_folder ${CMAKE_INSTALL_DATADIR}/morsel)
endif()
install(CODE "
  set(SOURCE \"${PROJECT_SOURCE_DIR}\")
  set(BINARY \"${PROJECT_BINARY_DIR}\")
  set(PAGES_FOLDER \"${pages_folder}\")
  set(SCHEMA_FOLDER \"${schema_folder}\")" COMPONENT runtime)
install(SCRIPT ${CMAKE_CURRENT_LIST_DIR}/install_pages.cmake COMPONENT runtime)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${pages_folder} COMPONENT runtime)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/libmorsel-dev
  COMPONENT development)
