# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# What every target of ours is compiled with. Results must not depend on the compiler's mood: no
# contraction of a * b + c (GCC's default) and no fast-math anywhere. That nobody looks at floating-point
# exceptions changes no result, and lets GCC make vectors of loops that choose between two values. Where files are
# compiled together, names of one shadow those of another; those who build without CMAKE_UNITY_BUILD are warned of it.
function(flagstone_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(
    ${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -ffp-contract=off
                      -fno-trapping-math
                      $<$<NOT:$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wshadow>
                      $<$<BOOL:${FLAGSTONE_WARNINGS_AS_ERRORS}>:-Werror>)
endfunction()

# Where CMAKE_UNITY_BUILD is on, several files of a target are compiled as one, in half the time and less.
# flagstone_compile_alone(FILES...) names those that cannot be, since a name in their unnamed namespace is
# also another file's, and those that are generated, which clang-tidy looks for before they are there. Files compiled
# once an instruction set include themselves, and operators new seen where they are called are warned of: both are found here.
function(flagstone_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

function(flagstone_compile_alone_where_needed)
  foreach(source IN LISTS ARGN)
    get_filename_component(path ${source} ABSOLUTE)
    if(EXISTS ${path})
      file(STRINGS ${path} reason REGEX "foreach_target\\.h|^void\\* operator new" LIMIT_COUNT 1)
      if(reason)
        flagstone_compile_alone(${source})
      endif()
    endif()
  endforeach()
endfunction()

# flagstone_library(NAME SOURCES... ) makes the static library flagstone_NAME of the folder src/NAME; its
# headers are included as "NAME/header.hpp".
function(flagstone_library name)
  add_library(flagstone_${name} STATIC ${ARGN})
  flagstone_compile_alone_where_needed(${ARGN})
  target_include_directories(flagstone_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  set_target_properties(flagstone_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  flagstone_compile_options(flagstone_${name})
endfunction()

# flagstone_public_library(NAME FOLDERS folders... [LINK public libraries...]) makes flagstone::NAME, which
# others link and which is installed, of the objects of those folders. It is shared if BUILD_SHARED_LIBS
# says so. Its interface is include/flagstone. Inside this project the folders' own targets are linked
# instead, so that tests see what the interface does not show.
function(flagstone_public_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "FOLDERS;LINK")
  list(TRANSFORM arg_FOLDERS REPLACE "(.+)" "$<TARGET_OBJECTS:flagstone_\\1>" OUTPUT_VARIABLE objects)
  # `flagstone` is the command, flagstone_FOLDER a part; target names are one namespace.
  set(file_name flagstone)
  if(NOT name STREQUAL flagstone)
    set(file_name flagstone_${name})
  endif()
  set(target lib${file_name})
  add_library(${target} ${objects})
  add_library(flagstone::${name} ALIAS ${target})
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${arg_LINK})
  if(core IN_LIST arg_FOLDERS)
    target_link_libraries(${target} PRIVATE Threads::Threads)
    if(NOT TARGET hwy)
      target_link_libraries(${target} PRIVATE hwy::hwy)
    else()
      target_sources(${target} PRIVATE $<TARGET_OBJECTS:hwy>)
    endif()
  endif()
  target_include_directories(
    ${target} INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                        $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  set_target_properties(
    ${target}
    PROPERTIES OUTPUT_NAME ${file_name}
               EXPORT_NAME ${name}
               LINKER_LANGUAGE CXX
               VERSION ${PROJECT_VERSION}
               SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
endfunction()

# flagstone_test(NAME SOURCES... LINK libraries...) makes one GoogleTest program and registers each of
# its tests with ctest as NAME.Suite.Test; under a sanitizer, where starting takes long, all of them as one,
# SANITIZER.NAME, for FLAGSTONE_SANITIZER.
function(flagstone_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;LINK")
  add_executable(${name} ${arg_SOURCES})
  flagstone_compile_alone_where_needed(${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LINK} GTest::gtest_main GTest::gmock)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/tests)
  flagstone_compile_options(${name})
  # Tests are compiled far longer than they run; the headers all of them include are compiled once.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_precompile_headers(${name} REUSE_FROM test_headers)
  if(FLAGSTONE_SANITIZER)
    add_test(NAME ${FLAGSTONE_SANITIZER}.${name} COMMAND ${name} --gtest_brief=1 --gtest_filter=${FLAGSTONE_SANITIZED_FILTER})
    # Tests ask for more memory than there is, and want to be refused.
    set_tests_properties(
      ${FLAGSTONE_SANITIZER}.${name}
      PROPERTIES LABELS sanitizer
                 TIMEOUT 600
                 ENVIRONMENT "ASAN_OPTIONS=allocator_may_return_null=1;TSAN_OPTIONS=allocator_may_return_null=1")
    return()
  endif()
  gtest_discover_tests(
    ${name}
    TEST_PREFIX ${name}.
    DISCOVERY_TIMEOUT 60
    PROPERTIES TIMEOUT 300)
endfunction()
