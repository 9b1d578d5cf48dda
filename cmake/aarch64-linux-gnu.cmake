# Cross build for 64-bit ARM with Debian's packages: g++-aarch64-linux-gnu, qemu-user (to run the tests), and, after
# dpkg --add-architecture arm64, the :arm64 packages of libqhull-dev, libhwy-dev, libgmp-dev, libfmt-dev,
# zlib1g-dev, libsqlite3-dev, libtinyxml2-dev and libassimp-dev.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER aarch64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
# No notes about arguments that g++ before 10.1 passed differently.
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-aarch64 -L /usr/aarch64-linux-gnu)
