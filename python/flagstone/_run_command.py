# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""The command run for its results, its errors told as Python's."""

from __future__ import annotations

import codecs
import os
import re
import signal
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass

from flagstone import _command

_wrong_usage = 2
_begin_of_error = "flagstone: "


@dataclass(frozen=True)
class Ended:
    """How the program ended: exit code, and its errors, one line each."""

    code: int
    errors: tuple[str, ...]

    @property
    def reason(self) -> str:
        """The errors as one line."""
        if not self.errors:
            return f"the flagstone command ended with code {self.code}"
        more = len(self.errors) - 1
        return self.errors[0] + (f" (and {more} more)" if more > 0 else "")


def run(arguments: Sequence[str]) -> Ended:
    """Runs the program, with its progress shown where standard error is a terminal.

    An interrupt ends the program first and goes on as KeyboardInterrupt.

    Raises:
        ValueError: Wrong usage, told in terms of Python's arguments.
        RuntimeError: The program was ended from outside.
    """
    read_end, write_end = _own_terminal() if _on_terminal() else os.pipe()
    try:
        process = subprocess.Popen(
            [_command.path(), *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=write_end
        )
    except BaseException:
        os.close(read_end)
        raise
    finally:
        os.close(write_end)
    try:
        errors = tuple(_in_terms_of_python(error) for error in _errors(_text(read_end)))
        code = process.wait()
    except BaseException:
        _end(process)
        _show("\r\x1b[K")  # no progress any more
        raise
    finally:
        os.close(read_end)
    ended = Ended(code, errors)
    if code == _wrong_usage:
        raise ValueError(ended.reason)
    if code < 0:
        raise RuntimeError(f"the flagstone command was ended by {signal.Signals(-code).name}")
    return ended


# The program draws its progress for terminals only, so that it needs one of its own if it is to be read as well.
def _own_terminal() -> tuple[int, int]:
    import pty  # what only some systems have
    import tty

    read_end, write_end = pty.openpty()
    tty.setraw(write_end)
    return read_end, write_end


def option(name: str, value: object) -> list[str]:
    """`--name=value`, or nothing where the value is None."""
    return [] if value is None else [f"--{name}={value}"]


def listed(values: str | Iterable[object]) -> str:
    """`a,b,c`; a text as it is."""
    return values if isinstance(values, str) else ",".join(map(str, values))


def file_argument(file: str | os.PathLike[str]) -> str:
    """A path that is not taken for an option."""
    name = os.fspath(file)
    return f"./{name}" if name.startswith("-") else name


def _on_terminal() -> bool:
    return sys.stderr is not None and sys.stderr.isatty()


def _text(end: int) -> Iterator[str]:
    decoder = codecs.getincrementaldecoder("utf-8")("replace")
    while True:
        try:
            data = os.read(end, 1 << 16)
        except OSError:  # a terminal whose other end is closed
            return
        if not data:
            return
        yield decoder.decode(data)


# Passes on what is drawn, and keeps the lines that are errors.
def _errors(text: Iterator[str]) -> list[str]:
    errors = []
    pending = ""
    for some in text:
        pending += some
        *lines, pending = pending.split("\n")
        for line in lines:
            drawn, begin, error = line.partition(_begin_of_error)
            _show(drawn)
            if begin:
                errors.append(error)
        if pending.startswith("\r"):
            _show(pending)
            pending = ""
    return errors


def _show(drawn: str) -> None:
    if drawn and _on_terminal():
        sys.stderr.write(drawn)
        sys.stderr.flush()


def _in_terms_of_python(error: str) -> str:
    error = error.removesuffix("; see 'flagstone --help'")
    # What stands in quotes after the program's name is to be typed as it is.
    return re.sub(r"'flagstone [^']*'|--([a-z][a-z-]*)", lambda at: _argument_name(at[1]) if at[1] else at[0], error)


def _argument_name(name: str) -> str:
    return {"set": "settings"}.get(name, name.replace("-", "_"))


def _end(process: subprocess.Popen[bytes]) -> None:
    process.terminate()
    try:
        process.wait()
    except BaseException:  # interrupted once more
        process.kill()
        process.wait()
        raise
