# Cache values for a build of FCL (cmake -C) that this adapter can drive. Instructions of the machine at hand would
# change the alignment of Eigen's types, which adapter and library must share.
set(BUILD_SHARED_LIBS ON CACHE BOOL "")
set(BUILD_TESTING OFF CACHE BOOL "")
set(FCL_USE_HOST_NATIVE_ARCH OFF CACHE BOOL "")
set(FCL_USE_X64_SSE OFF CACHE BOOL "")
set(FCL_TREAT_WARNINGS_AS_ERRORS OFF CACHE BOOL "")
