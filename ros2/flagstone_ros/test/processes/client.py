# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Reads and sets parameters of the node, and reads its diagnostics. Runs in an environment with ROS 2.

client.py get NAME...              one line of JSON per parameter: [name, value]
client.py describe NAME...         one line per parameter: {name, description, ...}
client.py set NAME=JSON... [/ NAME=JSON...]...
                                   sets each group at once, one line per group: {"successful": ..., "reason": ...}
client.py diagnostics COUNT        one line per message: {level, name, message, values}
"""

from __future__ import annotations

import json
import sys
import time
from typing import Any

import rclpy
from diagnostic_msgs.msg import DiagnosticArray
from rcl_interfaces.msg import Parameter as ParameterMessage
from rcl_interfaces.srv import DescribeParameters, GetParameters, SetParametersAtomically
from rclpy.parameter import Parameter, parameter_value_to_python

NODE = "/ground_segmentation"


def call(node: Any, service: Any, name: str, request: Any) -> Any:
    """The response of a service of the node."""
    client = node.create_client(service, f"{NODE}/{name}")
    if not client.wait_for_service(timeout_sec=20):
        sys.exit(f"no service {NODE}/{name}")
    future = client.call_async(request)
    rclpy.spin_until_future_complete(node, future, timeout_sec=20)
    return future.result()


def plain(value: Any) -> Any:
    """A value that JSON can represent."""
    return list(value) if hasattr(value, "typecode") else value


def main() -> None:
    """Runs one command."""
    verb, *words = sys.argv[1:]
    rclpy.init(args=[])
    node = rclpy.create_node("client")
    if verb == "get":
        response = call(node, GetParameters, "get_parameters", GetParameters.Request(names=words))
        for name, value in zip(words, response.values, strict=True):
            print(json.dumps([name, plain(parameter_value_to_python(value))]))
    elif verb == "describe":
        response = call(node, DescribeParameters, "describe_parameters", DescribeParameters.Request(names=words))
        for described in response.descriptors:
            ranges = [*described.floating_point_range, *described.integer_range]
            line = {
                "name": described.name,
                "description": described.description,
                "constraints": described.additional_constraints,
                "read_only": described.read_only,
                "range": [ranges[0].from_value, ranges[0].to_value] if ranges else None,
            }
            print(json.dumps(line))
    elif verb == "set":
        for group in " ".join(words).split(" / "):
            pairs = [word.split("=", 1) for word in group.split()]
            parameters: list[ParameterMessage] = [
                Parameter(name, value=json.loads(value)).to_parameter_msg() for name, value in pairs
            ]
            request = SetParametersAtomically.Request(parameters=parameters)
            result = call(node, SetParametersAtomically, "set_parameters_atomically", request).result
            print(json.dumps({"successful": result.successful, "reason": result.reason}))
    elif verb == "diagnostics":
        left = int(words[0])

        def show(message: DiagnosticArray) -> None:
            nonlocal left
            left -= 1
            for status in message.status:
                values = {value.key: value.value for value in status.values}
                line = {"level": status.level[0], "name": status.name, "message": status.message, "values": values}
                print(json.dumps(line), flush=True)

        node.create_subscription(DiagnosticArray, "/diagnostics", show, 10)
        deadline = time.monotonic() + 30
        while left > 0 and time.monotonic() < deadline:
            rclpy.spin_once(node, timeout_sec=0.2)
    node.destroy_node()
    rclpy.shutdown()


if __name__ == "__main__":
    main()
