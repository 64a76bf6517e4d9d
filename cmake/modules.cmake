# A folder of pounding/ is a module. The modules are declared in order, elements/CMakeLists.txt before lib/CMakeLists.txt. Each needs
# only modules declared before it; tests/docs/test_modules.py compares every include with NEEDS.

# Common headers are precompiled once per set of flags, since GCC accepts a precompiled header only with identical flags. Every
# source still includes what it uses; check this with -DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON.
set(pounding_headers <algorithm> <array> <cmath> <functional> <limits> <map> <memory> <optional> <span> <stdexcept> <string>
  <string_view> <utility> <variant> <vector> <fmt/format.h> <Eigen/Core> <Eigen/SparseCore>)

# These modules may not include Eigen.
set(pounding_without_eigen laws sections core links)

# For code outside the time steps: -O1 takes two thirds of the compile time of -O3.
set(pounding_light_options $<$<AND:$<CONFIG:Release>,$<CXX_COMPILER_ID:GNU,Clang>>:-O1>)

# pounding_precompile(TARGET GROUP headers): the first target of a group builds the precompiled header, the others reuse it.
function(pounding_precompile target group)
  get_property(owner GLOBAL PROPERTY pounding_headers_of_${group})
  if(owner)
    target_precompile_headers(${target} REUSE_FROM ${owner})
  else()
    target_precompile_headers(${target} PRIVATE ${ARGN})
    set_property(GLOBAL PROPERTY pounding_headers_of_${group} ${target})
  endif()
endfunction()

# pounding_module(NAME [LIGHT] [NEEDS modules] [WITH packages] [SOURCES files]): LIGHT for modules that only read, check, set up or
# write, before and after the steps.
function(pounding_module name)
  cmake_parse_arguments(PARSE_ARGV 1 module "LIGHT" "" "NEEDS;WITH;SOURCES")
  if(module_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "module ${name}: unknown arguments ${module_UNPARSED_ARGUMENTS}")
  endif()
  list(TRANSFORM module_NEEDS PREPEND pounding_module_)
  foreach(need IN LISTS module_NEEDS)
    if(NOT TARGET ${need})
      message(FATAL_ERROR "module ${name} needs ${need}, which is not declared before it")
    endif()
  endforeach()
  list(TRANSFORM module_SOURCES PREPEND pounding/${name}/)
  set(target pounding_module_${name})
  if(module_SOURCES)
    set(scope PUBLIC)
    add_library(${target} OBJECT ${module_SOURCES})
    target_link_libraries(${target} PRIVATE pounding_warnings)
    if(module_LIGHT)
      target_compile_options(${target} PRIVATE ${pounding_light_options})
      pounding_precompile(${target} light ${pounding_headers})
    elseif(NOT name IN_LIST pounding_without_eigen)
      pounding_precompile(${target} libraries ${pounding_headers})
    endif()
  else()
    set(scope INTERFACE)
    add_library(${target} INTERFACE)
  endif()
  target_compile_features(${target} ${scope} cxx_std_20)
  target_include_directories(${target} ${scope} ${CMAKE_CURRENT_SOURCE_DIR} ${CMAKE_CURRENT_BINARY_DIR})
  target_link_libraries(${target} ${scope} ${module_NEEDS} ${module_WITH})
endfunction()

# pounding_public(NAME OF modules [WITH targets]): a library for users, made of these modules.
function(pounding_public name)
  cmake_parse_arguments(PARSE_ARGV 1 public "" "" "OF;WITH")
  set(target pounding_${name})
  set(objects)
  foreach(module IN LISTS public_OF)
    list(APPEND objects $<TARGET_OBJECTS:pounding_module_${module}>)
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
