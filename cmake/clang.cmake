# The presets `clang` and `fuzz` take Clang by the name that it has on this machine.
include(${CMAKE_CURRENT_LIST_DIR}/clang_names.cmake)
find_program(POUNDING_CLANG NAMES ${clang_names} REQUIRED)
find_program(POUNDING_CLANGXX NAMES ${clang_names_cxx} REQUIRED)
set(CMAKE_C_COMPILER ${POUNDING_CLANG})
set(CMAKE_CXX_COMPILER ${POUNDING_CLANGXX})
