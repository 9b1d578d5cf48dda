# Cache values for a build of ODE (cmake -C) that this adapter can drive: Debian's own, without its demonstrations.
set(ODE_DOUBLE_PRECISION ON CACHE BOOL "")
set(ODE_WITH_LIBCCD ON CACHE BOOL "")
set(ODE_WITH_DEMOS OFF CACHE BOOL "")
set(ODE_WITH_TESTS OFF CACHE BOOL "")
set(BUILD_SHARED_LIBS ON CACHE BOOL "")
