# Debian's cross compiler for little-endian MIPS, the ERS-7's kind of processor, and QEMU to run the programs.
# AIBO_MIPS_SYSROOT is the folder with the mipsel libraries that scripts/mips unpacks.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR mipsel)
set(CMAKE_C_COMPILER mipsel-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER mipsel-linux-gnu-g++)
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-mipsel)

# By default, Debian's compiler uses newer instructions than the ERS-7's. Without 64-bit file offsets, readdir() fails
# on the file systems of a 64-bit host.
set(CMAKE_C_FLAGS_INIT "-march=mips2 -D_FILE_OFFSET_BITS=64")
set(CMAKE_CXX_FLAGS_INIT "-march=mips2 -D_FILE_OFFSET_BITS=64")
# Static programs run without MIPS libraries on the system.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)

set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES AIBO_MIPS_SYSROOT)
set(CMAKE_FIND_ROOT_PATH ${AIBO_MIPS_SYSROOT})
set(CMAKE_LIBRARY_ARCHITECTURE mipsel-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
