# TinyGLTF::headers: the headers of tinygltf, of which core compiles its own copy without pictures and files,
# and of nlohmann/json, which that includes. Debian's package of CMake has its shared library instead.
find_path(TinyGLTF_INCLUDE_DIR tiny_gltf.h)
find_path(TinyGLTF_JSON_INCLUDE_DIR nlohmann/json.hpp)
mark_as_advanced(TinyGLTF_INCLUDE_DIR TinyGLTF_JSON_INCLUDE_DIR)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(TinyGLTF REQUIRED_VARS TinyGLTF_INCLUDE_DIR TinyGLTF_JSON_INCLUDE_DIR)
if(TinyGLTF_FOUND AND NOT TARGET TinyGLTF::headers)
  add_library(TinyGLTF::headers INTERFACE IMPORTED GLOBAL)
  target_include_directories(TinyGLTF::headers INTERFACE ${TinyGLTF_INCLUDE_DIR} ${TinyGLTF_JSON_INCLUDE_DIR})
endif()
