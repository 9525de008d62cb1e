# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# The install tree: the library, its headers, what CMake and pkg-config need to find it, the command
# and the licence. It can be moved.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/flagstone)
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
Cflags: -I${prefix}/@CMAKE_INSTALL_INCLUDEDIR@
Libs: -L${prefix}/@CMAKE_INSTALL_LIBDIR@ -lflagstone
]])

install(TARGETS libflagstone libflagstone_baselines EXPORT flagstone)
install(
  EXPORT flagstone
  NAMESPACE flagstone::
  FILE flagstoneConfig.cmake
  DESTINATION ${config_folder})
install(FILES ${PROJECT_BINARY_DIR}/flagstoneConfigVersion.cmake DESTINATION ${config_folder})
install(FILES ${PROJECT_BINARY_DIR}/flagstone.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/flagstone DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
if(FLAGSTONE_BUILD_COMMAND)
  install(TARGETS flagstone)
endif()
