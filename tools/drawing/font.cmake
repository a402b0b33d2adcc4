# MORSEL_FONT_SOURCE: a source file with the bytes of DejaVu Sans, so that pictures look the same wherever the
# program runs.
find_file(MORSEL_FONT DejaVuSans.ttf
          PATHS /usr/share/fonts/truetype/dejavu /usr/share/fonts/dejavu /usr/share/fonts/TTF
                /usr/local/share/fonts
          DOC "DejaVu Sans, which pictures are lettered in" REQUIRED)
set(MORSEL_FONT_SOURCE ${PROJECT_BINARY_DIR}/generated/font.cpp)
if(NOT EXISTS ${MORSEL_FONT_SOURCE} OR MORSEL_FONT IS_NEWER_THAN MORSEL_FONT_SOURCE
   OR CMAKE_CURRENT_LIST_FILE IS_NEWER_THAN MORSEL_FONT_SOURCE)
  file(SIZE ${MORSEL_FONT} size)
  file(READ ${MORSEL_FONT} bytes HEX)
  # String literals, which compilers read a hundred times faster than lists of numbers; of pieces, as \x would
  # go on.
  string(REGEX REPLACE "([0-9a-f][0-9a-f])" "\\\\x\\1" bytes "${bytes}")
  file(WRITE ${MORSEL_FONT_SOURCE}
       "#include \"morsel/tools/drawing/font.h\"\n\nnamespace morsel::tools::drawing {\n\n"
       "const char* const kFontBytes = \"${bytes}\";\nconst std::size_t kFontSize = ${size};\n\n}\n")
endif()
