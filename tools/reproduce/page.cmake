# MORSEL_REPRODUCTION_STYLE: a source file with the style sheet of the page, what it shares with the page of a comparison
# first, as a string literal.
set(MORSEL_REPRODUCTION_STYLE ${PROJECT_BINARY_DIR}/generated/reproduction_style.cpp)
set(style_sheets ${CMAKE_CURRENT_LIST_DIR}/../html/page/style.css ${CMAKE_CURRENT_LIST_DIR}/page.css)
add_custom_command(
  OUTPUT ${MORSEL_REPRODUCTION_STYLE}
  COMMAND ${CMAKE_COMMAND} "-DSTYLES=${style_sheets}" -DOUTPUT=${MORSEL_REPRODUCTION_STYLE} -P
          ${CMAKE_CURRENT_LIST_DIR}/embed.cmake
  DEPENDS ${CMAKE_CURRENT_LIST_DIR}/embed.cmake ${style_sheets}
  VERBATIM)
