# cmake -DSETTINGS=… -DGENERATOR=… -DSOURCE=… -DBUILD=… -DWORK=… -DMESH=lion-head.off -DPYTHON=… -P run.cmake:
# installs BUILD and uses what was installed.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(JOIN " " command ${ARGN})
    message(FATAL_ERROR "${command}\nended with ${result}:\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(configure_project name)
  run(${CMAKE_COMMAND} -G ${GENERATOR} -C ${SETTINGS} -S ${SOURCE}/tests/consumer/${name} -B ${WORK}/${name}
      -DCMAKE_PREFIX_PATH=${WORK}/moved)
endfunction()

# Moved after installation: the package must not depend on its place.
file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
file(RENAME ${WORK}/prefix ${WORK}/moved)
file(GLOB_RECURSE package_files ${WORK}/moved/*.cmake)
foreach(file IN LISTS package_files)
  file(READ ${file} text)
  foreach(folder IN ITEMS ${SOURCE} ${BUILD} ${WORK})
    string(FIND "${text}" "${folder}/" place)
    if(NOT place EQUAL -1)
      message(FATAL_ERROR "${file} names the folder ${folder}")
    endif()
  endforeach()
endforeach()

# Pages, pictures and schemas are read where they were installed.
run(${PYTHON} -B ${SOURCE}/tests/consumer/check_links.py ${WORK}/moved/share/doc/morsel)

configure_project(package)

run(${CMAKE_COMMAND} --build ${WORK}/package)

configure_project(example)
run(${CMAKE_COMMAND} --build ${WORK}/example)
run(${WORK}/example/example ${MESH})
message(STATUS "the example printed:\n${output}")
if(NOT output MATCHES "^1895 critical points.*\n97 critical points")
  message(FATAL_ERROR "the example is to print 1895 and 97 critical points")
endif()

configure_project(study)
run(${CMAKE_COMMAND} --build ${WORK}/study)
file(WRITE ${WORK}/factor.txt "2\n")
run(${WORK}/study/study ${MESH} ${WORK}/factor.txt ${WORK}/report.json)
if(NOT output STREQUAL "bend\nconventional: 1895\nsalient: 97\nten-times: 97\n")
  message(FATAL_ERROR "the study is to print 1895, 97 and 97 critical points:\n${output}")
endif()
file(READ ${WORK}/report.json report)
file(SHA256 ${WORK}/factor.txt factor_hash)
foreach(expected IN ITEMS "field name bend" "field parameters factor_sha256 ${factor_hash}"
                          "methods 2 name ten-times" "methods 2 critical_points total 97")
  string(REPLACE " " ";" path "${expected}")
  list(POP_BACK path value)
  string(JSON found GET "${report}" ${path})
  if(NOT found STREQUAL value)
    message(FATAL_ERROR "the report is to have ${value}, not ${found}, at ${path}")
  endif()
endforeach()

# The installed program works, too.
if(EXISTS ${WORK}/moved/bin/morsel)
  run(${WORK}/moved/bin/morsel info ${MESH})
endif()

# The README shows the same example.
file(READ ${SOURCE}/tests/consumer/example/main.cpp example)
file(READ ${SOURCE}/README.md readme)
string(FIND "${readme}" "```cpp\n${example}```" place)
if(place EQUAL -1)
  message(FATAL_ERROR "README.md does not show tests/consumer/example/main.cpp as it is")
endif()
