# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# The install tree: the library, its headers, the files for CMake and pkg-config, the command with its manual pages and
# completions, and the licence. It is relocatable.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/flagstone)
# Users of a static library must also link its dependencies: threads, the system Highway and, in programs of other languages,
# the standard libraries of C++ and C. rustc links the one of C too early.
set(find_dependencies "")
set(highway_of_pkgconfig "")
set(cxx_library_of_pkgconfig "")
if(NOT BUILD_SHARED_LIBS)
  string(APPEND find_dependencies "include(CMakeFindDependencyMacro)\nfind_dependency(Threads)\n")
  if(NOT TARGET hwy)
    string(APPEND find_dependencies "find_dependency(hwy)\n")
    set(highway_of_pkgconfig "Requires: libhwy")
  endif()
  foreach(library IN LISTS CMAKE_CXX_IMPLICIT_LINK_LIBRARIES)
    if(library MATCHES "^(stdc\\+\\+|c\\+\\+|m|c)$")
      string(APPEND cxx_library_of_pkgconfig " -l${library}")
    endif()
  endforeach()
endif()
file(
  WRITE ${PROJECT_BINARY_DIR}/flagstoneConfig.cmake
  "${find_dependencies}include(\${CMAKE_CURRENT_LIST_DIR}/flagstoneTargets.cmake)\n")
write_basic_package_version_file(
  ${PROJECT_BINARY_DIR}/flagstoneConfigVersion.cmake COMPATIBILITY SameMinorVersion)

file(RELATIVE_PATH prefix_of_pkgconfig /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
file(
  CONFIGURE
  OUTPUT ${PROJECT_BINARY_DIR}/flagstone.pc
  @ONLY
  CONTENT
    [[
prefix=${pcfiledir}/@prefix_of_pkgconfig@
Name: flagstone
Description: @PROJECT_DESCRIPTION@
Version: @PROJECT_VERSION@
@highway_of_pkgconfig@
Cflags: -I${prefix}/@CMAKE_INSTALL_INCLUDEDIR@
Libs: -L${prefix}/@CMAKE_INSTALL_LIBDIR@ -lflagstone -pthread@cxx_library_of_pkgconfig@
]])

install(TARGETS libflagstone libflagstone_baselines EXPORT flagstone)
install(
  EXPORT flagstone
  NAMESPACE flagstone::
  FILE flagstoneTargets.cmake
  DESTINATION ${config_folder})
install(FILES ${PROJECT_BINARY_DIR}/flagstoneConfig.cmake ${PROJECT_BINARY_DIR}/flagstoneConfigVersion.cmake
        DESTINATION ${config_folder})
install(FILES ${PROJECT_BINARY_DIR}/flagstone.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/flagstone DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(FLAGSTONE_BUILD_COMMAND)
  install(TARGETS flagstone)

  # Manual pages and completions. The command writes them, so a cross build needs CMAKE_CROSSCOMPILING_EMULATOR.
  set(shell_files ${PROJECT_BINARY_DIR}/shell_files)
  add_custom_command(
    OUTPUT ${shell_files}/man1/flagstone.1
    COMMAND ${CMAKE_COMMAND} -DCOMMAND=$<TARGET_FILE:flagstone> "-DRUN_BY=${CMAKE_CROSSCOMPILING_EMULATOR}"
            -DOUTPUT=${shell_files} -P ${PROJECT_SOURCE_DIR}/cmake/shell_files.cmake
    DEPENDS flagstone ${PROJECT_SOURCE_DIR}/cmake/shell_files.cmake
    COMMENT "Writing manual pages and completions"
    VERBATIM)
  add_custom_target(flagstone_shell_files ALL DEPENDS ${shell_files}/man1/flagstone.1)
  install(DIRECTORY ${shell_files}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR})
  install(FILES ${shell_files}/bash/flagstone DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${shell_files}/zsh/_flagstone DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES ${shell_files}/fish/flagstone.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()
