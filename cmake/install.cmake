# Headers, libraries, the program with its manual pages, a CMake package and pkg-config files.
include(CMakePackageConfigHelpers)

set(config_directory ${CMAKE_INSTALL_LIBDIR}/cmake/Pounding)
set(parts laws c links elements lib)
if(TARGET pounding_fortran)
  list(APPEND parts fortran)
endif()
foreach(part IN LISTS parts)
  set_target_properties(pounding_${part} PROPERTIES EXPORT_NAME ${part})
endforeach()

install(TARGETS pounding_laws EXPORT PoundingLawsTargets)
install(TARGETS pounding_c EXPORT PoundingCTargets)
install(TARGETS pounding_links pounding_warnings EXPORT PoundingLinksTargets)
install(TARGETS pounding_elements EXPORT PoundingElementsTargets)
install(TARGETS pounding_lib EXPORT PoundingLibTargets)
set(exports Laws C Links Elements Lib)
if(TARGET pounding_fortran)
  install(TARGETS pounding_fortran EXPORT PoundingFortranTargets)
  install(FILES $<TARGET_PROPERTY:pounding_fortran,Fortran_MODULE_DIRECTORY>/pounding.mod elements/fortran/pounding.f90
    DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pounding/fortran)
  list(APPEND exports Fortran)
endif()
install(TARGETS pounding_program)
# In the build tree CMake would add an empty entry, the working folder, to their library search path. The wheel copies them from there.
if(NOT BUILD_SHARED_LIBS)
  set_target_properties(pounding_c pounding_program PROPERTIES BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH_USE_LINK_PATH ON)
endif()

install(CODE "set(SOURCE [[${PROJECT_SOURCE_DIR}]])\nset(BINARY [[${PROJECT_BINARY_DIR}]])\nset(INCLUDEDIR [[${CMAKE_INSTALL_INCLUDEDIR}]])")
install(SCRIPT cmake/install_headers.cmake)
install(FILES elements/c/pounding.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(DIRECTORY python/pounding DESTINATION ${CMAKE_INSTALL_DATADIR}/pounding/python FILES_MATCHING PATTERN "*.py" PATTERN "*.html"
  PATTERN __pycache__ EXCLUDE)
install(FILES python/pounding/model.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/pounding)

# The CMake package.
foreach(export IN LISTS exports)
  install(EXPORT Pounding${export}Targets NAMESPACE Pounding:: DESTINATION ${config_directory})
endforeach()
configure_package_config_file(cmake/PoundingConfig.cmake.in ${PROJECT_BINARY_DIR}/PoundingConfig.cmake
  INSTALL_DESTINATION ${config_directory})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PoundingConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PoundingConfig.cmake ${PROJECT_BINARY_DIR}/PoundingConfigVersion.cmake
  cmake/FindMpiHdf5.cmake DESTINATION ${config_directory})

# Relocatable pkg-config files.
file(RELATIVE_PATH prefix_from_here /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
function(install_pc name description requires libraries more_flags)
  configure_file(cmake/package.pc.in ${PROJECT_BINARY_DIR}/${name}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endfunction()
install_pc(pounding-laws "Contact laws of pounding structures, C++20 headers" "" "" "")
install_pc(pounding-links "Gap links between structures" "" "-L\${libdir} -lpounding_links" "")
install_pc(pounding-elements "Structures, the model and its reader" "pounding-links yaml-cpp fmt eigen3"
  "-L\${libdir} -lpounding_elements" "")
install_pc(pounding "Time integration and results of pounding structures" "pounding-elements slepc PETSc ${MPI_HDF5_MODULE} zlib"
  "-L\${libdir} -lpounding_lib" "")
install_pc(pounding-c "Contact laws of pounding structures, C interface" "" "-L\${libdir} -lpounding_c" "")
if(TARGET pounding_fortran)
  install_pc(pounding-fortran "Contact laws of pounding structures, Fortran module" "pounding-c"
    "-L\${libdir} -lpounding_fortran" " -I\${includedir}/pounding/fortran")
endif()

# Manual pages, made from the help of the program, and completion.
find_program(POUNDING_HELP2MAN help2man)
if(POUNDING_HELP2MAN)
  add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/man/pounding.1
    COMMAND ${PROJECT_SOURCE_DIR}/cmake/man-pages.sh ${POUNDING_HELP2MAN} $<TARGET_FILE:pounding_program> ${PROJECT_BINARY_DIR}/man
    DEPENDS pounding_program cmake/man-pages.sh
    VERBATIM)
  add_custom_target(pounding_man ALL DEPENDS ${PROJECT_BINARY_DIR}/man/pounding.1)
  install(DIRECTORY ${PROJECT_BINARY_DIR}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
endif()
install(FILES cmake/completion/pounding.bash
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME pounding)
install(FILES cmake/completion/pounding.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions RENAME _pounding)
