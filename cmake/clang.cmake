# Finds Clang under its name on this machine, for the presets `clang` and `fuzz`.
include(${CMAKE_CURRENT_LIST_DIR}/clang_names.cmake)
find_program(POUNDING_CLANG NAMES ${clang_names} REQUIRED)
find_program(POUNDING_CLANGXX NAMES ${clang_names_cxx} REQUIRED)
set(CMAKE_C_COMPILER ${POUNDING_CLANG})
set(CMAKE_CXX_COMPILER ${POUNDING_CLANGXX})
