# cmake -DSTYLES=FILE;FILE… -DOUTPUT=FILE.cpp -P embed.cmake: style sheets, one after the other, as a string literal.
set(text "")
foreach(file IN LISTS STYLES)
  file(READ ${file} part)
  string(APPEND text "${part}")
endforeach()
string(FIND "${text}" ")style\"" place)
if(NOT place EQUAL -1)
  message(FATAL_ERROR "a style sheet holds the end of its own literal")
endif()
file(WRITE ${OUTPUT} "#include \"morsel/tools/reproduce/page.h\"

namespace morsel::tools::reproduce {
const std::string_view kStyle = R\"style(${text})style\";
}  // namespace morsel::tools::reproduce
")
