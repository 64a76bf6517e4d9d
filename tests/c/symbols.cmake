# The shared library exports the functions of interface 1, only names of pnd_..., and needs only the C++ runtime.
#   cmake -DLIBRARY=... -DREADELF=... -P symbols.cmake
execute_process(COMMAND ${READELF} --dyn-syms --wide ${LIBRARY} OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]+" lines "${symbols}")
set(missing interface version error_text create destroy touch respond accept separate collide law_count find_law describe_law
  describe_parameter describe_formula create_yielding destroy_yielding follow yielding_start yielding_count describe_yielding
  describe_yielding_parameter describe_yielding_choice)
foreach(line IN LISTS lines)
  if(NOT line MATCHES " (GLOBAL|WEAK|UNIQUE) " OR line MATCHES " UND ")
    continue()
  endif()
  if(line MATCHES " pnd_([a-z_]+)@@POUNDING_1")
    list(REMOVE_ITEM missing ${CMAKE_MATCH_1})
  elseif(NOT line MATCHES " ABS POUNDING_1")
    message(FATAL_ERROR "${LIBRARY} shows ${line}")
  endif()
endforeach()
if(missing)
  message(FATAL_ERROR "${LIBRARY} does not show pnd_... ${missing}")
endif()

execute_process(COMMAND ${READELF} --dynamic ${LIBRARY} OUTPUT_VARIABLE dynamic COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "Shared library: \\[[^]]+" needed "${dynamic}")
foreach(each IN LISTS needed)
  if(NOT each MATCHES "\\[(libstdc\\+\\+|libc\\+\\+|libm|libgcc_s|libc|ld-linux)")
    message(FATAL_ERROR "${LIBRARY} needs ${each}]")
  endif()
endforeach()
