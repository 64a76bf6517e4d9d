# A folder of pounding/ is a module. Modules are declared in one order, elements/CMakeLists.txt before lib/CMakeLists.txt, and
# need only what was declared before them; tests/docs/test_modules.py holds every include against NEEDS.

# What most sources include is compiled once for each set of flags: GCC takes a precompiled header only with the flags that it
# was made with. Every source still includes what it uses; -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON proves it.
set(pounding_headers <algorithm> <array> <cmath> <functional> <limits> <map> <memory> <optional> <span> <stdexcept> <string>
  <string_view> <utility> <variant> <vector> <fmt/format.h> <Eigen/Core> <Eigen/SparseCore>)

# Modules that do without Eigen are compiled without it in sight.
set(pounding_without_eigen laws core links)

# For sources that are not at work in each step: at -O1 the compiler needs a third less time for them.
set(pounding_light_options $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang>>:-O1>)

# pounding_precompile(TARGET GROUP headers): the first target of a group makes its precompiled headers, the others take them.
function(pounding_precompile target group)
  get_property(owner GLOBAL PROPERTY pounding_headers_of_${group})
  if(owner)
    target_precompile_headers(${target} REUSE_FROM ${owner})
  else()
    target_precompile_headers(${target} PRIVATE ${ARGN})
    set_property(GLOBAL PROPERTY pounding_headers_of_${group} ${target})
  endif()
endfunction()

# pounding_module(NAME [NEEDS modules] [WITH packages] [SOURCES files] [BESIDE_THE_STEPS files]): the latter read, check, write or set
# up, before and after the steps.
function(pounding_module name)
  cmake_parse_arguments(PARSE_ARGV 1 module "" "" "NEEDS;WITH;SOURCES;BESIDE_THE_STEPS")
  list(TRANSFORM module_NEEDS PREPEND pounding_module_)
  foreach(need IN LISTS module_NEEDS)
    if(NOT TARGET ${need})
      message(FATAL_ERROR "module ${name} needs ${need}, which is declared after it or not at all")
    endif()
  endforeach()
  list(TRANSFORM module_SOURCES PREPEND pounding/${name}/)
  list(TRANSFORM module_BESIDE_THE_STEPS PREPEND pounding/${name}/)
  set(target pounding_module_${name})
  set(light ${target})
  set(scope PUBLIC)
  set(parts)
  if(module_SOURCES)
    add_library(${target} OBJECT ${module_SOURCES})
    if(NOT name IN_LIST pounding_without_eigen)
      pounding_precompile(${target} libraries ${pounding_headers})
    endif()
    list(APPEND parts ${target})
    set(light ${target}_beside)
  endif()
  if(module_BESIDE_THE_STEPS)
    add_library(${light} OBJECT ${module_BESIDE_THE_STEPS})
    target_compile_options(${light} PRIVATE ${pounding_light_options})
    pounding_precompile(${light} light ${pounding_headers})
    list(APPEND parts ${light})
  endif()
  if(NOT parts)
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
    set(parts ${target})
  endif()
  foreach(part IN LISTS parts)
    target_compile_features(${part} ${scope} cxx_std_20)
    target_include_directories(${part} ${scope} ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR})
    target_link_libraries(${part} ${scope} ${module_NEEDS} ${module_WITH})
    if(scope STREQUAL "PUBLIC")
      target_link_libraries(${part} PRIVATE pounding_warnings)
    endif()
  endforeach()
endfunction()

# pounding_public(NAME OF modules [WITH targets]): the library that users link, made of these modules.
function(pounding_public name)
  cmake_parse_arguments(PARSE_ARGV 1 public "" "" "OF;WITH")
  set(target pounding_${name})
  set(objects)
  foreach(module IN LISTS public_OF)
    list(APPEND objects $<TARGET_OBJECTS:pounding_module_${module}>)
    if(TARGET pounding_module_${module}_beside)
      list(APPEND objects $<TARGET_OBJECTS:pounding_module_${module}_beside>)
    endif()
  endforeach()
  add_library(${target} ${objects})
  add_library(Pounding::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES LINKER_LANGUAGE CXX)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}>
    $<BUILD_INTERFACE:${CMAKE_CURRENT_BINARY_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(${target} PUBLIC ${public_WITH})
endfunction()
