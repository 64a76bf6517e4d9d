# Possible names of Clang: distributions append its version.
set(clang_names clang)
foreach(version RANGE 22 14 -1)
  list(APPEND clang_names clang-${version})
endforeach()
list(TRANSFORM clang_names REPLACE "^clang" "clang++" OUTPUT_VARIABLE clang_names_cxx)
