# Installs into a fresh prefix and builds two outside projects against it.
#   cmake -DBUILD=... -DWORK=... -DSOURCE=... -P check.cmake
file(REMOVE_RECURSE ${WORK})
function(run)
  execute_process(COMMAND ${ARGV} COMMAND_ERROR_IS_FATAL ANY OUTPUT_QUIET)
endfunction()
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
foreach(project IN ITEMS laws_only whole)
  run(${CMAKE_COMMAND} -S ${SOURCE}/${project} -B ${WORK}/${project} -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_BUILD_TYPE=Release)
  run(${CMAKE_COMMAND} --build ${WORK}/${project})
  execute_process(COMMAND ${WORK}/${project}/${project} COMMAND_ERROR_IS_FATAL ANY)
endforeach()
run(${WORK}/prefix/bin/pounding --version)
