# MORSEL_PAGE_SOURCE: a source file with the sources of the page, three.js among them, as string literals. A
# release of which every line of the page was tried out: later ones change the names of what it uses, and come
# as modules, which a page may not load from a file.
find_file(MORSEL_THREE_JS three.min.js PATHS /usr/share/javascript/three NO_DEFAULT_PATH REQUIRED)
file(STRINGS ${MORSEL_THREE_JS} three_revision REGEX "REVISION=\"111\"" LIMIT_COUNT 1)
if(NOT three_revision)
  message(FATAL_ERROR "${MORSEL_THREE_JS} is not release 111 of three.js")
endif()
file(GLOB page_sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_LIST_DIR}/page/*)
set(MORSEL_PAGE_SOURCE ${PROJECT_BINARY_DIR}/generated/page_sources.cpp)
morsel_embed(
  OUTPUT ${MORSEL_PAGE_SOURCE}
  HEADER morsel/tools/html/page_sources.h
  NAMESPACE morsel::tools::html
  LITERALS kPage=page/page.html kThree=${MORSEL_THREE_JS}
  DEPENDS ${page_sources})
