add_library(Jolt::Jolt INTERFACE IMPORTED)
get_filename_component(prefix ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)
set_target_properties(Jolt::Jolt PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${prefix}/include)
