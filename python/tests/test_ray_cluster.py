# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""2,000 scans on a cluster of three nodes, a head and two workers. One test kills a node, one the driver.

Takes a minute or two on two cores: `make test-all` runs it, `make test` does not.
"""

from __future__ import annotations

import os
import signal
import subprocess
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest

import flagstone

pytest.importorskip("ray", reason="needs flagstone[ray]")
cluster_utils = pytest.importorskip("ray.cluster_utils", reason="needs flagstone[ray]")

from conftest import run_command  # noqa: E402
from ray_scans import files, label_with_command  # noqa: E402

import flagstone.ray  # noqa: E402
from flagstone import _command  # noqa: E402

pytestmark = pytest.mark.slow

DISTINCT = 200  # simulated; each scan has ten names, because simulating takes longer than the tests
SCANS = 2000
PATIENCE = 300  # seconds


@pytest.fixture(scope="module")
def scans(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """2,000 scans of an HDL-64E."""
    folder = tmp_path_factory.mktemp("ray") / "scans"
    scenes = ("flat_street", "urban_street", "park", "highway")
    each = DISTINCT // len(scenes)
    for number, scene in enumerate(scenes):
        where = folder.parent / "simulated" / scene
        run_command("simulate", "--scene", scene, "--frames", str(each), "--output", where)
        for copy in range(SCANS // DISTINCT):
            for scan in (where / "sequences" / "00" / "velodyne").iterdir():
                drive = folder / f"{(number + copy) % 8:02}"
                drive.mkdir(parents=True, exist_ok=True)
                (drive / f"{copy}-{scene}-{scan.name}").hardlink_to(scan)
    return folder


@pytest.fixture(scope="module")
def expected(scans: Path) -> dict[str, bytes]:
    """Labels of the command."""
    label_with_command(scans, scans.parent / "expected")
    labels = files(scans.parent / "expected")
    assert len(labels) == SCANS
    return labels


@pytest.fixture
def cluster() -> Iterator[Any]:
    """A head without cores and two nodes with one core each."""
    found = [str(Path(flagstone.__file__).parents[1]), os.environ.get("PYTHONPATH", "")]
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("PYTHONPATH", os.pathsep.join(found))
        patch.setenv("RAY_USAGE_STATS_ENABLED", "0")
        small = {"object_store_memory": 100 * 2**20, "include_dashboard": False}
        cluster = cluster_utils.Cluster(initialize_head=True, head_node_args={"num_cpus": 0, **small})
        for _ in range(2):
            cluster.add_node(num_cpus=1, **small)
        yield cluster
        cluster.shutdown()


def start(cluster: Any, scans: Path, labels: Path) -> subprocess.Popen[str]:
    arguments = [scans, "--output", labels, "--address", cluster.address]
    return subprocess.Popen(
        [str(_command.path()), "ray", *map(str, arguments)],
        env=_command.environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def wait_until(is_so: Callable[[], bool], run: subprocess.Popen[str]) -> None:
    end = time.monotonic() + PATIENCE
    while not is_so():
        assert run.poll() is None, f"ended early: {run.communicate()}"
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.05)


def wait_until_quiet(labels: Path) -> None:
    """Waits until the workers of a killed driver have stopped."""
    count = -1
    while count != label_count(labels):
        count = label_count(labels)
        time.sleep(2)


def label_count(labels: Path) -> int:
    return sum(1 for _ in labels.rglob("*.label"))


def whole(labels: Path) -> dict[str, bytes]:
    """All files except temporary files of killed workers."""
    return {name: data for name, data in files(labels).items() if not Path(name).name.startswith(".flagstone-")}


def with_children(process: int) -> list[int]:
    """A process and its descendants, from /proc."""
    children: dict[int, list[int]] = {}
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            parent = int(stat.read_text().rpartition(")")[2].split()[1])
        except FileNotFoundError:  # the process has ended
            continue
        children.setdefault(parent, []).append(int(stat.parent.name))
    found = [process]
    for one in found:
        found += children.get(one, [])
    return found


def kill_node(node: Any) -> None:
    """Kills all processes of a node at once, like a power failure."""
    started = [information.process.pid for kind in node.all_processes.values() for information in kind]
    for process in {one for each in started for one in with_children(each)}:
        os.kill(process, signal.SIGKILL)


def test_a_killed_node_loses_no_scan(cluster: Any, scans: Path, expected: dict[str, bytes], tmp_path: Path) -> None:
    labels = tmp_path / "labels"
    run = start(cluster, scans, labels)
    wait_until(lambda: label_count(labels) >= SCANS // 3, run)
    kill_node(cluster.worker_nodes.copy().pop())
    at_kill = label_count(labels)
    printed, error = run.communicate(timeout=PATIENCE)
    print(f"{at_kill} labels were written when the node was killed\n{printed}{error}")
    assert at_kill < SCANS, "too late to show anything"
    assert run.returncode == 0, error
    assert f"{SCANS} of {SCANS} scans labelled" in printed
    assert whole(labels) == expected
    frame = flagstone.ray.statistics(labels)
    assert len(frame) == SCANS
    assert frame["node"].nunique() == 2


def test_a_killed_driver_loses_no_label(cluster: Any, scans: Path, expected: dict[str, bytes], tmp_path: Path) -> None:
    labels = tmp_path / "labels"
    run = start(cluster, scans, labels)
    wait_until(lambda: any(labels.glob("flagstone-statistics/*-00001.parquet")), run)
    run.kill()
    run.communicate()
    known = flagstone.ray.statistics(labels)
    assert 0 < len(known) < SCANS, "too late to show anything"
    wait_until_quiet(labels)
    so_far = whole(labels)
    assert so_far.items() <= expected.items(), "existing label files are complete"

    again = start(cluster, scans, labels)
    printed, error = again.communicate(timeout=PATIENCE)
    print(
        f"{len(so_far)} labels were written when the driver was killed, {len(known)} with statistics\n{printed}{error}"
    )
    assert again.returncode == 0, error
    assert f"; {len(so_far)} already labelled" in printed
    assert whole(labels) == expected
    assert len(flagstone.ray.statistics(labels)) == SCANS


@pytest.mark.parametrize("by", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupted_run_reports_the_finished_scans(
    cluster: Any, scans: Path, expected: dict[str, bytes], tmp_path: Path, by: signal.Signals
) -> None:
    labels = tmp_path / "labels"
    run = start(cluster, scans, labels)
    wait_until(lambda: any(labels.glob("flagstone-statistics/*-00001.parquet")), run)
    run.send_signal(by)
    printed, error = run.communicate(timeout=PATIENCE)
    known = len(flagstone.ray.statistics(labels))
    print(printed, error)
    assert run.returncode == 1
    assert f"flagstone: interrupted: {known} of {SCANS} scans are finished (run again to resume)\n" in error
    assert "Traceback" not in error
    assert printed.startswith(f"{known} of {SCANS} scans labelled")
    assert whole(labels).items() <= expected.items()
