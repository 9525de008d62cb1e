# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""`flagstone.simulate` writes sequences with exact ground truth and returns their files. It needs only NumPy."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import flagstone

PARK: dict[str, Any] = {"scene": "park", "sensor": "vlp-16"}
GROUND = (40, 44, 48, 49, 60, 72)


def test_every_scan_has_the_paths_of_its_files(tmp_path: Path) -> None:
    scans = flagstone.simulate(tmp_path, **PARK, frames=12, seed=2, sequence="07")
    assert [scan.frame for scan in scans] == list(range(12))
    assert [scan.drive for scan in scans] == [0] * 10 + [1] * 2
    assert {scan.sequence for scan in scans} == {"07"}
    poses = np.loadtxt(tmp_path / "sequences" / "07" / "poses.txt").reshape(-1, 3, 4)
    for scan in scans:
        points = flagstone.io.read(scan.scan)
        classes = flagstone.io.read_labels(scan.labels, len(points))
        assert len(points) == scan.points == len(np.load(scan.ground)) == len(np.load(scan.returns))
        assert scan.ground_share == np.isin(classes, GROUND).mean()
        assert (scan.x, scan.y, scan.z) == tuple(poses[scan.frame, :, 3])


def test_scans_convert_to_a_data_frame(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas", reason="pandas is not installed: pip install 'flagstone[pandas]'")
    scans = flagstone.simulate(tmp_path, **PARK, frames=2)
    assert pandas.DataFrame(scans)["points"].tolist() == [scan.points for scan in scans]


def test_pandas_is_not_needed(tmp_path: Path) -> None:
    program = f"import sys; sys.modules['pandas'] = None; import flagstone; flagstone.simulate({str(tmp_path)!r}, "
    subprocess.run([sys.executable, "-c", program + "scene='park', sensor='vlp-16', frames=1)"], check=True)


def test_simulated_scans_can_be_evaluated(tmp_path: Path) -> None:
    pytest.importorskip("pandas", reason="pandas is not installed: pip install 'flagstone[pandas]'")
    flagstone.simulate(tmp_path, **PARK, frames=2)
    assert flagstone.evaluate(tmp_path, methods=["patchwork"]).methods["scans"].item() == 2


def test_more_frames_extend_a_sequence(tmp_path: Path) -> None:
    first = flagstone.simulate(tmp_path, **PARK, frames=1)
    made = Path(first[0].scan).stat().st_mtime_ns
    more = flagstone.simulate(tmp_path, **PARK, frames=3)
    assert len(more) == 3
    assert Path(more[0].scan).stat().st_mtime_ns == made


def test_every_argument_reaches_the_simulator(tmp_path: Path) -> None:
    import json

    flagstone.simulate(
        tmp_path,
        **PARK,
        sensor_height=2.5,
        tilt=(15, -5),
        noise="harsh",
        weather=["rain", "dust"],
        keep_no_returns=True,
        frames=1,
        rate=10,
        speed=5,
        pose_noise="drift",
        seed=9,
        threads=1,
    )
    made = json.loads((tmp_path / "sequences" / "00" / "scene.json").read_text())
    assert made["mount"] == {"height": 2.5, "pitch": 15, "roll": -5}
    assert (made["scene"], made["sensor"]["name"], made["noise"]["name"]) == ("park", "vlp-16", "harsh")
    assert (made["weather"], made["no_returns_kept"], made["seed"]) == (["rain", "dust"], True, 9)
    assert (made["rate"], made["speed"], made["pose_noise"]) == (10, 5, "drift")


def test_a_continuous_run_has_more_scans_per_environment_and_marks_what_moves(tmp_path: Path) -> None:
    scans = flagstone.simulate(tmp_path, scene="urban_street", sensor="vlp-16", rate=2, frames=20, seed=2)

    assert [scan.drive for scan in scans] == [0] * 19 + [1]
    assert [after.x - before.x for before, after in pairwise(scans[:19])] == pytest.approx([4] * 18, abs=1.2)
    motion = np.load(scans[5].motion)
    classes = np.fromfile(scans[5].labels, "<u4")
    assert motion.shape == (scans[5].points,)
    assert (motion == 2).any()
    np.testing.assert_array_equal(motion == 2, classes >= 252)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"scene": "parc"}, "scene: no scene is named 'parc' \\(expected flat_street"),
        ({"sensor": "vlp-17"}, "sensor: "),
        ({"weather": "hail"}, "weather: no weather is named 'hail' \\(expected clear"),
        ({"tilt": (1,)}, "tilt: '1' is not PITCH,ROLL"),
        ({"frames": 0}, "frames: 0 is out of range \\(expected 1 to 100000\\)"),
        ({"rate": 0}, "rate: 0 is out of range \\(expected 0.1 to 100 scans per second\\)"),
        ({"speed": float("nan")}, "speed: nan is out of range"),
        ({"pose_noise": "jiter"}, "pose-noise: no pose noise is named 'jiter' \\(did you mean 'jitter'|expected none"),
        ({"seed": 2**64}, "seed: 18446744073709551616 is out of range"),
        ({"seed": -1}, "seed: -1 is out of range"),
        ({"sensor_height": float("nan")}, "sensor_height: nan is out of range"),
        ({"keep_no_returns": True, "sequence": "7"}, "sequence: '7' is not a sequence"),
    ],
)
def test_an_invalid_argument_raises_a_one_line_error_with_its_name(
    tmp_path: Path, arguments: dict[str, Any], message: str
) -> None:
    with pytest.raises(ValueError, match=message) as caught:
        flagstone.simulate(tmp_path / "out", **(PARK | {"frames": 1} | arguments))
    assert "\n" not in str(caught.value)
    assert not (tmp_path / "out").exists()


def test_a_directory_with_another_simulation_is_rejected(tmp_path: Path) -> None:
    flagstone.simulate(tmp_path, **PARK, frames=1)
    with pytest.raises(ValueError, match=r"scene\.json: its seed differs from the one you requested"):
        flagstone.simulate(tmp_path, **PARK, frames=1, seed=2)


def test_a_directory_that_cannot_be_created_raises_oserror(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError, match="cannot be created: Not a directory"):
        flagstone.simulate(tmp_path / "file" / "out", **PARK, frames=1)


def test_an_interrupt_ends_the_simulator_and_the_next_call_resumes(tmp_path: Path) -> None:
    program = f"import flagstone; flagstone.simulate({str(tmp_path)!r}, scene='park', sensor='vlp-16', frames=40)"
    process = subprocess.Popen([sys.executable, "-c", program], stderr=subprocess.PIPE, text=True)
    folder = tmp_path / "sequences" / "00" / "velodyne"
    while process.poll() is None and not (folder / "000003.bin").exists():
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)
    _, error = process.communicate(timeout=60)
    assert process.returncode == -signal.SIGINT, error
    assert error.rstrip().endswith("KeyboardInterrupt")
    made = sorted(folder.iterdir())
    assert 3 < len(made) < 40
    time.sleep(0.3)
    assert sorted(folder.iterdir()) == made  # the simulator has stopped too
    assert not list(tmp_path.rglob("*.tmp"))
    times = [file.stat().st_mtime_ns for file in made]
    assert len(flagstone.simulate(tmp_path, **PARK, frames=40)) == 40
    assert [file.stat().st_mtime_ns for file in made] == times


def test_progress_is_shown_on_a_terminal(tmp_path: Path) -> None:
    import os
    import pty

    program = f"import flagstone; flagstone.simulate({str(tmp_path)!r}, scene='park', sensor='vlp-16', frames=4)"
    read_end, write_end = pty.openpty()
    environment = os.environ | {"COLUMNS": "40"}
    process = subprocess.Popen([sys.executable, "-c", program], stderr=write_end, env=environment)
    os.close(write_end)
    drawn = b""
    try:
        while some := os.read(read_end, 1 << 16):
            drawn += some
    except OSError:  # the terminal is closed
        pass
    os.close(read_end)
    assert process.wait() == 0
    lines = drawn.decode().split("\r\x1b[K")
    assert any("0 of 4 scans" in line for line in lines)
    assert max(map(len, lines)) < 40  # a longer line would wrap and remain on the terminal
    assert lines[-1] == ""  # cleared at the end


def test_nothing_is_printed_without_a_terminal(tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    flagstone.simulate(tmp_path, **PARK, frames=2)
    assert capfd.readouterr() == ("", "")
