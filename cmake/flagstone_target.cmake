# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# Options of every target. Results must not depend on the compiler: no contraction of a * b + c (the default of GCC) and
# no fast-math. -fno-trapping-math is allowed, because nothing reads floating-point exceptions; it changes no result and
# lets GCC vectorise loops that select between two values.
#
# The presets compile the files of a directory together (CMAKE_UNITY_BUILD), which takes less than half the time. A name
# in an unnamed namespace must therefore be unique in its directory, and shadowing is reported only in builds without
# CMAKE_UNITY_BUILD. Two kinds of files are always compiled alone: files that are compiled once per instruction set,
# because they include themselves, and files that replace operator new, because the compiler warns if it sees the calls.
function(flagstone_compile_options target)
  target_compile_features(${target} PUBLIC cxx_std_20)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_options(
    ${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -ffp-contract=off
                      -fno-trapping-math $<$<NOT:$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wshadow>
                      $<$<BOOL:${FLAGSTONE_WARNINGS_AS_ERRORS}>:-Werror>)
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source)
    if(EXISTS ${source})
      file(STRINGS ${source} reason REGEX "foreach_target\\.h|^void\\* operator new" LIMIT_COUNT 1)
    endif()
    if(reason OR NOT EXISTS ${source}) # generated files do not exist when clang-tidy runs
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endfunction()

# flagstone_library(NAME SOURCES...) adds the static library flagstone_NAME of a directory in src. Its headers are
# included by their path from src. Directories that parse, format and print are not time-critical; with -O1, GCC compiles
# them in two thirds of the time.
function(flagstone_library name)
  add_library(flagstone_${name} STATIC ${ARGN})
  target_include_directories(flagstone_${name} PUBLIC ${PROJECT_SOURCE_DIR}/src)
  if(NOT CMAKE_SYSTEM_PROCESSOR MATCHES "^wasm") # has no shared libraries
    set_target_properties(flagstone_${name} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  endif()
  flagstone_compile_options(flagstone_${name})
  cmake_path(RELATIVE_PATH CMAKE_CURRENT_SOURCE_DIR BASE_DIRECTORY ${PROJECT_SOURCE_DIR}/src OUTPUT_VARIABLE folder)
  set_target_properties(flagstone_${name} PROPERTIES FLAGSTONE_FOLDER ${folder})
  set_property(GLOBAL APPEND PROPERTY FLAGSTONE_LIBRARIES flagstone_${name})
  if(folder MATCHES "^(app|cli|lab/report)" AND CMAKE_CXX_FLAGS_RELEASE MATCHES "-O3")
    target_compile_options(flagstone_${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
endfunction()

# `flagstone_public_library(NAME FOLDERS FOLDER... [LINK LIBRARY...])` adds the public, installed library flagstone::NAME
# from the objects of directories in src. It is shared if BUILD_SHARED_LIBS is ON; its name then ends in FLAGSTONE_ABI.
# Its interface is include/flagstone.
# Targets of this project link the targets of the directories instead, so that tests can use internal headers.
function(flagstone_public_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "FOLDERS;LINK")
  list(TRANSFORM arg_FOLDERS REPLACE "(.+)" "$<TARGET_OBJECTS:flagstone_\\1>" OUTPUT_VARIABLE objects)
  # Target names share one namespace: `flagstone` is the command, `flagstone_FOLDER` a part of the library.
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
               SOVERSION ${FLAGSTONE_ABI})
endfunction()

# flagstone_test(NAME SOURCES... LINK libraries... [SHARDS n]) adds a GoogleTest program and registers it with ctest: as
# NAME, as NAME.1 to NAME.n with SHARDS, or as SANITIZER.NAME in a build with sanitizers.
function(flagstone_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "SHARDS" "SOURCES;LINK")
  if(NOT FLAGSTONE_BUILD_PROPERTY_TESTS)
    list(REMOVE_ITEM arg_LINK rapidcheck rapidcheck_gtest)
    foreach(source IN LISTS arg_SOURCES)
      cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE path)
      file(STRINGS ${path} include REGEX "#include .*(rapidcheck|_generator\\.hpp)" LIMIT_COUNT 1)
      if(include)
        list(REMOVE_ITEM arg_SOURCES ${source})
      endif()
    endforeach()
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LINK} GTest::gtest_main GTest::gmock)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/src ${PROJECT_SOURCE_DIR}/tests)
  flagstone_compile_options(${name})
  # Tests take longer to compile than to run. The headers that all tests include are precompiled.
  target_compile_options(${name} PRIVATE $<$<CONFIG:Release>:-O1>)
  target_precompile_headers(${name} REUSE_FROM test_headers)
  if(FLAGSTONE_SANITIZER)
    add_test(NAME ${FLAGSTONE_SANITIZER}.${name} COMMAND ${name} --gtest_brief=1
                                                         --gtest_filter=${FLAGSTONE_SANITIZED_FILTER})
    # Some tests request more memory than the system has, and expect an error.
    set_tests_properties(
      ${FLAGSTONE_SANITIZER}.${name}
      PROPERTIES LABELS sanitizer
                 TIMEOUT 900
                 ENVIRONMENT "ASAN_OPTIONS=allocator_may_return_null=1;TSAN_OPTIONS=allocator_may_return_null=1")
    return()
  endif()
  if(NOT arg_SHARDS)
    add_test(NAME ${name} COMMAND ${name} --gtest_brief=1)
    set_tests_properties(${name} PROPERTIES TIMEOUT 600)
    return()
  endif()
  foreach(shard RANGE 1 ${arg_SHARDS})
    math(EXPR index "${shard} - 1")
    add_test(NAME ${name}.${shard} COMMAND ${name} --gtest_brief=1)
    set_tests_properties(
      ${name}.${shard} PROPERTIES TIMEOUT 600 ENVIRONMENT "GTEST_TOTAL_SHARDS=${arg_SHARDS};GTEST_SHARD_INDEX=${index}")
  endforeach()
endfunction()
