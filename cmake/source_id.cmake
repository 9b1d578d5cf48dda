# cmake -DROOT=… -DOUT=… -DOPTIONS=… -P source_id.cmake: writes a C++ file with the identity of the sources that harness,
# worker and engines of one build share. Unchanged sources leave the file untouched.
include(${CMAKE_CURRENT_LIST_DIR}/shared_sources.cmake)
ts_shared_sources(${ROOT} files)
set(all)
foreach(file ${files})
  file(SHA256 ${ROOT}/${file} hash)
  string(APPEND all "${file} ${hash}\n")
endforeach()
string(SHA256 sources "${all}")
string(SHA256 build "${OPTIONS}${all}")
string(SUBSTRING ${sources} 0 16 sources)
string(SUBSTRING ${build} 0 16 build)
file(CONFIGURE OUTPUT ${OUT} CONTENT [[
#include "oracles/abi/source_id.h"

const char* touchstone::source_id() { return "@build@"; }
const char* touchstone::message_id() { return "@sources@"; }
]] @ONLY)
