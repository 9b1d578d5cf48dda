add_library(box3d::box3d INTERFACE IMPORTED)
get_filename_component(prefix ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)
set_target_properties(box3d::box3d PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${prefix}/include)
