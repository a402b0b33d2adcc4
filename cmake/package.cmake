# Debian packages by CPack, one of each component of the installation: tools/package makes them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the morsel project <morsel@localhost>")
set(CPACK_DEBIAN_PACKAGE_MAINTAINER ${CPACK_PACKAGE_CONTACT})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL runtime development)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME morsel)
set(CPACK_DEBIAN_RUNTIME_PACKAGE_SHLIBDEPS ON)
set(CPACK_COMPONENT_RUNTIME_DESCRIPTION
    "critical points of scalar fields on triangle meshes
The program morsel extracts critical points by several methods compared with each other, and builds
persistence diagrams, Morse-Smale complexes, hierarchies, segments, cuts and quads on them.")

# What its headers and libraries are used with.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libmorsel-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev, libtbb-dev, libboost-dev, zlib1g-dev, liblzma-dev, libzstd-dev, libpugixml-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SUGGESTS
    "nlohmann-json3-dev, libssl-dev, libopenvdb-dev, libembree-dev, libpng-dev, libcairo2-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "critical points of scalar fields on triangle meshes (development)
The C++20 library of the program morsel: static libraries, headers, the CMake package and pkg-config files.
The components of documents, pictures and molecules need the suggested packages, what find_package(morsel)
finds by default does not.")

if(MORSEL_BUILD_PYTHON)
  list(APPEND CPACK_COMPONENTS_ALL python)
  # It is built for one version of Python.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-morsel)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
      "python3 (>= ${MORSEL_PYTHON_VERSION}), python3 (<< ${MORSEL_PYTHON_NEXT_VERSION}), python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS
      "python3-matplotlib, python3-pandas, python3-networkx, python3-vtk9, jupyter-notebook")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA
      ${CMAKE_CURRENT_LIST_DIR}/python/postinst ${CMAKE_CURRENT_LIST_DIR}/python/prerm)
  set(CPACK_COMPONENT_PYTHON_DESCRIPTION
      "critical points of scalar fields on triangle meshes (Python)
The package morsel for numpy: Morse functions, methods, critical points, persistence diagrams, Morse-Smale
complexes, segments, comparisons of methods, and reports.")
endif()
include(CPack)
