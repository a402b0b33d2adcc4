# OpenVDB::openvdb, of version 10 or later. Used by this project and by the package that it installs.
#
# OpenVDB's own module lies where CMake does not look (lib/ARCHITECTURE/cmake/OpenVDB) and demands Boost's
# iostreams, which nothing done here needs; the package of Imath, whose library OpenVDB's headers are linked
# with, prints in Debian 12 that it is faulty where its Python module is not installed.
include(CMakeFindDependencyMacro)
find_path(OpenVDB_INCLUDE_DIR openvdb/openvdb.h)
find_library(OpenVDB_LIBRARY openvdb)
find_library(OpenVDB_IMATH_LIBRARY NAMES Imath Imath-3_1)
mark_as_advanced(OpenVDB_INCLUDE_DIR OpenVDB_LIBRARY OpenVDB_IMATH_LIBRARY)
if(OpenVDB_INCLUDE_DIR)
  file(STRINGS ${OpenVDB_INCLUDE_DIR}/openvdb/version.h lines
       REGEX "#define OPENVDB_LIBRARY_(MAJOR|MINOR|PATCH)_VERSION_NUMBER [0-9]")
  string(REGEX REPLACE "[^0-9]+([0-9]+)[^0-9]+([0-9]+)[^0-9]+([0-9]+).*" "\\1.\\2.\\3" OpenVDB_VERSION
    "${lines}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenVDB
  REQUIRED_VARS OpenVDB_LIBRARY OpenVDB_INCLUDE_DIR OpenVDB_IMATH_LIBRARY
  VERSION_VAR OpenVDB_VERSION)
if(OpenVDB_FOUND AND NOT TARGET OpenVDB::openvdb)
  find_dependency(TBB)
  find_dependency(Boost)
  add_library(OpenVDB::openvdb UNKNOWN IMPORTED)
  set_target_properties(OpenVDB::openvdb PROPERTIES IMPORTED_LOCATION ${OpenVDB_LIBRARY}
                        INTERFACE_INCLUDE_DIRECTORIES ${OpenVDB_INCLUDE_DIR}
                        INTERFACE_LINK_LIBRARIES "${OpenVDB_IMATH_LIBRARY};TBB::tbb;Boost::headers")
endif()
