# Cache values for a build of Box3D (cmake -C) that this adapter can drive.
set(BUILD_SHARED_LIBS ON CACHE BOOL "")
set(BOX3D_SAMPLES OFF CACHE BOOL "")
set(BOX3D_UNIT_TESTS OFF CACHE BOOL "")
set(BOX3D_BENCHMARKS OFF CACHE BOOL "")
set(BOX3D_VALIDATE OFF CACHE BOOL "")
