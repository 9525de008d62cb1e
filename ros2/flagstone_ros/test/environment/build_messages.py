# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Builds the message packages that the tests need and the wheels lack, in the environment that runs this program.

    build-python/ros-kilted-3.11/bin/python ros2/flagstone_ros/test/environment/build_messages.py

The generators of rosidl, which the wheels contain, write C from the interfaces below. Needs a C and a C++ compiler.
"""

from __future__ import annotations

import json
import pathlib
import subprocess
import sys
import sysconfig
import tempfile

import numpy
import rosidl_typesupport_c
import rosidl_typesupport_fastrtps_c
import rosidl_typesupport_introspection_c
from rosidl_generator_c import generate_c
from rosidl_generator_py import generate_py
from rosidl_generator_type_description import generate_type_hash

# Per package: the members of each message as IDL, and the messages of other packages in them.
PACKAGES = {
    "tf2_msgs": (
        {"TFMessage": "sequence<geometry_msgs::msg::TransformStamped> transforms;"},
        ["geometry_msgs/msg/TransformStamped"],
    ),
    "livox_ros_driver2": (
        {
            "CustomPoint": "uint32 offset_time; float x; float y; float z; uint8 reflectivity; uint8 tag; uint8 line;",
            "CustomMsg": "std_msgs::msg::Header header; uint64 timebase; uint32 point_num; uint8 lidar_id; "
            "uint8 rsvd[3]; sequence<livox_ros_driver2::msg::CustomPoint> points;",
        },
        ["std_msgs/msg/Header"],
    ),
}
FILE_NAMES = {"TFMessage": "tf_message", "CustomPoint": "custom_point", "CustomMsg": "custom_msg"}

PREFIX = pathlib.Path(sys.prefix)
SITE = pathlib.Path(sysconfig.get_path("purelib"))
TRANSPORTS = ("rosidl_typesupport_fastrtps_c", "rosidl_typesupport_introspection_c")
DEPENDENCIES = ("geometry_msgs", "std_msgs", "builtin_interfaces")

VISIBILITY = """\
#include <rosidl_runtime_c/visibility_control.h>
#define ROSIDL_GENERATOR_C_PUBLIC_{package} __attribute__((visibility("default")))
#define ROSIDL_TYPESUPPORT_FASTRTPS_C_PUBLIC_{package} __attribute__((visibility("default")))
#define ROSIDL_TYPESUPPORT_FASTRTPS_C_IMPORT_{package}
#define ROSIDL_TYPESUPPORT_INTROSPECTION_C_PUBLIC_{package} __attribute__((visibility("default")))
#define ROSIDL_TYPESUPPORT_INTROSPECTION_C_IMPORT_{package}
#define ROSIDL_TYPESUPPORT_INTROSPECTION_C_EXPORT_{package}
"""


def write_interfaces(package: str, sources: pathlib.Path) -> list[str]:
    """Writes the interfaces as IDL; a struct of rsvd[3] is an array type, which IDL names with a typedef."""
    messages, included = PACKAGES[package]
    (sources / "msg").mkdir(parents=True)
    for message, members in messages.items():
        names = [*included, *(f"{package}/msg/{other}" for other in messages if f"::{other}>" in members)]
        includes = "".join(f'#include "{name}.idl"\n' for name in names)
        typedef = "typedef uint8 uint8__3[3];" if "rsvd[3]" in members else ""
        members = members.replace("uint8 rsvd[3];", "uint8__3 rsvd;")
        text = f"{includes}module {package} {{ module msg {{ {typedef} struct {message} {{ {members} }}; }}; }};\n"
        (sources / "msg" / f"{message}.idl").write_text(text)
    return [f"msg/{message}.idl" for message in messages]


def generate(package: str, sources: pathlib.Path) -> None:
    """Runs the generators. Output: `sources`/PACKAGE (C and C++) and `sources`/python."""
    interfaces = write_interfaces(package, sources)
    share = PREFIX / "share"
    known = [f"{name}:{file}" for name in DEPENDENCIES for file in (share / name / "msg").glob("*.idl")]
    own = [f"{package}:{sources / interface}" for interface in interfaces]
    for name, generator, more, output in (
        ("rosidl_generator_type_description", generate_type_hash, (), sources / package),
        ("rosidl_generator_c", generate_c, (), sources / package),
        ("rosidl_typesupport_c", rosidl_typesupport_c.generate_c, (list(TRANSPORTS),), sources / package),
        (
            "rosidl_typesupport_fastrtps_c",
            rosidl_typesupport_fastrtps_c.generate_typesupport_fastrtps_c,
            (),
            sources / package,
        ),
        (
            "rosidl_typesupport_introspection_c",
            rosidl_typesupport_introspection_c.generate_c,
            (),
            sources / "introspection" / package,  # the names of its files are those of rosidl_generator_c
        ),
        ("rosidl_generator_py", generate_py, (["rosidl_typesupport_c"],), sources / "python" / package),
    ):
        arguments = {
            "package_name": package,
            "output_dir": str(output),
            "template_dir": str(share / name / "resource"),
            "idl_tuples": [f"{sources}:{interface}" for interface in interfaces],
            "ros_interface_dependencies": [*known, *own],
            "target_dependencies": [],
            "type_description_tuples": [
                f"{interface}:{sources / package / interface.replace('.idl', '.json')}" for interface in interfaces
            ],
            "include_paths": [f"{name}:{share / name}" for name in DEPENDENCIES],
        }
        output.mkdir(parents=True, exist_ok=True)
        file = sources / f"{name}.json"
        file.write_text(json.dumps(arguments))
        generator(str(file), *more)
    for name in ("rosidl_generator_c", *TRANSPORTS):
        header = sources / package / "msg" / f"{name}__visibility_control.h"
        header.write_text(VISIBILITY.format(package=package))


def build(package: str, sources: pathlib.Path) -> None:
    """Compiles the generated code into the environment."""
    messages, _ = PACKAGES[package]
    c, python = sources / package / "msg", sources / "python" / package
    files = [FILE_NAMES[message] for message in messages]

    def library(kind: str) -> str:
        return f"{package}__{kind}"

    def link(compiler: str, output: pathlib.Path, inputs: list[pathlib.Path], libraries: list[str]) -> None:
        includes = [sources, sources / "introspection", PREFIX / "include", *(PREFIX / "include").iterdir()]
        if output.parent == SITE / package:
            includes += [sysconfig.get_path("include"), numpy.get_include()]
        # The wheels hide the locations of some libraries from the linker; the loader finds them.
        command = [compiler, "-O1", "-fPIC", "-shared", "-Wl,--allow-shlib-undefined", "-o", output, *inputs]
        command += [f"-I{path}" for path in includes]
        command += [f"-L{PREFIX / 'lib'}", *(f"-l{name}" for name in libraries)]
        subprocess.run(command, check=True)

    def in_lib(kind: str) -> pathlib.Path:
        return PREFIX / "lib" / f"lib{library(kind)}.so"

    generated = [
        c / "detail" / f"{file}__{part}.c" for file in files for part in ("functions", "description", "type_support")
    ]
    own = "rosidl_generator_c"
    link("cc", in_lib(own), generated, [f"{name}__{own}" for name in DEPENDENCIES] + ["rosidl_runtime_c", "rcutils"])
    transport, introspection = TRANSPORTS
    needed = [library(own), *(f"{name}__{transport}" for name in DEPENDENCIES), transport, f"{transport}pp"]
    link("c++", in_lib(transport), [c / "detail" / f"{file}__type_support_c.cpp" for file in files], needed)
    introspected = sources / "introspection" / package / "msg" / "detail"
    needed = [library(own), *(f"{name}__{introspection}" for name in DEPENDENCIES), introspection]
    link("cc", in_lib(introspection), [introspected / f"{file}__type_support.c" for file in files], needed)
    dispatch = "rosidl_typesupport_c"
    needed = [library(transport), library(introspection), library(own), dispatch]
    link("c++", in_lib(dispatch), [c / f"{file}__type_support.cpp" for file in files], needed)
    (SITE / package / "msg").mkdir(parents=True, exist_ok=True)
    (SITE / package / "__init__.py").touch()
    for source in (python / "msg").glob("*.py"):
        (SITE / package / "msg" / source.name).write_text(source.read_text())
    extension = [python / f"_{package}_s.ep.{dispatch}.c", *(python / "msg").glob("*_s.c")]
    needed = [library(dispatch), library(own), *(f"{name}__rosidl_generator_py" for name in DEPENDENCIES), dispatch]
    link("cc", SITE / package / f"{package}_s__{dispatch}.so", extension, needed)


def main() -> None:
    """Builds all packages."""
    for package in PACKAGES:
        with tempfile.TemporaryDirectory() as directory:
            generate(package, pathlib.Path(directory))
            build(package, pathlib.Path(directory))


if __name__ == "__main__":
    main()
