# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# Compiles for FLAGSTONE_ZIG_TARGET, x86_64-windows-gnu or aarch64-macos, with Zig: clang, linkers, and the headers and
# libraries of C and C++ of these systems. FLAGSTONE_ZIG is its program `zig`. Programs for Windows run under Wine.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES FLAGSTONE_ZIG FLAGSTONE_ZIG_TARGET)
if(FLAGSTONE_ZIG_TARGET MATCHES "windows")
  set(CMAKE_SYSTEM_NAME Windows)
  set(CMAKE_CROSSCOMPILING_EMULATOR wine)
else()
  set(CMAKE_SYSTEM_NAME Darwin)
  set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY) # does not link, which would compile all of libc++ first
  set(CMAKE_HAVE_LIBC_PTHREAD ON CACHE INTERNAL "")
  set(CMAKE_INSTALL_NAME_TOOL true) # changes paths in programs when they are installed, which these are not
endif()
string(REGEX MATCH "^[^-]+" CMAKE_SYSTEM_PROCESSOR ${FLAGSTONE_ZIG_TARGET})

set(CMAKE_C_COMPILER ${FLAGSTONE_ZIG} cc)
set(CMAKE_CXX_COMPILER ${FLAGSTONE_ZIG} c++)
foreach(language C CXX)
  set(CMAKE_${language}_FLAGS_INIT "-target ${FLAGSTONE_ZIG_TARGET} -fno-sanitize=undefined -g0")
  set(CMAKE_${language}_ARCHIVE_CREATE "${FLAGSTONE_ZIG} ar qc <TARGET> <OBJECTS>")
  set(CMAKE_${language}_ARCHIVE_APPEND "${FLAGSTONE_ZIG} ar q <TARGET> <OBJECTS>")
  set(CMAKE_${language}_ARCHIVE_FINISH "${FLAGSTONE_ZIG} ranlib <TARGET>")
endforeach()
