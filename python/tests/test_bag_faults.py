# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""`flagstone bag` with invalid arguments, damaged input, a full disk, and when it is killed or interrupted."""

from __future__ import annotations

import json
import os
import resource
import signal
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest

import flagstone
from flagstone import _command

pytest.importorskip("rosbags", reason="needs rosbags, of the test dependencies")

from bag_scenes import (
    FORMATS,
    START,
    Record,
    bag_name,
    cloud,
    image,
    imu,
    odometry,
    of_topic,
    read_bag,
    run,
    scans,
    scene,
    write_bag,
)


@pytest.fixture(scope="module")
def drive(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A bag of three clouds."""
    return write_bag(tmp_path_factory.mktemp("drive") / "drive.bag", "rosbag1", scene("rosbag1", scans(3)))


def only_line(text: str) -> str:
    """The text, which must be one line that begins with the name of the command."""
    (line,) = text.splitlines()
    assert line.startswith("flagstone: ")
    return line.removeprefix("flagstone: ")


def files_in(folder: Path) -> list[str]:
    """The names of all files in a directory, including hidden ones."""
    return sorted(path.name for path in folder.iterdir())


class TestUsage:
    """Usage errors are one line with exit code 2, and nothing is written."""

    @pytest.mark.parametrize(
        ("options", "message"),
        [
            (
                ["--topic", "/nothing"],
                "'/nothing' is not a topic of point clouds (expected one of /points (3 messages))",
            ),
            (["--topic", "/camera"], "'/camera' is not a topic of point clouds"),
            (
                ["--imu", "/camera"],
                "/camera: has type sensor_msgs/msg/Image (expected a topic of sensor_msgs/msg/Imu: /imu",
            ),
            (["--imu", "/nothing"], "/nothing: is not a topic of this bag"),
            (["--tf", "roof"], "does not connect frame 'lidar' with frame 'roof' (the frames in it: base_link, lidar)"),
            (["--format", "labeled"], "labeled"),
            (["--threads", "0"], "--threads: 0 is out of range"),
            (["--threads", "2", "--sensor-height", "track"], "threads"),
            (["--method", "surfaces"], "did you mean 'surface'?"),
            (["--imu", "/imu", "--tilt", "estimate"], "cannot be combined with"),
            (["--out-put"], "--out-put: is not an option of this command"),
            (["third.bag"], "third.bag: unexpected argument"),
        ],
    )
    def test_invalid_options_are_rejected(self, drive: Path, tmp_path: Path, options: list[str], message: str) -> None:
        done = run("bag", drive, tmp_path / "out.bag", *options)
        assert done.returncode == 2
        assert message in only_line(done.stderr)
        assert files_in(tmp_path) == []

    def test_several_topics_of_point_clouds_are_listed(self, tmp_path: Path) -> None:
        records = [*scene("rosbag1", scans(2)), ("/rear", START, cloud("rosbag1", scans(1)[0], START))]
        source = write_bag(tmp_path / "drive.bag", "rosbag1", sorted(records, key=lambda record: record[1]))
        done = run("bag", source, tmp_path / "out.bag")
        assert done.returncode == 2
        line = only_line(done.stderr)
        assert "2 topics of point clouds" in line
        assert "--topic" in line
        assert "/points (2 messages), /rear (1 messages)" in line

    def test_a_bag_without_point_clouds_is_rejected_with_its_topics(self, tmp_path: Path) -> None:
        records: list[Record] = [("/odom", START, odometry("rosbag1", START)), ("/imu", START, imu("rosbag1", START))]
        source = write_bag(tmp_path / "drive.bag", "rosbag1", records)
        done = run("bag", source, tmp_path / "out.bag")
        assert done.returncode == 2
        line = only_line(done.stderr)
        assert "no topic of point clouds" in line
        assert "/imu (sensor_msgs/msg/Imu), /odom (nav_msgs/msg/Odometry)" in line

    def test_an_imu_in_a_frame_without_transform_is_rejected(self, tmp_path: Path) -> None:
        source = write_bag(tmp_path / "drive.bag", "rosbag1", scene("rosbag1", scans(1), imu_frame="imu_link"))
        done = run("bag", source, tmp_path / "out.bag", "--imu", "/imu")
        assert done.returncode == 2
        assert "does not connect frame 'imu_link' with frame 'lidar'" in only_line(done.stderr)

    def test_a_labelled_bag_is_not_labelled_again(self, drive: Path, tmp_path: Path) -> None:
        flagstone.bag(drive, tmp_path / "once.bag")
        done = run("bag", tmp_path / "once.bag", tmp_path / "twice.bag")
        assert done.returncode == 2
        assert "contains /points/labelled already" in only_line(done.stderr)

    def test_an_existing_output_is_kept(self, drive: Path, tmp_path: Path) -> None:
        (tmp_path / "out.bag").write_bytes(b"kept")
        done = run("bag", drive, tmp_path / "out.bag")
        assert done.returncode == 2
        assert "out.bag: exists already" in only_line(done.stderr)
        assert (tmp_path / "out.bag").read_bytes() == b"kept"

    @pytest.mark.parametrize("link", ["same", "symbolic", "hard"])
    def test_the_input_is_never_the_output(self, link: str, tmp_path: Path) -> None:
        source = write_bag(tmp_path / "drive.bag", "rosbag1", scene("rosbag1", scans(1)))
        output = {"same": source}.get(link, tmp_path / "link.bag")
        if link == "symbolic":
            output.symlink_to(source)
        elif link == "hard":
            output.hardlink_to(source)
        before = source.read_bytes()
        assert run("bag", source, output).returncode == 2
        assert source.read_bytes() == before

    def test_a_bag_is_not_written_into_itself(self, tmp_path: Path) -> None:
        source = write_bag(tmp_path / "drive", "mcap", scene("mcap", scans(1)))
        before = files_in(source)
        assert run("bag", source, source / "out").returncode == 2
        assert files_in(source) == before

    def test_a_missing_input_is_one_line(self, tmp_path: Path) -> None:
        done = run("bag", tmp_path / "missing.mcap", tmp_path / "out.mcap")
        assert done.returncode == 1
        assert only_line(done.stderr).startswith(f"{tmp_path}/missing.mcap: ")

    def test_a_file_that_is_not_a_bag_is_one_line(self, tmp_path: Path) -> None:
        (tmp_path / "scan.mcap").write_bytes(bytes(1000))
        done = run("bag", tmp_path / "scan.mcap", tmp_path / "out.mcap")
        assert done.returncode == 1
        assert "scan.mcap" in only_line(done.stderr)

    def test_the_functions_raise_the_same_errors(self, drive: Path, tmp_path: Path) -> None:
        output = tmp_path / "out.bag"
        with pytest.raises(ValueError, match="is not a topic of point clouds"):
            flagstone.bag(drive, output, topics="/nothing")
        with pytest.raises(ValueError, match="format: 'x' is not a format"):
            flagstone.bag(drive, output, format="x")  # type: ignore[arg-type]
        with pytest.raises(ValueError, match="threads: 0 is out of range"):
            flagstone.bag(drive, output, threads=0)
        with pytest.raises(ValueError, match="because the sensor height is tracked"):
            flagstone.bag(drive, output, threads=2, segmenter=flagstone.Surface(sensor_height="track"))
        with pytest.raises(FileExistsError):
            flagstone.bag(drive, drive)
        assert files_in(tmp_path) == []


class TestInstallation:
    """The program runs these commands only with its Python package."""

    @pytest.mark.parametrize("command", [["bag", "a.bag", "b.bag"], ["ray", "a", "--in-place"], ["info", "a.mcap"]])
    def test_a_program_without_the_package_names_what_to_install(self, command: list[str]) -> None:
        environment = {name: value for name, value in os.environ.items() if name != _command.PYTHON_VARIABLE}
        done = subprocess.run([_command.path(), *command], capture_output=True, text=True, env=environment, check=False)
        assert done.returncode == 2
        assert "pip install 'flagstone[" in only_line(done.stderr)

    def test_another_version_of_the_package_is_reported(self, capsys: pytest.CaptureFixture[str]) -> None:
        from flagstone import _python_commands

        handler = signal.getsignal(signal.SIGTERM)
        try:
            code = _python_commands.main(["0.0.0", "bag", "{}", "a", "b"])
        finally:
            signal.signal(signal.SIGTERM, handler)
        assert code == 2
        assert "bag: the command has version 0.0.0" in only_line(capsys.readouterr().err)

    def test_modules_in_the_current_directory_are_not_imported(self, drive: Path, tmp_path: Path) -> None:
        (tmp_path / "json.py").write_text("raise SystemExit('imported')")
        done = subprocess.run(
            [_command.path(), "info", drive],
            capture_output=True,
            text=True,
            cwd=tmp_path,
            env=_command.environment(),
            check=False,
        )
        assert done.returncode == 0, done.stderr


class TestMalformedClouds:
    """A cloud that cannot be read is one line; it is copied, and all others are labelled."""

    def bag(self, tmp_path: Path, bad: list[bytes]) -> Path:
        good = scans(4)
        messages = [cloud("mcap", good[0], START), *bad, *(cloud("mcap", points, START) for points in good[1:])]
        records: list[Record] = [("/points", START + index, data) for index, data in enumerate(messages)]
        return write_bag(tmp_path / "drive", "mcap", records)

    def test_each_is_copied_and_one_line(self, tmp_path: Path) -> None:
        whole = cloud("mcap", scans(1)[0], START)
        no_fields = cloud("mcap", np.zeros((5, 3), np.float32), START).replace(b"x\0", b"q\0")
        bad = [whole[:1000], b"", whole[:40], no_fields, image("mcap", START, np.random.default_rng(1))]
        source = self.bag(tmp_path, bad)

        done = run("bag", source, tmp_path / "out")

        assert done.returncode == 1
        lines = done.stderr.splitlines()
        assert len(lines) == len(bad)
        for index, line in enumerate(lines):
            assert line.startswith(f"flagstone: {source}: /points: message {index + 1}: ")
        after = read_bag(tmp_path / "out")
        assert of_topic(after, "/points") == of_topic(read_bag(source), "/points")
        assert [time - START for _, time, _ in of_topic(after, "/points/labelled")] == [0, 6, 7, 8]
        assert "4 of 9 clouds labelled" in done.stdout

    def test_after_ten_of_a_kind_only_their_number_is_printed(self, tmp_path: Path) -> None:
        whole = cloud("mcap", scans(1)[0], START)
        source = self.bag(tmp_path, [whole[: 1000 + 16 * index] for index in range(25)])
        done = run("bag", source, tmp_path / "out")
        assert done.returncode == 1
        lines = done.stderr.splitlines()
        assert len(lines) == 11
        assert "15 more messages with the error: " in lines[-1]

    def test_json_contains_the_errors(self, tmp_path: Path) -> None:
        source = self.bag(tmp_path, [b"\0\1"])
        done = run("bag", source, tmp_path / "out", "--json")
        records = [json.loads(line) for line in done.stdout.splitlines()]
        assert [record["message"] for record in records if "error" in record] == [1]
        assert records[-1]["failed"] == 1

    def test_clouds_of_any_size_and_content_are_labelled(self, tmp_path: Path) -> None:
        nan = np.full((100, 4), np.nan, np.float32)
        source = self.bag(
            tmp_path, [cloud("mcap", points, START) for points in (nan, nan[:0], np.zeros((7, 3), np.float32))]
        )
        done = run("bag", source, tmp_path / "out")
        assert done.returncode == 0, done.stderr
        assert len(of_topic(read_bag(tmp_path / "out"), "/points/labelled")) == 7


@pytest.mark.parametrize("format", FORMATS)
def test_a_truncated_bag_is_labelled_as_far_as_it_can_be_read(format: str, tmp_path: Path) -> None:
    source = write_bag(tmp_path / bag_name(format), format, scene(format, scans(20)))
    file = source if source.is_file() else next(path for path in source.iterdir() if path.suffix != ".yaml")
    os.truncate(file, file.stat().st_size * 2 // 3)

    done = run("bag", source, tmp_path / bag_name(format, "out"))

    assert done.returncode == 1
    assert all(line.startswith("flagstone: ") for line in done.stderr.splitlines())
    assert done.stderr
    if done.stdout:  # a database whose end is missing may not be readable at all
        after = read_bag(tmp_path / bag_name(format, "out"))
        labelled = len(of_topic(after, "/points/labelled"))
        assert 5 <= labelled == len(of_topic(after, "/points")) < 20


class TestEnd:
    """A run that does not finish leaves no bag."""

    @pytest.fixture(scope="class")
    @classmethod
    def long_drive(cls, tmp_path_factory: pytest.TempPathFactory) -> Path:
        """A bag that takes a second or more."""
        records = scene("rosbag1", scans(4, 60_000) * 60)
        return write_bag(tmp_path_factory.mktemp("long") / "drive.bag", "rosbag1", records)

    def start(self, source: Path, output: Path) -> subprocess.Popen[str]:
        """Starts the command and waits until it has written something."""
        command = [str(_command.path()), "bag", str(source), str(output), "--threads", "1"]
        process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, env=_command.environment()
        )
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline and process.poll() is None:
            if any(path.stat().st_size > 1_000_000 for path in output.parent.iterdir() if path.is_file()):
                break
            time.sleep(0.005)
        assert process.poll() is None, process.communicate()
        return process

    def test_after_sigkill_only_a_temporary_file_remains_and_the_next_run_succeeds(
        self, long_drive: Path, tmp_path: Path
    ) -> None:
        process = self.start(long_drive, tmp_path / "out.bag")
        process.kill()
        process.communicate()
        (left,) = files_in(tmp_path)
        assert left.startswith(".")

        done = run("bag", long_drive, tmp_path / "out.bag")

        assert done.returncode == 0, done.stderr
        assert files_in(tmp_path) == ["out.bag"]
        assert len(of_topic(read_bag(tmp_path / "out.bag"), "/points/labelled")) == 240

    @pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
    def test_a_signal_removes_the_temporary_file(self, number: int, long_drive: Path, tmp_path: Path) -> None:
        process = self.start(long_drive, tmp_path / "out.bag")
        process.send_signal(number)
        out, error = process.communicate(timeout=60)
        assert process.returncode == 1
        line = only_line(error)
        assert line.startswith("interrupted: ")
        assert "out.bag was not written" in line
        assert out == ""
        assert files_in(tmp_path) == []

    @pytest.mark.parametrize("format", FORMATS)
    def test_a_full_disk_removes_the_temporary_file(self, format: str, tmp_path: Path) -> None:
        source = write_bag(tmp_path / bag_name(format), format, scene(format, scans(10, 20_000)))
        (tmp_path / "to").mkdir()

        def limit() -> None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (2_000_000, 2_000_000))

        done = run("bag", source, tmp_path / "to" / bag_name(format, "out"), before=limit)
        assert done.returncode == 1
        only_line(done.stderr)
        assert files_in(tmp_path / "to") == []

    def test_standard_output_that_cannot_be_written_is_one_line(self, drive: Path, tmp_path: Path) -> None:
        with Path("/dev/full").open("w") as full:
            done = subprocess.run(
                [_command.path(), "bag", drive, tmp_path / "out.bag", "--json"],
                stdout=full,
                stderr=subprocess.PIPE,
                text=True,
                env=_command.environment(),
                check=False,
            )
        assert done.returncode == 1
        assert only_line(done.stderr).startswith("standard output: cannot be written")
