# The C++ libraries as shared ones, linked from the position-independent objects of the build. Installed, they run the
# program with bitwise identical results, serve an outside project, and export only our names.
#   cmake -DBUILD=... -DWORK=... -DROOT=... -DSOURCE=... "-DSAME=compilers and flags of the build" -P shared.cmake
file(REMOVE_RECURSE ${WORK})
set(prefix ${WORK}/prefix)
set(ENV{POUNDING_OBJECTS} ${BUILD})
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()

set(launcher ${SOURCE}/take_object.sh)
run(${CMAKE_COMMAND} -S ${ROOT} -B ${WORK}/build -G Ninja ${SAME} -DBUILD_SHARED_LIBS=ON -DPOUNDING_BUILD_TESTS=OFF
  -DPOUNDING_PYTHON=OFF -DCMAKE_C_COMPILER_LAUNCHER=${launcher} -DCMAKE_CXX_COMPILER_LAUNCHER=${launcher})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${CMAKE_COMMAND} --install ${WORK}/build --prefix ${prefix})

file(GLOB_RECURSE archives ${prefix}/*/libpounding_*.a)
list(FILTER archives EXCLUDE REGEX "libpounding_fortran\\.a$")
if(archives)
  message(FATAL_ERROR "not shared: ${archives}")
endif()

# The results of the program without its wall time.
function(links_of program result)
  execute_process(COMMAND ${program} run ${ROOT}/examples/02_two_oscillators/model.yaml --json
    OUTPUT_VARIABLE summary COMMAND_ERROR_IS_FATAL ANY)
  string(JSON links GET "${summary}" links)
  string(JSON structures GET "${summary}" structures)
  set(${result} "${links}${structures}" PARENT_SCOPE)
endfunction()
links_of(${prefix}/bin/pounding shared)
links_of(${BUILD}/pounding static)
if(NOT shared STREQUAL static)
  message(FATAL_ERROR "with shared libraries the program gives\n${shared}\nnot\n${static}")
endif()

run(${CMAKE_COMMAND} -S ${SOURCE}/whole -B ${WORK}/whole -G Ninja -DCMAKE_PREFIX_PATH=${prefix} ${SAME})
run(${CMAKE_COMMAND} --build ${WORK}/whole)
run(${WORK}/whole/whole)

file(GLOB_RECURSE libraries ${prefix}/*/libpounding_*.so)
list(FILTER libraries EXCLUDE REGEX "libpounding_c\\.so$")
list(LENGTH libraries count)
if(NOT count EQUAL 3)
  message(FATAL_ERROR "three libraries expected: ${libraries}")
endif()
foreach(library IN LISTS libraries)
  execute_process(COMMAND nm --dynamic --defined-only --demangle ${library} OUTPUT_VARIABLE names COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "[^\n]+" names "${names}")
  list(FILTER names EXCLUDE REGEX "pounding::")
  if(names)
    list(GET names 0 first)
    message(FATAL_ERROR "${library} shows ${first}")
  endif()
endforeach()
