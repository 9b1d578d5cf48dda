add_library(coal::coal INTERFACE IMPORTED)
get_filename_component(prefix ${CMAKE_CURRENT_LIST_DIR}/../../.. ABSOLUTE)
set_target_properties(coal::coal PROPERTIES INTERFACE_INCLUDE_DIRECTORIES ${prefix}/include)
