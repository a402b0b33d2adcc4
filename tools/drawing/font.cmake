# MORSEL_FONT_SOURCE: a source file with the bytes of DejaVu Sans, so that pictures look the same wherever the
# program runs.
find_file(MORSEL_FONT DejaVuSans.ttf
          PATHS /usr/share/fonts/truetype/dejavu /usr/share/fonts/dejavu /usr/share/fonts/TTF
                /usr/local/share/fonts
          DOC "DejaVu Sans, which pictures are lettered in" REQUIRED)
set(MORSEL_FONT_SOURCE ${PROJECT_BINARY_DIR}/generated/font.cpp)
if(NOT EXISTS ${MORSEL_FONT_SOURCE} OR MORSEL_FONT IS_NEWER_THAN MORSEL_FONT_SOURCE
   OR CMAKE_CURRENT_LIST_FILE IS_NEWER_THAN MORSEL_FONT_SOURCE)
  # String literals, which compilers read a hundred times faster than lists of numbers; in pieces, as they
  # need not take literals of more than 65,536 bytes.
  file(READ ${MORSEL_FONT} bytes HEX)
  set(digits 32768)
  set(pieces "")
  while(NOT bytes STREQUAL "")
    string(LENGTH "${bytes}" length)
    if(length LESS digits)
      set(digits ${length})
    endif()
    string(SUBSTRING "${bytes}" 0 ${digits} piece)
    string(SUBSTRING "${bytes}" ${digits} -1 bytes)
    string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" piece "${piece}")
    math(EXPR size "${digits} / 2")
    string(APPEND pieces "    {\"${piece}\", ${size}},\n")
  endwhile()
  file(WRITE ${MORSEL_FONT_SOURCE}
       "#include \"morsel/tools/drawing/font.h\"\n\nnamespace morsel::tools::drawing {\n\n"
       "static constexpr std::string_view kPieces[] = {\n${pieces}};\n"
       "const std::span<const std::string_view> kFontPieces = kPieces;\n\n}\n")
endif()
