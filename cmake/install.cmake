# Headers, libraries, the program and the CMake package.
include(CMakePackageConfigHelpers)

set(config_directory ${CMAKE_INSTALL_LIBDIR}/cmake/Pounding)
set_target_properties(pounding_laws PROPERTIES EXPORT_NAME laws)
set_target_properties(pounding_model PROPERTIES EXPORT_NAME model)
set_target_properties(pounding_elements PROPERTIES EXPORT_NAME elements)
set_target_properties(pounding_lib PROPERTIES EXPORT_NAME lib)

install(TARGETS pounding_laws EXPORT PoundingLawsTargets)
install(TARGETS pounding_model pounding_elements pounding_warnings EXPORT PoundingElementsTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS pounding_lib EXPORT PoundingLibTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS pounding_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

install(DIRECTORY elements/pounding lib/pounding DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.hpp")
install(FILES ${PROJECT_BINARY_DIR}/lib/pounding/version.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/pounding)
install(DIRECTORY python/pounding DESTINATION ${CMAKE_INSTALL_DATADIR}/pounding/python FILES_MATCHING PATTERN "*.py")

foreach(part IN ITEMS Laws Elements Lib)
  install(EXPORT Pounding${part}Targets NAMESPACE Pounding:: DESTINATION ${config_directory})
endforeach()
configure_package_config_file(cmake/PoundingConfig.cmake.in ${PROJECT_BINARY_DIR}/PoundingConfig.cmake
  INSTALL_DESTINATION ${config_directory})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/PoundingConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/PoundingConfig.cmake ${PROJECT_BINARY_DIR}/PoundingConfigVersion.cmake
  cmake/FindMpiHdf5.cmake DESTINATION ${config_directory})
