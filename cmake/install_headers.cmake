# Installs the public headers, which python/docs/guide/headers.md lists. All other headers are private: a public header
# that includes one is an error here and in tests/docs/test_headers.py.
#   SOURCE: the project; BINARY: its build; INCLUDEDIR: where headers go below the prefix
cmake_policy(VERSION 3.25)

# Each is installed as one file, with all headers that it includes and that no bundle before it contains.
set(bundles pounding/laws.hpp pounding/hysteresis.hpp pounding/links.hpp)
# Installed one by one; includes of bundled headers become includes of their bundles.
set(headers
  pounding/elements.hpp
  pounding/lib.hpp
  pounding/core/error.hpp
  pounding/core/units.hpp
  pounding/core/version.hpp
  pounding/frames/beam.hpp
  pounding/frames/frame.hpp
  pounding/frames/frame_model.hpp
  pounding/frames/frame_structure.hpp
  pounding/frames/hinge.hpp
  pounding/frames/sections.hpp
  pounding/ground/components.hpp
  pounding/ground/ground_motion.hpp
  pounding/ground/harmonic_sum.hpp
  pounding/ground/record.hpp
  pounding/ground/spectrum.hpp
  pounding/ground/synthetic.hpp
  pounding/input/collision.hpp
  pounding/input/input.hpp
  pounding/input/read_model.hpp
  pounding/input/resolved.hpp
  pounding/linear/lowest_modes.hpp
  pounding/model/contact_law.hpp
  pounding/model/contact_stiffness.hpp
  pounding/model/forces.hpp
  pounding/model/model.hpp
  pounding/model/model_error.hpp
  pounding/model/modes.hpp
  pounding/model/neighbours.hpp
  pounding/model/reduction.hpp
  pounding/model/scheme.hpp
  pounding/petsc/environment.hpp
  pounding/pushover/push_path.hpp
  pounding/pushover/pushover.hpp
  pounding/reports/describe.hpp
  pounding/reports/plausible.hpp
  pounding/results/envelope.hpp
  pounding/results/file_image.hpp
  pounding/results/results.hpp
  pounding/results/spring_history.hpp
  pounding/results/summary.hpp
  pounding/run/run.hpp
  pounding/structures/bar_and_damper.hpp
  pounding/structures/damping.hpp
  pounding/structures/device_spring.hpp
  pounding/structures/element.hpp
  pounding/structures/isolators.hpp
  pounding/structures/massless.hpp
  pounding/structures/one_or_each.hpp
  pounding/structures/oscillators.hpp
  pounding/structures/spring.hpp
  pounding/structures/structure.hpp
  pounding/structures/structure_damping.hpp
  pounding/structures/yield_limits.hpp
  pounding/structures/yielding_law.hpp)

# Path of a header.
function(find_header header result)
  foreach(root IN ITEMS ${SOURCE}/elements ${SOURCE}/lib ${BINARY}/elements)
    if(EXISTS ${root}/${header})
      set(${result} ${root}/${header} PARENT_SCOPE)
      return()
    endif()
  endforeach()
  message(FATAL_ERROR "${header} does not exist")
endfunction()

# Headers of this project that a file includes.
function(includes_of path result)
  file(STRINGS ${path} lines REGEX "^#include <pounding/")
  list(TRANSFORM lines REPLACE "^#include <([^>]*)>.*" "\\1")
  set(${result} ${lines} PARENT_SCOPE)
endfunction()

# Text of a header without `#pragma once` and includes of this project.
function(body_of path result)
  file(READ ${path} text)
  string(REGEX REPLACE "#(pragma once|include <pounding/[^\n]*)\n" "" text "${text}")
  set(${result} "${text}" PARENT_SCOPE)
endfunction()

# Adds a header and the headers that it includes to a bundle: global properties `bundle of HEADER`, `text of BUNDLE` and
# `bundles in BUNDLE`.
function(bundle_header header bundle)
  get_property(owner GLOBAL PROPERTY "bundle of ${header}")
  if(owner AND NOT owner STREQUAL bundle)
    set_property(GLOBAL APPEND PROPERTY "bundles in ${bundle}" ${owner})
  endif()
  if(owner)
    return()
  endif()
  set_property(GLOBAL PROPERTY "bundle of ${header}" ${bundle})
  find_header(${header} path)
  includes_of(${path} includes)
  foreach(included IN LISTS includes)
    bundle_header(${included} ${bundle})
  endforeach()
  if(NOT header STREQUAL bundle)
    body_of(${path} body)
    set_property(GLOBAL APPEND_STRING PROPERTY "text of ${bundle}" "\n// ${header}\n${body}")
  endif()
endfunction()

function(install_text header text)
  file(WRITE ${BINARY}/public/${header} "${text}")
  get_filename_component(folder ${header} DIRECTORY)
  file(INSTALL ${BINARY}/public/${header} DESTINATION "${CMAKE_INSTALL_PREFIX}/${INCLUDEDIR}/${folder}")
endfunction()

foreach(bundle IN LISTS bundles)
  bundle_header(${bundle} ${bundle})
  find_header(${bundle} path)
  body_of(${path} text)
  get_property(others GLOBAL PROPERTY "bundles in ${bundle}")
  list(REMOVE_DUPLICATES others)
  list(TRANSFORM others REPLACE "(.+)" "#include <\\1>\n" OUTPUT_VARIABLE includes)
  string(JOIN "" includes ${includes})
  get_property(parts GLOBAL PROPERTY "text of ${bundle}")
  install_text(${bundle} "#pragma once\n${text}\n${includes}${parts}")
endforeach()

foreach(header IN LISTS headers)
  find_header(${header} path)
  includes_of(${path} includes)
  file(READ ${path} text)
  foreach(included IN LISTS includes)
    get_property(bundle GLOBAL PROPERTY "bundle of ${included}")
    if(bundle)
      string(REPLACE "#include <${included}>" "#include <${bundle}>" text "${text}")
    elseif(NOT included IN_LIST headers)
      message(FATAL_ERROR "the public header ${header} includes ${included}, which is private")
    endif()
  endforeach()
  install_text(${header} "${text}")
endforeach()
