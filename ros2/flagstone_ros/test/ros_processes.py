# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Runs the node, players, listeners and other clients as separate processes, each with its own ROS 2 distribution."""

from __future__ import annotations

import functools
import json
import os
import pathlib
import re
import signal
import subprocess
import sys
import tempfile
import threading
import time
from typing import Any

import pytest

import flagstone

PACKAGE = pathlib.Path(__file__).resolve().parents[1]
REPOSITORY = PACKAGE.parents[1]
PROCESSES = pathlib.Path(__file__).resolve().parent / "processes"
DISTRIBUTIONS = ("jazzy", "kilted")
NODE = "ground_segmentation"


@functools.cache
def python_of(distribution: str) -> str:
    """The Python of an environment with ROS 2. Skips the test if it is not available."""
    environment = dict(os.environ, PYTHON=sys.executable)
    environment.pop("PYTHONPATH", None)
    script = REPOSITORY / "scripts" / "ros-environment"
    done = subprocess.run([script, distribution], capture_output=True, text=True, env=environment)
    if done.returncode == 3:
        pytest.skip(done.stderr.splitlines()[-1])
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()


class Process:
    """A running process whose lines of output are collected."""

    def __init__(self, command: list[str | pathlib.Path], environment: dict[str, str], directory: pathlib.Path) -> None:
        self.lines: list[str] = []
        self._changed = threading.Condition()
        self.process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, env=environment, cwd=directory
        )
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stdout is not None
        for line in self.process.stdout:
            with self._changed:
                self.lines.append(line.rstrip("\n"))
                self._changed.notify_all()

    def wait_for(self, pattern: str, seconds: float = 20) -> str:
        """The first line that matches, as soon as it is printed."""
        deadline = time.monotonic() + seconds
        with self._changed:
            while True:
                for line in self.lines:
                    if re.search(pattern, line):
                        return line
                left = deadline - time.monotonic()
                assert left > 0 and self.process.poll() is None, f"no line {pattern!r} in:\n" + "\n".join(self.lines)
                self._changed.wait(min(left, 0.5))

    def matching(self, pattern: str) -> list[str]:
        """All lines so far that match."""
        return [line for line in self.lines if re.search(pattern, line)]

    def finish(self, seconds: float = 90) -> list[Any]:
        """Waits for the end of a client, and returns its lines of JSON."""
        try:
            code = self.process.wait(seconds)
        finally:
            self.stop()
        assert code == 0, "\n".join(self.lines)
        return [json.loads(line) for line in self.lines if re.match(r'\["|\[\d|{"', line)]  # [WARN] is a line of a log

    def stop(self) -> int:
        """Interrupts the process as Ctrl-C does, and returns its exit code."""
        if self.process.poll() is None:
            self.process.send_signal(signal.SIGINT)
            try:
                self.process.wait(10)
            except subprocess.TimeoutExpired:
                self.process.kill()
        code = self.process.wait()
        self._reader.join(5)
        return code


class Ros:
    """Starts processes in one ROS domain, and stops them at the end of the test."""

    def __init__(self, directory: pathlib.Path, domain: int) -> None:
        self.directory = directory
        self._processes: list[Process] = []
        packages = directory / "packages"
        packages.mkdir()
        (packages / "flagstone").symlink_to(pathlib.Path(flagstone.__file__).parent)
        (packages / "flagstone_ros").symlink_to(PACKAGE / "flagstone_ros")
        self._environment = {
            "PATH": os.environ["PATH"],
            "HOME": str(directory),
            "PYTHONPATH": str(packages),
            "PYTHONDONTWRITEBYTECODE": "1",
            "PYTHONUNBUFFERED": "1",
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            "ROS_DOMAIN_ID": str(domain),
            "ROS_HOME": str(directory / "ros"),
            "RCUTILS_COLORIZED_OUTPUT": "0",
        }

    def start(self, distribution: str, *command: str | pathlib.Path, **environment: str) -> Process:
        """Starts Python with a command."""
        python = python_of(distribution)
        process = Process([python, *command], {**self._environment, **environment}, self.directory)
        self._processes.append(process)
        return process

    def node(
        self,
        distribution: str,
        *remappings: str,
        parameters: dict[str, Any] | None = None,
        arguments: tuple[str | pathlib.Path, ...] = (),
        points: str = "/points",
        wait: bool = True,
        **environment: str,
    ) -> Process:
        """Starts the node, and waits until it is ready.

        Its subscription is reliable unless a parameter changes that: the default transport loses large clouds.
        """
        input_topic = f"qos_overrides.{points}.subscription"
        parameters = {f"{input_topic}.reliability": "reliable", f"{input_topic}.depth": 200} | (parameters or {})
        command: list[str | pathlib.Path] = ["-m", "flagstone_ros", "--ros-args", *arguments]
        for remapping in remappings:
            command += ["-r", remapping]
        for name, value in parameters.items():
            command += ["-p", f"{name}:={json.dumps(value)}"]
        node = self.start(distribution, *command, **environment)
        if wait:
            node.wait_for(r"ground_segmentation.*: method ")
        return node

    def player(self, distribution: str, topic: str, *arguments: str | pathlib.Path, **environment: str) -> Process:
        """Starts processes/player.py."""
        return self.start(distribution, PROCESSES / "player.py", topic, *arguments, **environment)

    def listener(self, distribution: str, *arguments: str | pathlib.Path, **environment: str) -> Process:
        """Starts processes/listener.py, which writes its messages to the directory of the test."""
        return self.start(distribution, PROCESSES / "listener.py", self.directory, *arguments, **environment)

    def client(self, distribution: str, *arguments: str) -> list[Any]:
        """Runs processes/client.py, and returns its lines of JSON."""
        return self.start(distribution, PROCESSES / "client.py", *arguments).finish()

    def close(self) -> None:
        """Ends all processes."""
        for process in self._processes:
            process.stop()


def free_domain() -> int:
    """A ROS domain of this process, so that tests that run at the same time do not meet."""
    return 1 + os.getpid() % 100


def temporary_directory() -> pathlib.Path:
    """A new directory for messages; not on a disk if the system has memory for it."""
    shared = pathlib.Path("/dev/shm")
    return pathlib.Path(tempfile.mkdtemp(prefix="flagstone-ros-", dir=shared if shared.is_dir() else None))
