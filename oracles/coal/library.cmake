# Cache values for a build of Coal (cmake -C) that this adapter can drive. Coal's own CMake modules are a submodule of
# its repository, which must be checked out.
set(BUILD_SHARED_LIBS ON CACHE BOOL "")
set(BUILD_PYTHON_INTERFACE OFF CACHE BOOL "")
set(BUILD_TESTING OFF CACHE BOOL "")
set(INSTALL_DOCUMENTATION OFF CACHE BOOL "")
set(GENERATE_PYTHON_STUBS OFF CACHE BOOL "")
set(COAL_BACKWARD_COMPATIBILITY_WITH_HPP_FCL OFF CACHE BOOL "")
