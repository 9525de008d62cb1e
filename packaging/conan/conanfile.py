# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Conan recipe of the library, for the checkout that contains it: conan create packaging/conan."""

import re
from pathlib import Path

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, rmdir

ROOT = Path(__file__).resolve().parents[2]  # only while the recipe is exported


class Flagstone(ConanFile):
    """The libraries flagstone::flagstone and flagstone::baselines."""

    name = "flagstone"
    description = "Ground segmentation for 3D LiDAR"
    license = "MIT"
    topics = ("lidar", "point-cloud", "ground-segmentation", "robotics")
    package_type = "library"
    settings = "os", "compiler", "build_type", "arch"
    options = {"shared": [True, False]}
    default_options = {"shared": False}

    def set_version(self):
        text = (ROOT / "include/flagstone/version.hpp").read_text(encoding="utf-8")
        self.version = re.search(r'#define FLAGSTONE_VERSION "(.+)"', text)[1]

    def export_sources(self):
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "include/*", "sensors/*", "src/library/*"):
            copy(self, pattern, ROOT, self.export_sources_folder)
        copy(self, "src/lab/baselines/*", ROOT, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        self.requires("highway/[>=1.0.3 <2]")

    def validate(self):
        check_min_cppstd(self, 20)

    def generate(self):
        dependencies = CMakeDeps(self)
        dependencies.set_property("highway", "cmake_file_name", "hwy")
        dependencies.set_property("highway", "cmake_target_name", "hwy::hwy")
        dependencies.generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["FLAGSTONE_BUILD_COMMAND"] = False
        toolchain.cache_variables["FLAGSTONE_BUILD_EXAMPLES"] = False
        toolchain.cache_variables["CMAKE_UNITY_BUILD"] = True
        toolchain.cache_variables["FETCHCONTENT_FULLY_DISCONNECTED"] = True
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, Path(self.package_folder) / "licenses")
        # Conan writes these files for the program that uses the package.
        rmdir(self, Path(self.package_folder) / "lib" / "cmake")
        rmdir(self, Path(self.package_folder) / "lib" / "pkgconfig")
        rmdir(self, Path(self.package_folder) / "share")

    def package_info(self):
        library = self.cpp_info.components["flagstone"]
        library.libs = ["flagstone"]
        library.set_property("cmake_target_name", "flagstone::flagstone")
        library.set_property("pkg_config_name", "flagstone")
        if any(dependency.ref.name == "highway" for dependency in self.dependencies.host.values()):
            library.requires = ["highway::highway"]
        else:  # the profile declares the Highway of the system
            library.system_libs = ["hwy"]
        if self.settings.os == "Linux":
            library.system_libs.append("pthread")
        baselines = self.cpp_info.components["baselines"]
        baselines.libs = ["flagstone_baselines"]
        baselines.requires = ["flagstone"]
        baselines.set_property("cmake_target_name", "flagstone::baselines")
