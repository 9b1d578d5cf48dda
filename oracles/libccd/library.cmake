# Cache values for a build of libccd (cmake -C) that this adapter can drive.
set(ENABLE_DOUBLE_PRECISION ON CACHE BOOL "")
set(BUILD_SHARED_LIBS ON CACHE BOOL "")
set(BUILD_TESTING OFF CACHE BOOL "")
set(BUILD_DOCUMENTATION OFF CACHE BOOL "")
