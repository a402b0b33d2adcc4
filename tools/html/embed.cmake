# Texts that the program holds: style sheets, scripts, pages.
#
# morsel_embed(OUTPUT FILE.cpp HEADER NAME.h NAMESPACE NAMESPACE LITERALS NAME=FILE[,FILE…]… [DEPENDS FILE…]):
# makes FILE.cpp, which defines each NAME (that HEADER declares as an EmbeddedText, formats/embedded_text.h)
# as the texts of its files one after the other. Where a text has EMBED(FILE FILE…), these files, which are
# beside it, are put there; DEPENDS names them.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(MORSEL_EMBED ${CMAKE_CURRENT_LIST_FILE})
  function(morsel_embed)
    cmake_parse_arguments(PARSE_ARGV 0 asked "" "OUTPUT;HEADER;NAMESPACE" "LITERALS;DEPENDS")
    string(REGEX REPLACE "[^;=]*=|," ";" files "${asked_LITERALS}")
    list(REMOVE_ITEM files "")
    add_custom_command(
      OUTPUT ${asked_OUTPUT}
      COMMAND ${CMAKE_COMMAND} -DFOLDER=${CMAKE_CURRENT_SOURCE_DIR} "-DLITERALS=${asked_LITERALS}"
              -DHEADER=${asked_HEADER} -DNAMESPACE=${asked_NAMESPACE} -DOUTPUT=${asked_OUTPUT}
              -P ${MORSEL_EMBED}
      DEPENDS ${MORSEL_EMBED} ${files} ${asked_DEPENDS}
      VERBATIM)
  endfunction()
  return()
endif()

set(most 60000)
set(source "#include \"${HEADER}\"\n\nnamespace ${NAMESPACE} {\n\n"
    "using namespace std::string_view_literals;\n\n")
foreach(literal IN LISTS LITERALS)
  string(REGEX MATCH "^([^=]*)=(.*)$" parts "${literal}")
  set(name ${CMAKE_MATCH_1})
  string(REPLACE "," ";" files "${CMAKE_MATCH_2}")
  set(text "")
  foreach(file IN LISTS files)
    get_filename_component(file ${file} ABSOLUTE BASE_DIR ${FOLDER})
    get_filename_component(beside ${file} DIRECTORY)
    file(READ ${file} part)
    while(part MATCHES "EMBED\\(([^)]*)\\)")
      set(place "${CMAKE_MATCH_0}")
      string(REGEX REPLACE "[ \n]+" ";" embedded "${CMAKE_MATCH_1}")
      set(inner "")
      foreach(one IN LISTS embedded)
        file(READ ${beside}/${one} text_of_one)
        string(APPEND inner "${text_of_one}\n")
      endforeach()
      string(REPLACE "${place}" "${inner}" part "${part}")
    endwhile()
    string(APPEND text "${part}")
  endforeach()
  string(FIND "${text}" ")text\"" place)
  if(NOT place EQUAL -1)
    message(FATAL_ERROR "${name} holds the end of its own literal")
  endif()
  # In pieces: compilers need not take literals of more than 65,536 bytes. Each but the last ends with a line,
  # or where there are no lines with a semicolon.
  set(pieces "")
  string(LENGTH "${text}" length)
  while(length GREATER ${most})
    string(SUBSTRING "${text}" 0 ${most} piece)
    string(FIND "${piece}" "\n" end REVERSE)
    if(end EQUAL -1)
      string(FIND "${piece}" ";" end REVERSE)
    endif()
    if(end EQUAL -1)
      message(FATAL_ERROR "${name} has no place where it could be cut in ${most} bytes")
    endif()
    math(EXPR end "${end} + 1")
    string(SUBSTRING "${text}" 0 ${end} piece)
    string(SUBSTRING "${text}" ${end} -1 text)
    string(APPEND pieces "R\"text(${piece})text\"sv,\n")
    string(LENGTH "${text}" length)
  endwhile()
  string(APPEND pieces "R\"text(${text})text\"sv")
  string(APPEND source "static constexpr std::string_view ${name}Pieces[] = {${pieces}};\n"
                       "const EmbeddedText ${name} = ${name}Pieces;\n")
endforeach()
file(WRITE ${OUTPUT} "${source}}  // namespace ${NAMESPACE}\n")
