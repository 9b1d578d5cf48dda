# ts_add_plugin(name SOURCES ... LIBS ... [DEFINES ...] [INCLUDES ...]): lib/libtouchstone_<name>.so, which exports only
# what plugin_kit.h declares for export and, in a whole build, touchstone_source_id_v1. Its file name is added to the global property TS_PLUGINS, and LIBS and INCLUDES
# to TS_PLUGIN_PARTS. The name of an engine's plug-ins begins with that of its folder; `_broad` in it means broad phases,
# `_sweep` other settings for charts.
function(ts_add_plugin name)
  cmake_parse_arguments(P "" "" "SOURCES;LIBS;DEFINES;INCLUDES" ${ARGN})
  add_library(touchstone_${name} MODULE ${P_SOURCES})
  if(TARGET ts_source_id)  # an adapter compiled by itself depends on the public interface alone
    target_sources(touchstone_${name} PRIVATE ${PROJECT_SOURCE_DIR}/oracles/abi/plugin_source_id.cpp)
    target_link_libraries(touchstone_${name} PRIVATE ts_source_id)
  endif()
  target_link_libraries(touchstone_${name} PRIVATE ts_flags Eigen3::Eigen ${P_LIBS})
  target_compile_definitions(touchstone_${name} PRIVATE ${P_DEFINES})
  target_include_directories(touchstone_${name} SYSTEM PRIVATE ${P_INCLUDES})
  set_target_properties(touchstone_${name} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
  set_property(GLOBAL APPEND PROPERTY TS_PLUGINS libtouchstone_${name}.so)
  set_property(GLOBAL APPEND PROPERTY TS_PLUGIN_PARTS ${P_LIBS} ${P_INCLUDES})
endfunction()
