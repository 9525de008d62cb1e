# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Runs of the command `flagstone` for studies that write tables: what was called, with which result."""

import json
import os
import pathlib
import shlex
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


class Runs:
    """Commands are kept with $WORK and $FLAGSTONE_DATA in the place of folders: as a reader can repeat them."""

    def __init__(self, work, flagstone):
        self.work = work
        self.places = {
            "$FLAGSTONE_DATA": os.environ.get("FLAGSTONE_DATA", str(ROOT.parent / "shared" / "data")),
            "$WORK": str(work),
        }
        self.flagstone = str(flagstone)
        self.made_by = {}  # flagstone, machine, date
        work.mkdir(parents=True, exist_ok=True)

    def call(self, command):
        """Standard output of a `flagstone ...`; the program ends if that fails."""
        text = command
        for name, place in self.places.items():
            text = text.replace(name, shlex.quote(place))
        words = [self.flagstone, *shlex.split(text)[1:]]
        done = subprocess.run(words, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if done.returncode != 0:
            sys.exit(f"exit code {done.returncode}: {command}\n{done.stderr.rstrip()}")
        return done.stdout

    def evaluate_command(self, command):
        """The results of a `flagstone eval ...`."""
        with tempfile.TemporaryDirectory(prefix="flagstone-eval-") as place:
            file = pathlib.Path(place) / "result.json"
            self.call(f"{command} --json {file}")
            result = json.loads(file.read_text())
        for key in ("flagstone", "machine", "date"):
            self.made_by[key] = result.pop(key)
        return {"command": command, **result}


def show_progress(text):
    """On a terminal, in one line that the next call replaces; an empty text clears it."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)
