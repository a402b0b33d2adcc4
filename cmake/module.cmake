# What every target of this project is compiled with. g++ 12 has false reports on the concatenation of
# strings, which precompiled headers no longer hide as a system header's.
set(MORSEL_WARNINGS -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  list(APPEND MORSEL_WARNINGS -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds)
endif()

# Parts that an option MORSEL_WITH_PART leaves out, with the packages that they need.
set(MORSEL_PARTS FORMATS GEOTIFF MOLECULES PICTURES)

# morsel_add_module(NAME [WITHIN FOLDER] [PROGRAM] PUBLIC_HEADERS … SOURCES … DEPENDS …
#                   PRIVATE_DEPENDS … PRECOMPILED …
#                   [PART_SOURCES … PART_DEPENDS … [PART_REPLACEMENT SOURCE]]…)
# The library target morsel_NAME, alias morsel::NAME, whose headers are included as "morsel/NAME/….h", or as
# "morsel/FOLDER/NAME/….h" if it is a room of that folder, in the build tree and after installation alike.
#   PROGRAM          it serves the program alone and is not installed
#   PUBLIC_HEADERS   what users of the installed library may include. They include public headers only, which
#                    tests/layers checks; all other headers are private: they are not installed
#   DEPENDS          what its headers include or what it is linked with: consumers of the installed
#                    package get these too
#   PRIVATE_DEPENDS  what only its sources include; of these, consumers need those that are more than headers
#   PRECOMPILED      headers that most of its sources read, or the module whose precompiled headers it
#                    shares. Sources include what they use all the same: tools/lint compiles them without
#                    precompiled headers and one by one.
#   PART_SOURCES     PART is one of MORSEL_PARTS. With MORSEL_WITH_PART it has these, which need the packages
#                    PART_DEPENDS privately; without, in their place, PART_REPLACEMENT (without_part.cpp if
#                    not given), which defines the same functions
function(morsel_add_module name)
  set(lists PUBLIC_HEADERS SOURCES DEPENDS PRIVATE_DEPENDS PRECOMPILED)
  foreach(part IN LISTS MORSEL_PARTS)
    list(APPEND lists ${part}_SOURCES ${part}_DEPENDS)
  endforeach()
  list(TRANSFORM MORSEL_PARTS APPEND _REPLACEMENT OUTPUT_VARIABLE replacements)
  cmake_parse_arguments(PARSE_ARGV 1 arg "PROGRAM" "WITHIN;${replacements}" "${lists}")
  foreach(part IN LISTS MORSEL_PARTS)
    if(NOT arg_${part}_SOURCES)
      continue()
    elseif(MORSEL_WITH_${part})
      list(APPEND arg_SOURCES ${arg_${part}_SOURCES})
      list(APPEND arg_PRIVATE_DEPENDS ${arg_${part}_DEPENDS})
      # Files of their own in the library, for which tests/cli links the replacement.
      set_source_files_properties(${arg_${part}_SOURCES} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    elseif(arg_${part}_REPLACEMENT)
      list(APPEND arg_SOURCES ${arg_${part}_REPLACEMENT})
    else()
      string(TOLOWER without_${part}.cpp replacement)
      list(APPEND arg_SOURCES ${replacement})
    endif()
  endforeach()
  set(target morsel_${name})
  set(outer ${name})
  set(folder ${name})
  if(arg_WITHIN)
    set(outer ${arg_WITHIN})
    set(folder ${arg_WITHIN}/${name})
  endif()
  add_library(${target} STATIC ${arg_SOURCES})
  add_library(morsel::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)

  # A link per module, not one to the whole tree, which would contain the build folder again.
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/include/morsel)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${outer} ${PROJECT_BINARY_DIR}/include/morsel/${outer} SYMBOLIC)
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include>
                                              $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_compile_features(${target} PUBLIC cxx_std_20)
  # The same expression gives the same bits with every compiler and processor: no fused multiply-adds of its
  # choosing.
  target_compile_options(${target} PRIVATE ${MORSEL_WARNINGS} -ffp-contract=off)
  target_link_libraries(${target} PUBLIC ${arg_DEPENDS})
  set(linked ${arg_DEPENDS})
  foreach(dependency IN LISTS arg_PRIVATE_DEPENDS)
    get_target_property(type ${dependency} TYPE)
    if(type STREQUAL INTERFACE_LIBRARY)  # headers: nothing of it is left in the library
      target_link_libraries(${target} PRIVATE $<BUILD_INTERFACE:${dependency}>)
    else()
      target_link_libraries(${target} PRIVATE ${dependency})
      list(APPEND linked ${dependency})
    endif()
  endforeach()
  if(TARGET "${arg_PRECOMPILED}")
    get_target_property(module ${arg_PRECOMPILED} ALIASED_TARGET)
    target_precompile_headers(${target} REUSE_FROM ${module})
  elseif(arg_PRECOMPILED)
    target_precompile_headers(${target} PRIVATE ${arg_PRECOMPILED})
  endif()
  if(arg_PROGRAM)
    return()
  endif()
  foreach(header IN LISTS arg_PUBLIC_HEADERS)
    cmake_path(GET header PARENT_PATH room)
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/morsel/${folder}/${room}
            COMPONENT development)
  endforeach()
  morsel_export(${name} ${linked})
endfunction()

# morsel_export(NAME LINKED…): the target morsel_NAME is installed, and part of the package, with what it is
# linked with.
function(morsel_export name)
  set_property(GLOBAL APPEND PROPERTY MORSEL_MODULES ${name})
  set_property(GLOBAL PROPERTY MORSEL_LINKED_${name} ${ARGN})
endfunction()
