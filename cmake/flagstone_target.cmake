# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# What every target of ours is compiled with. Results must not depend on the compiler's mood: no
# contraction of a * b + c (GCC's default) and no fast-math anywhere.
function(flagstone_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(
    ${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion -ffp-contract=off
                      $<$<BOOL:${FLAGSTONE_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

# flagstone_library(NAME SOURCES... ) makes the static library flagstone_NAME of the folder src/NAME; its
# headers are included as "NAME/header.hpp".
function(flagstone_library name)
  add_library(flagstone_${name} STATIC ${ARGN})
  target_include_directories(flagstone_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  set_target_properties(flagstone_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  flagstone_compile_options(flagstone_${name})
endfunction()

# flagstone_test(NAME LABEL SOURCES... LINK libraries...) makes one GoogleTest program and registers each
# of its tests with ctest as NAME.Suite.Test.
function(flagstone_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LINK")
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LINK} GTest::gtest_main GTest::gmock)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/tests)
  flagstone_compile_options(${name})
  gtest_discover_tests(
    ${name}
    TEST_PREFIX ${name}.
    DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 300 ENVIRONMENT "FLAGSTONE_DATA=$ENV{FLAGSTONE_DATA}")
endfunction()
