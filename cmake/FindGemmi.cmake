# Gemmi::headers: gemmi's C++ headers, which come without a CMake package, and PEGTL's, with which they read
# CIF.
find_path(Gemmi_INCLUDE_DIR gemmi/cif.hpp)
find_path(Gemmi_PEGTL_INCLUDE_DIR tao/pegtl.hpp)
mark_as_advanced(Gemmi_INCLUDE_DIR Gemmi_PEGTL_INCLUDE_DIR)
if(Gemmi_INCLUDE_DIR)
  file(STRINGS ${Gemmi_INCLUDE_DIR}/gemmi/version.hpp lines REGEX "#define GEMMI_VERSION \"")
  string(REGEX REPLACE ".*\"([0-9.]+).*" "\\1" Gemmi_VERSION "${lines}")
endif()
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Gemmi REQUIRED_VARS Gemmi_INCLUDE_DIR Gemmi_PEGTL_INCLUDE_DIR
  VERSION_VAR Gemmi_VERSION)
if(Gemmi_FOUND AND NOT TARGET Gemmi::headers)
  add_library(Gemmi::headers INTERFACE IMPORTED GLOBAL)
  target_include_directories(Gemmi::headers INTERFACE ${Gemmi_INCLUDE_DIR} ${Gemmi_PEGTL_INCLUDE_DIR})
endif()
