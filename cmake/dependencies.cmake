# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT

# The library itself needs nothing. What its command and its tests need: docs/dependencies.md.
if(FLAGSTONE_BUILD_COMMAND OR FLAGSTONE_BUILD_TESTS)
  find_package(fmt REQUIRED)
  find_package(CLI11 REQUIRED)
  find_package(nlohmann_json REQUIRED)
  find_package(tomlplusplus REQUIRED)
  find_package(embree 3 REQUIRED)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
endif()
if(FLAGSTONE_BUILD_TESTS)
  find_package(GTest REQUIRED)
  find_package(rapidcheck REQUIRED)
  find_package(Eigen3 REQUIRED)
  include(GoogleTest)
endif()
