# Installs into a fresh prefix, builds outside projects against it and runs them. Those of examples/hosts are run by
# tests/program/test_hosts.py.
#   cmake -DBUILD=... -DWORK=... -DSOURCE=... -DHOSTS=... [-DMPIEXEC=...] [-DMAN=ON] -P check.cmake
cmake_policy(VERSION 3.25)
file(REMOVE_RECURSE ${WORK})
set(prefix ${WORK}/prefix)
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()
function(build project source)
  run(${CMAKE_COMMAND} -S ${source} -B ${WORK}/${project} -G Ninja -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Release)
  run(${CMAKE_COMMAND} --build ${WORK}/${project})
endfunction()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
run(${prefix}/bin/pounding --version)

foreach(project IN ITEMS laws_only newmark whole)
  build(${project} ${SOURCE}/${project})
  execute_process(COMMAND ${WORK}/${project}/${project} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
# Two processes, each with its own communicator and model.
if(MPIEXEC)
  execute_process(COMMAND ${MPIEXEC} -n 2 ${WORK}/whole/whole COMMAND_ERROR_IS_FATAL ANY)
endif()
build(hosts ${HOSTS})
# tests/program/test_cpp_lessons.py compares their numbers with their pages.
foreach(lesson IN ITEMS 15_your_own_law 16_model_in_cpp)
  build(${lesson} ${HOSTS}/../${lesson})
endforeach()

# With pkg-config only.
execute_process(COMMAND sh -ec "
    export PKG_CONFIG_PATH=$(dirname $(find '${prefix}' -name pounding-c.pc)):$PKG_CONFIG_PATH
    cc -std=c99 -pedantic -o by_pkg_config_in_c '${HOSTS}/c/two_oscillators.c' $(pkg-config --cflags --libs pounding-c) -lm
    export LD_LIBRARY_PATH=$(pkg-config --variable=libdir pounding-c):$LD_LIBRARY_PATH
    ./by_pkg_config_in_c 3000
    c++ -std=c++20 -o links_by_pkg_config '${SOURCE}/newmark/main.cpp' $(pkg-config --cflags --libs pounding-links)
    ./links_by_pkg_config
    c++ -std=c++20 -o by_pkg_config '${SOURCE}/whole/main.cpp' $(pkg-config --cflags --libs pounding)
    ./by_pkg_config"
  WORKING_DIRECTORY ${WORK} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

# The installed headers are those of the page in the guide, and include only installed ones.
file(GLOB_RECURSE headers RELATIVE ${prefix}/include ${prefix}/include/pounding/*.hpp)
file(STRINGS ${SOURCE}/../../python/docs/guide/headers.md listed REGEX "^\\| `pounding/")
list(TRANSFORM listed REPLACE "^[^`]*`([^`]*)`.*" "\\1")
list(SORT headers)
list(SORT listed)
if(NOT headers STREQUAL listed)
  message(FATAL_ERROR "installed are ${headers}, and the page lists ${listed}")
endif()
list(TRANSFORM headers REPLACE "(.+)" "#include <\\1>\n" OUTPUT_VARIABLE includes)
string(JOIN "" includes ${includes})
file(WRITE ${WORK}/all_headers.cpp "${includes}")
execute_process(COMMAND sh -ec "
    export PKG_CONFIG_PATH=$(dirname $(find '${prefix}' -name pounding.pc)):$PKG_CONFIG_PATH
    c++ -std=c++20 -fsyntax-only all_headers.cpp $(pkg-config --cflags pounding)"
  WORKING_DIRECTORY ${WORK} COMMAND_ERROR_IS_FATAL ANY)

# The installed program draws with the modules installed next to it.
file(WRITE ${WORK}/python "#!/bin/sh\nprintf %s \"$PYTHONPATH\" > ${WORK}/path\n")
file(CHMOD ${WORK}/python PERMISSIONS OWNER_READ OWNER_EXECUTE)
file(WRITE ${WORK}/results.h5 "")
execute_process(COMMAND ${CMAKE_COMMAND} -E env POUNDING_PYTHON=${WORK}/python PYTHONPATH=
  ${prefix}/bin/pounding export ${WORK}/results.h5 OUTPUT_QUIET)
file(READ ${WORK}/path path)
if(NOT path STREQUAL "${prefix}/share/pounding/python" OR NOT EXISTS ${path}/pounding/_export.py)
  message(FATAL_ERROR "the installed program looks for its modules in ${path}")
endif()

# Completion runs the program that it completes.
function(completes words expected)
  execute_process(COMMAND bash -c "
      source '${prefix}/share/bash-completion/completions/pounding'
      COMP_WORDS=(${words}) COMP_CWORD=$((\${#COMP_WORDS[@]} - 1))
      _pounding
      printf %s \"\${COMPREPLY[*]}\""
    OUTPUT_VARIABLE completed COMMAND_ERROR_IS_FATAL ANY)
  if(NOT completed STREQUAL expected)
    message(FATAL_ERROR "${words} is completed by \"${completed}\", not \"${expected}\"")
  endif()
endfunction()
set(program ${prefix}/bin/pounding)
completes("${program} cal" "calibrate")
completes("${program} run --js" "--json")
completes("${program} calibrate --law hertz_" "hertz_damped")
completes("${program} record s" "spectrum")

if(MAN AND NOT EXISTS ${prefix}/share/man/man1/pounding-run.1)
  message(FATAL_ERROR "there is no manual page of pounding run")
endif()
