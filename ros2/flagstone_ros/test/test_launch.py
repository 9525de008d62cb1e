# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Launch files, parameter files and layouts. The launch files are evaluated with a stand-in for launch."""

from __future__ import annotations

import json
import subprocess
import sys
import xml.etree.ElementTree
from pathlib import Path
from typing import Any

import pytest
import yaml
from launch_stand_in import SHARE, nodes

import flagstone
from flagstone_ros import declaration
from flagstone_ros.configuration import configure

LAUNCH = SHARE / "launch"
DEFAULTS = {p.name: p.default for p in declaration.PARAMETERS if p.default is not None}
TOPICS = {topic.name for topic in declaration.TOPICS}
REPOSITORY = SHARE.parents[1]


def parameters_of(node: dict[str, Any]) -> dict[str, Any]:
    """The parameters that a node is started with: of its files, and its own."""
    values: dict[str, Any] = {}
    for source in node["parameters"]:
        values |= source if isinstance(source, dict) else file_parameters(Path(source))
    return values


def file_parameters(file: Path) -> dict[str, Any]:
    content = yaml.safe_load(file.read_text())
    assert list(content) == ["/**"], "the file serves nodes of any name"
    parameters: dict[str, Any] = content["/**"]["ros__parameters"]
    return parameters


@pytest.mark.parametrize("file", sorted(LAUNCH.glob("*")), ids=lambda file: file.name)
def test_every_launch_file_starts_nodes_with_valid_parameters_and_topics(file: Path) -> None:
    found = nodes(file)
    assert found
    for node in found:
        assert (node["package"], node["executable"]) == ("flagstone_ros", "ground_segmentation")
        assert (SHARE / "scripts" / node["executable"]).exists()
        assert {source for source, _ in node["remappings"]} <= TOPICS
        parameters = {name: value for name, value in parameters_of(node).items() if name != "use_sim_time"}
        configuration = configure({**DEFAULTS, **parameters})
        assert set(parameters) <= set(configuration.values)


def test_the_arguments_of_one_sensor_are_used() -> None:
    (node,) = nodes(
        LAUNCH / "ground_segmentation.launch.py",
        {
            "points": "/velodyne",
            "sensor": "vlp-16",
            "namespace": "front",
            "sensor_frame": "lidar",
            "use_sim_time": "true",
        },
    )
    assert ("points", "/velodyne") in node["remappings"]
    assert node["namespace"] == "front"
    parameters = parameters_of(node)
    assert (parameters["sensor"], parameters["sensor_frame"], parameters["use_sim_time"]) == ("vlp-16", "lidar", True)


def test_each_of_several_sensors_has_its_namespace() -> None:
    found = nodes(LAUNCH / "several_sensors.launch.py")
    assert len({node["namespace"] for node in found}) == len(found) > 1


@pytest.mark.parametrize(
    ("file", "ground", "nonground"),
    [
        (
            "nav2_ground_consistency.launch.py",
            "/ground_segmentation/ground_points",
            "/ground_segmentation/obstacle_points",
        ),
        ("patchworkpp_topics.launch.py", "/patchworkpp/ground", "/patchworkpp/nonground"),
    ],
)
def test_topics_of_other_nodes_are_published(file: str, ground: str, nonground: str) -> None:
    (node,) = nodes(LAUNCH / file, {"points": "/velodyne"})
    remappings = dict(node["remappings"])
    assert (remappings["points"], remappings["ground"], remappings["nonground"]) == ("/velodyne", ground, nonground)


def test_parameter_files_of_sensors_are_current() -> None:
    script = REPOSITORY / "scripts" / "ros-sensors"
    done = subprocess.run([sys.executable, script, "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("sensor", [sensor.name for sensor in flagstone.sensors()])
def test_parameter_files_select_their_sensor(sensor: str) -> None:
    configuration = configure({**DEFAULTS, **file_parameters(SHARE / "config" / "sensors" / f"{sensor}.yaml")})
    assert configuration.segmenter.settings == flagstone.Surface(sensor=sensor).settings


def test_layouts_colour_labelled_clouds_by_label_and_by_height() -> None:
    rviz = yaml.safe_load((SHARE / "layouts" / "ground_segmentation.rviz").read_text())
    displays = [d for d in rviz["Visualization Manager"]["Displays"] if d["Class"].endswith("PointCloud2")]
    assert [(d["Topic"]["Value"], d["Channel Name"]) for d in displays] == [
        ("/labelled", "label"),
        ("/labelled", "height"),
    ]
    foxglove = json.loads((SHARE / "layouts" / "ground_segmentation.foxglove.json").read_text())
    panels = [panel for name, panel in foxglove["configById"].items() if name.startswith("3D!")]
    assert [panel["topics"]["/labelled"]["colorField"] for panel in panels] == ["label", "height"]
    assert {"3D!label", "3D!height"} < set(foxglove["configById"])


def test_the_profile_for_large_clouds_is_valid_xml() -> None:
    root = xml.etree.ElementTree.parse(SHARE / "config" / "fastdds_large_clouds.xml").getroot()
    spaces = {"dds": "http://www.eprosima.com/XMLSchemas/fastRTPS_Profiles"}
    defined = {element.text for element in root.findall(".//dds:transport_descriptor/dds:transport_id", spaces)}
    used = {element.text for element in root.findall(".//dds:userTransports/dds:transport_id", spaces)}
    assert defined == used != set()
