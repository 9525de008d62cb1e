# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# Dependencies of the library, the command and the tests. docs/contributing/dependencies.md lists the reasons.
# A system package is preferred. If it is missing or too old, the upstream archive of a pinned version is fetched and
# checked against its checksum.
include(FetchContent)

# flagstone_headers(NAME TARGET HEADER) makes TARGET from the headers of a system package, without its compiled library:
# the directory of HEADER. It is copied, because the headers next to it belong to the system. Sets NAME_FOUND.
function(flagstone_headers name target header)
  cmake_path(GET header PARENT_PATH directory)
  find_path(${name}_include ${header} PATHS /usr/local/include /usr/include NO_CACHE)
  if(NOT ${name}_include)
    return()
  endif()
  set(copy ${CMAKE_BINARY_DIR}/headers)
  file(COPY ${${name}_include}/${directory} DESTINATION ${copy})
  add_library(${target} INTERFACE IMPORTED GLOBAL)
  target_include_directories(${target} SYSTEM INTERFACE ${copy})
  set(${name}_FOUND ON PARENT_SCOPE)
endfunction()

# flagstone_dependency(NAME URL SHA256 [arguments of find_package...])
function(flagstone_dependency name url sha256)
  if(${name}_FOUND)
    return()
  endif()
  set(CMAKE_POLICY_DEFAULT_CMP0077 NEW) # options set here apply to the fetched project
  set(CMAKE_POLICY_DEFAULT_CMP0126 NEW)
  set(CMAKE_POLICY_VERSION_MINIMUM 3.5) # CMake 4 rejects projects that require an older version
  if(CMAKE_VERSION VERSION_LESS 4.4)
    set(CMAKE_WARN_DEPRECATED OFF)
  endif()
  set(CMAKE_UNITY_BUILD OFF) # the files of some projects cannot be compiled together
  set(BUILD_SHARED_LIBS OFF)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON) # static libraries may become part of the Python module
  FetchContent_Declare(
    ${name}
    SYSTEM # must come first: after URL_HASH, CMake 3.25 treats it as part of the checksum
    URL ${url}
    URL_HASH SHA256=${sha256}
    FIND_PACKAGE_ARGS ${ARGN})
  FetchContent_MakeAvailable(${name})
  if(NOT ${name}_FOUND)
    message(STATUS "${name}: not on this system, built from ${url}")
    # Built if another target needs it, never installed.
    FetchContent_GetProperties(${name} SOURCE_DIR source)
    set_property(DIRECTORY ${source} PROPERTY EXCLUDE_FROM_ALL ON)
  endif()
endfunction()

option(FLAGSTONE_HOST_HEADERS "Take only headers from this system's packages, because their libraries are for another system"
       ${FLAGSTONE_BUILD_WEB})
if(FLAGSTONE_BUILD_WEB)
  flagstone_headers(hwy hwy::hwy hwy/highway.h)
endif()
if(FLAGSTONE_HOST_HEADERS)
  flagstone_headers(fmt fmt::fmt fmt/format.h)
  if(fmt_FOUND)
    target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
  endif()
  flagstone_headers(tomlplusplus tomlplusplus::tomlplusplus toml++/toml.h)
  if(APPLE AND tomlplusplus_FOUND) # it checks FLT_RADIX, which Zig's headers for macOS do not define
    target_compile_definitions(tomlplusplus::tomlplusplus INTERFACE TOML_DISABLE_ENVIRONMENT_CHECKS)
  endif()
  flagstone_headers(nlohmann_json nlohmann_json::nlohmann_json nlohmann/json.hpp)
endif()

# Highway is the only dependency of the library, and no public header includes it. Programs that link
# flagstone::flagstone also link a system Highway; a fetched Highway becomes part of the library.
set(HWY_ENABLE_TESTS OFF)
set(HWY_ENABLE_EXAMPLES OFF)
set(HWY_ENABLE_CONTRIB OFF)
set(HWY_ENABLE_INSTALL OFF)
flagstone_dependency(
  hwy https://github.com/google/highway/archive/refs/tags/1.0.3.tar.gz
  566fc77315878473d9a6bd815f7de78c73734acdcb745c3dde8579560ac5440e 1.0.3)
find_package(Threads REQUIRED)
add_library(flagstone_highway INTERFACE)
# Vectors whose length is known only at run time cannot be members of our structs. SSSE3 without SSE4 exists only on CPUs
# from before 2008, which run the plain code. The plain code is always compiled, whatever the compiler assumes of the CPU.
option(FLAGSTONE_TWO_TARGETS "On x86-64, compile plain code and AVX2 only: takes a third of the time" OFF)
set(disabled_targets HWY_SVE HWY_SVE2 HWY_SVE_256 HWY_SVE2_128 HWY_RVV HWY_SSSE3)
if(FLAGSTONE_TWO_TARGETS)
  list(APPEND disabled_targets HWY_SSE4 HWY_AVX3 HWY_AVX3_DL)
endif()
list(JOIN disabled_targets "|" disabled_targets)
target_compile_definitions(flagstone_highway INTERFACE "HWY_DISABLED_TARGETS=(${disabled_targets})")
if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^wasm") # has one instruction set; see web/CMakeLists.txt
  target_compile_definitions(flagstone_highway INTERFACE HWY_COMPILE_ALL_ATTAINABLE)
endif()
if(NOT TARGET hwy)
  target_link_libraries(flagstone_highway INTERFACE hwy::hwy)
else()
  target_link_libraries(flagstone_highway INTERFACE hwy)
endif()

set(needs_command OFF)
if(FLAGSTONE_BUILD_COMMAND OR FLAGSTONE_BUILD_TESTS)
  set(needs_command ON)
endif()

if(needs_command
   OR FLAGSTONE_BUILD_ROS
   OR FLAGSTONE_BUILD_FUZZERS
   OR FLAGSTONE_BUILD_WEB
   OR FLAGSTONE_SANITIZED_TESTS)
  flagstone_dependency(
    fmt https://github.com/fmtlib/fmt/archive/9.1.0.tar.gz
    5dea48d1fcddc3ec571ce2058e13910a0d4a6bab4cc09a809d8b1dd1c88ae6f2 9)
  flagstone_dependency(
    tomlplusplus https://github.com/marzer/tomlplusplus/archive/refs/tags/v3.3.0.tar.gz
    fc1a5eb410f3c67e90e5ad1264a1386d020067cfb01b633cc8c0441789aa6cf2 3.3)
endif()

if(needs_command
   OR FLAGSTONE_BUILD_FUZZERS
   OR FLAGSTONE_BUILD_WEB
   OR web IN_LIST FLAGSTONE_SANITIZED_TESTS)
  flagstone_dependency(
    nlohmann_json https://github.com/nlohmann/json/archive/v3.11.2.tar.gz
    d69f9deb6a75e2580465c6c4c5111b89c4dc2fa94e3a85fcd2ffcd9a143d9273 3.11)
endif()

if(needs_command)
  flagstone_dependency(
    CLI11 https://github.com/CLIUtils/CLI11/archive/v2.1.2.tar.gz
    26291377e892ba0e5b4972cdfd4a2ab3bf53af8dac1f4ea8fe0d1376b625c8cb 2.1)

  # The simulator needs only single rays and triangles, and the lowest instruction set is fast enough. A complete Embree
  # takes four times as long to build.
  set(EMBREE_STATIC_LIB ON)
  set(EMBREE_TASKING_SYSTEM INTERNAL)
  set(EMBREE_ISPC_SUPPORT OFF)
  set(EMBREE_TUTORIALS OFF)
  set(EMBREE_RAY_PACKETS OFF)
  foreach(geometry QUAD CURVE SUBDIVISION USER INSTANCE GRID POINT)
    set(EMBREE_GEOMETRY_${geometry} OFF)
  endforeach()
  foreach(instruction_set SSE42 AVX AVX2 AVX512)
    set(EMBREE_ISA_${instruction_set} OFF)
  endforeach()
  flagstone_dependency(
    embree https://github.com/embree/embree/archive/v3.13.5.tar.gz
    b8c22d275d9128741265537c559d0ea73074adbf2f2b66b0a766ca52c52d665b 3)

  # Chart.js draws the plots of HTML reports, which contain its minified file.
  find_file(
    FLAGSTONE_CHART_JS chart.min.js
    PATHS /usr/local/share/javascript/chart.js /usr/share/javascript/chart.js
          /usr/local/share/nodejs/chart.js/dist /usr/share/nodejs/chart.js/dist
    DOC "chart.min.js of Chart.js 3")
  set(chart_js_banner "")
  if(FLAGSTONE_CHART_JS)
    file(READ ${FLAGSTONE_CHART_JS} chart_js_banner LIMIT 100)
  endif()
  if(NOT chart_js_banner MATCHES "Chart\\.js v3\\.")
    set(chart_js_url https://github.com/chartjs/Chart.js/releases/download/v3.9.1/chart.js-3.9.1.tgz)
    FetchContent_Declare(
      chart_js
      SOURCE_SUBDIR no-build
      URL ${chart_js_url}
      URL_HASH SHA256=111e0751796f087a51e94dfed910ccfb1278fd30e584a6e48514dba9ae7e72c6)
    FetchContent_MakeAvailable(chart_js)
    message(STATUS "Chart.js: not on this system, taken from ${chart_js_url}")
    set(FLAGSTONE_CHART_JS ${chart_js_SOURCE_DIR}/dist/chart.min.js)
  endif()

  # Cairo is only used from the system. Without it the command cannot draw images.
  find_package(PkgConfig QUIET)
  if(PkgConfig_FOUND)
    pkg_check_modules(cairo QUIET IMPORTED_TARGET cairo)
  endif()
  add_library(flagstone_cairo INTERFACE)
  if(cairo_FOUND)
    target_link_libraries(flagstone_cairo INTERFACE PkgConfig::cairo)
  elseif(FLAGSTONE_BUILD_TESTS)
    message(FATAL_ERROR "Cairo was not found, but the tests require it: install pkg-config and Cairo's development "
                        "files (Debian: apt-get install pkg-config libcairo2-dev)")
  else()
    message(STATUS "Cairo: not on this system, so the command cannot draw images "
                   "(Debian: apt-get install pkg-config libcairo2-dev)")
  endif()
  # The command in the wheel must run without Cairo. Cairo's shared library depends on X11, which wheels must not contain,
  # so the static library is linked: only its parts that draw into memory.
  if(cairo_FOUND AND FLAGSTONE_BUILD_PYTHON)
    set(archives "")
    foreach(library IN LISTS cairo_STATIC_LIBRARIES)
      if(NOT library MATCHES "^(m|pthread|dl|rt)$")
        find_library(archive lib${library}.a HINTS ${cairo_STATIC_LIBRARY_DIRS} NO_CACHE)
        list(APPEND archives ${archive})
        unset(archive)
      endif()
    endforeach()
    if(NOT archives MATCHES "NOTFOUND")
      message(STATUS "Cairo: linked statically")
      set_target_properties(flagstone_cairo PROPERTIES INTERFACE_LINK_LIBRARIES "${archives}")
      target_include_directories(flagstone_cairo SYSTEM INTERFACE ${cairo_INCLUDE_DIRS})
    endif()
  endif()
endif()

if(FLAGSTONE_BUILD_TESTS OR FLAGSTONE_SANITIZED_TESTS)
  flagstone_dependency(
    googletest https://github.com/google/googletest/archive/refs/tags/release-1.12.1.tar.gz
    81964fe578e9bd7c94dfdb09c8e4d6e6759e19967e397dbea48d1c10e45d0df2 1.12 NAMES GTest)
  if(FLAGSTONE_BUILD_PROPERTY_TESTS)
    set(RC_ENABLE_GTEST ON)
    flagstone_dependency(
      rapidcheck https://github.com/emil-e/rapidcheck/archive/ff6af6fc683159deb51c543b065eba14dfcf329b.zip
      60951dbc4de162622f51a4a34117c269a9921833a51dddce36f4cc80a5f7cf9f)
  endif()
  # Eigen's own build would bring hundreds of targets; its headers are all that is needed.
  FetchContent_Declare(
    Eigen3
    SOURCE_SUBDIR no-build
    URL https://gitlab.com/libeigen/eigen/-/archive/3.4.0/eigen-3.4.0.tar.bz2
    URL_HASH SHA256=b4c198460eba6f28d34894e3a5710998818515104d6e74e5cc331ce31e46e626
    FIND_PACKAGE_ARGS 3.4)
  FetchContent_MakeAvailable(Eigen3)
  if(NOT TARGET Eigen3::Eigen)
    add_library(Eigen3::Eigen INTERFACE IMPORTED)
    target_include_directories(Eigen3::Eigen INTERFACE ${eigen3_SOURCE_DIR})
  endif()
  include(GoogleTest)
endif()
