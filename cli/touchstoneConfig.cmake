# find_package(touchstone [COMPONENTS engine core referee]); without components: engine.
#   engine   touchstone::engine, the header of the C ABI (oracles/abi/touchstone_engine.h);
#            touchstone_add_plugin(name sources...), a plug-in, lib<name>.so;
#            TOUCHSTONE_PROGRAM, the program, for instance for add_test(COMMAND ${TOUCHSTONE_PROGRAM} certify ...)
#   core     touchstone::core (shared) and touchstone::core_static: collision detection; needs Eigen
#   referee  touchstone::library (shared), the C interface touchstone.h and its C++ wrapper: exact answers with
#            certificates, their checker, and the judge of other answers; needs nothing else.
#            Where Eigen, qhull and GMP are installed, also touchstone::referee (static), the referee's own C++ interface
include(CMakeFindDependencyMacro)
get_filename_component(touchstone_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
if(NOT touchstone_FIND_COMPONENTS)
  set(touchstone_FIND_COMPONENTS engine)
endif()

# A library NAME of lib/FILE that programs link together with what follows.
function(touchstone_import name kind file)
  if(NOT TARGET touchstone::${name})
    add_library(touchstone::${name} ${kind} IMPORTED)
    set_target_properties(touchstone::${name} PROPERTIES IMPORTED_LOCATION "${touchstone_prefix}/lib/${file}"
      INTERFACE_INCLUDE_DIRECTORIES "${touchstone_prefix}/include/touchstone"
      INTERFACE_COMPILE_FEATURES cxx_std_20 INTERFACE_COMPILE_OPTIONS -ffp-contract=off
      INTERFACE_COMPILE_DEFINITIONS "@TOUCHSTONE_WIDE_DEFINITION@"
      INTERFACE_LINK_LIBRARIES "${ARGN}")
  endif()
endfunction()

foreach(component IN LISTS touchstone_FIND_COMPONENTS)
  set(touchstone_${component}_FOUND TRUE)
  if(component STREQUAL "engine")
    set(TOUCHSTONE_PROGRAM "${touchstone_prefix}/bin/touchstone")
    if(NOT TARGET touchstone::engine)
      add_library(touchstone::engine INTERFACE IMPORTED)
      set_target_properties(touchstone::engine PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${touchstone_prefix}/include")
    endif()
  elseif(component STREQUAL "core" AND EXISTS "${touchstone_prefix}/lib/libtouchstone-core.a")
    find_dependency(Eigen3 3.3)
    find_dependency(Threads)
    find_library(TOUCHSTONE_QHULL_R NAMES qhull_r REQUIRED)
    find_library(TOUCHSTONE_HWY NAMES hwy REQUIRED)
    touchstone_import(core SHARED libtouchstone-core.so Eigen3::Eigen)
    touchstone_import(core_static STATIC libtouchstone-core.a Eigen3::Eigen ${TOUCHSTONE_QHULL_R} ${TOUCHSTONE_HWY}
                      Threads::Threads)
  elseif(component STREQUAL "referee" AND EXISTS "${touchstone_prefix}/lib/libtouchstone.so")
    if(NOT TARGET touchstone::library)
      add_library(touchstone::library SHARED IMPORTED)
      set_target_properties(touchstone::library PROPERTIES IMPORTED_LOCATION "${touchstone_prefix}/lib/libtouchstone.so"
        INTERFACE_INCLUDE_DIRECTORIES "${touchstone_prefix}/include")
    endif()
    find_package(Eigen3 3.3 QUIET)
    find_library(TOUCHSTONE_QHULL_R NAMES qhull_r)
    find_library(TOUCHSTONE_GMP NAMES gmp)
    if(Eigen3_FOUND AND TOUCHSTONE_QHULL_R AND TOUCHSTONE_GMP)
      touchstone_import(referee STATIC libtouchstone-referee.a Eigen3::Eigen ${TOUCHSTONE_QHULL_R} ${TOUCHSTONE_GMP})
    endif()
  else()
    set(touchstone_${component}_FOUND FALSE)
    if(touchstone_FIND_REQUIRED_${component})
      set(touchstone_FOUND FALSE)
      set(touchstone_NOT_FOUND_MESSAGE "${component} is not installed in ${touchstone_prefix}")
    endif()
  endif()
endforeach()

function(touchstone_add_plugin name)
  add_library(${name} MODULE ${ARGN})
  target_link_libraries(${name} PRIVATE touchstone::engine)
  set_target_properties(${name} PROPERTIES PREFIX lib SUFFIX .so)
  if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    target_compile_options(${name} PRIVATE -O2)  # an engine without optimisation is not the one to measure
  endif()
  if(UNIX)
    target_link_libraries(${name} PRIVATE m)
  endif()
endfunction()
