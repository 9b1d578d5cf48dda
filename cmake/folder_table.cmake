# ts_folder_table(out DIRECTORY root FILE name HEADER header TYPE type FUNCTION suffix TABLE table NAMESPACE namespace):
# sets `out` to the files root/<folder>/<name> and root/npm/<folder>/<name>, and to a generated one that defines
# `std::vector<type> table()`: what `type <folder>_<suffix>()` of each file returns, sorted by folder. An engine's part of
# a table is so in its folder alone.
function(ts_folder_table out)
  cmake_parse_arguments(T "" "DIRECTORY;FILE;HEADER;TYPE;FUNCTION;TABLE;NAMESPACE" "" ${ARGN})
  file(GLOB files CONFIGURE_DEPENDS ${T_DIRECTORY}/*/${T_FILE} ${T_DIRECTORY}/npm/*/${T_FILE})
  set(functions)
  foreach(file ${files})
    cmake_path(GET file PARENT_PATH folder)
    cmake_path(GET folder FILENAME folder)
    list(APPEND functions ${folder}_${T_FUNCTION})
  endforeach()
  list(SORT functions)
  set(declarations)
  set(calls)
  foreach(function ${functions})
    string(APPEND declarations "${T_TYPE} ${function}();\n")
    string(APPEND calls "      ${function}(),\n")
  endforeach()
  set(generated ${CMAKE_CURRENT_BINARY_DIR}/${T_TABLE}.cpp)
  file(CONFIGURE OUTPUT ${generated} CONTENT [[
// Written by cmake/folder_table.cmake.
#include "@T_HEADER@"

namespace @T_NAMESPACE@ {

@declarations@
std::vector<@T_TYPE@> @T_TABLE@() {
  return {
@calls@  };
}

}  // namespace @T_NAMESPACE@
]] @ONLY)
  set(${out} ${files} ${generated} PARENT_SCOPE)
endfunction()
