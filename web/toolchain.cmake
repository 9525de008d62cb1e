# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# Compiles for WebAssembly with the compiler that scripts/zig installs. FLAGSTONE_ZIG is its program `zig`.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES FLAGSTONE_ZIG)
cmake_path(GET FLAGSTONE_ZIG PARENT_PATH zig_directory)
set(FLAGSTONE_ZIG_SOURCES ${zig_directory}/lib)

set(CMAKE_C_COMPILER ${FLAGSTONE_ZIG} cc)
set(CMAKE_CXX_COMPILER ${FLAGSTONE_ZIG} c++)
set(CMAKE_HAVE_LIBC_PTHREAD ON CACHE INTERNAL "") # functions that do nothing or fail
foreach(language C CXX)
  # Chrome 95, Firefox 100 and Safari 16.4 have SIMD and exceptions.
  set(CMAKE_${language}_FLAGS_INIT "-target wasm32-wasi -mcpu=lime1+exception_handling+simd128 -fwasm-exceptions \
-fno-sanitize=undefined -g0")
  set(CMAKE_${language}_ARCHIVE_CREATE "${FLAGSTONE_ZIG} ar qc <TARGET> <OBJECTS>")
  set(CMAKE_${language}_ARCHIVE_APPEND "${FLAGSTONE_ZIG} ar q <TARGET> <OBJECTS>")
  set(CMAKE_${language}_ARCHIVE_FINISH "${FLAGSTONE_ZIG} ranlib <TARGET>")
endforeach()
# The compiler's libc++ has neither exceptions nor threads; web/runtime builds its sources with both. WebAssembly without
# shared memory cannot start threads: std::thread reports that, and flagstone continues on one.
string(APPEND CMAKE_CXX_FLAGS_INIT " -Wno-macro-redefined -U_LIBCPP_HAS_THREADS -D_LIBCPP_HAS_THREADS=1 \
-U_LIBCPP_HAS_FILESYSTEM -D_LIBCPP_HAS_FILESYSTEM=1")
set(CMAKE_EXE_LINKER_FLAGS_INIT -nostdlib++)
