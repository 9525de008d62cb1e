# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Shared by the studies that write tables of the docs: running the command, confidence intervals, tables, options."""

import argparse
import difflib
import json
import math
import os
import pathlib
import re
import shlex
import statistics
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent


class Runs:
    """Runs commands with $WORK and $FLAGSTONE_DATA in place of directories, so that a reader can repeat them."""

    def __init__(self, work, flagstone):
        self.work = work
        self.directories = {
            "$FLAGSTONE_DATA": os.environ.get("FLAGSTONE_DATA", str(ROOT.parent / "shared" / "data")),
            "$WORK": str(work),
        }
        self.flagstone = str(flagstone)
        self.made_by = {}  # flagstone, machine, date
        work.mkdir(parents=True, exist_ok=True)

    def call(self, command, exit_codes=(0,)):
        """Returns the standard output of a command. Exits if its exit code is not one of `exit_codes`."""
        text = command
        for name, directory in self.directories.items():
            text = text.replace(name, shlex.quote(directory))
        words = shlex.split(text)
        if words[0] == "flagstone":
            words[0] = self.flagstone
        done = subprocess.run(words, cwd=ROOT, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if done.returncode not in exit_codes:
            sys.exit(f"exit code {done.returncode}: {command}\n{done.stderr.rstrip()}")
        return done.stdout

    def evaluate_command(self, command):
        """Returns the results of a `flagstone eval ...` or `flagstone sweep ...` command."""
        with tempfile.TemporaryDirectory(prefix="flagstone-eval-") as directory:
            file = pathlib.Path(directory) / "result.json"
            self.call(f"{command} --json {file}")
            result = json.loads(file.read_text())
        for key in ("flagstone", "machine", "date"):
            self.made_by[key] = result.pop(key)
        return {"command": command, **result}


def show_progress(text):
    """Shows a line on a terminal; the next call replaces it, an empty text clears it."""
    if sys.stderr.isatty():
        print(f"\r\033[K{text}", end="", file=sys.stderr, flush=True)


# --- paired differences between two methods, with 95 % confidence intervals -----------------------------------


def t_975(degrees):
    """0.975 quantile of Student's t: 12.71 for one degree of freedom, approaching 1.96 for many."""
    if degrees >= 30:  # Abramowitz and Stegun, 26.7.5
        z = statistics.NormalDist().inv_cdf(0.975)
        return z + (z**3 + z) / (4 * degrees) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * degrees**2)
    low, high = 1.0, 20.0
    while high - low > 1e-9:
        middle = (low + high) / 2
        low, high = (middle, high) if probability_within(middle, degrees) < 0.95 else (low, middle)
    return low


def probability_within(t, degrees):
    """Probability that |T| < t if T has a Student's t distribution: Abramowitz and Stegun, 26.7.3 and 26.7.4."""
    angle = math.atan(t / math.sqrt(degrees))
    cosine = math.cos(angle)
    odd = degrees % 2
    term = cosine if odd else 1.0
    total = term if degrees > 1 else 0.0
    for k in range(3 if odd else 2, degrees - 1, 2):
        term *= cosine**2 * (k - 1) / k
        total += term
    total *= math.sin(angle)
    return 2 / math.pi * (angle + total) if odd else total


def mean_of(values):
    """Mean over scans and the half-width of its 95 % confidence interval, assuming that scans are independent."""
    count = len(values)
    half_width = None
    if count > 1:
        half_width = t_975(count - 1) * statistics.stdev(values) / math.sqrt(count)
    return {"mean": statistics.fmean(values), "ci95": half_width, "scans": count}


def paired(of, other, metric):
    """Mean of `of` minus `other` over scans, for two methods' entries of an evaluation."""
    other_values = {scan["scan"]: scan[metric] for scan in other["per_scan"]}
    return mean_of([scan[metric] - other_values[scan["scan"]] for scan in of["per_scan"]])


# --- Markdown tables, and pages that contain them between <!-- table NAME --> and <!-- end --> ----------------


def percent(fraction, digits=2):
    return "–" if fraction is None else f"{100 * fraction:.{digits}f}"


def with_interval(value):
    return f"{percent(value['mean'])} ± {percent(value['ci95'])}"


def percentage_points(difference):
    """A difference of fractions, such as +0.12 ± 0.05; bold if the confidence interval excludes 0."""
    mean = round(100 * difference["mean"], 2) + 0.0  # no minus zero
    text = f"{mean:+.2f} ± {percent(difference['ci95'])}"
    beyond = difference["ci95"] is not None and abs(difference["mean"]) > difference["ci95"]
    return f"**{text}**" if beyond and mean != 0 else text


def table(head, rows, left=1):
    """A Markdown table. The first `left` columns are left-aligned, the others right-aligned."""
    rule = ["---"] * left + ["---:"] * (len(head) - left)
    return "\n".join("| " + " | ".join(line) + " |" for line in (head, rule, *rows))


def rounded(value):
    """`value` with all numbers rounded to seven decimals."""
    if isinstance(value, float):
        return round(value, 7)
    if isinstance(value, dict):
        return {key: rounded(entry) for key, entry in value.items()}
    return [rounded(entry) for entry in value] if isinstance(value, list) else value


def filled(page, found):
    """The text of a page with the tables in `found`, by name. Tables of other studies are kept."""

    def replace(match):
        name = match.group(1)
        return f"<!-- table {name} -->\n\n{found[name]}\n\n<!-- end -->" if name in found else match.group(0)

    return re.sub(r"<!-- table (\S+) -->.*?<!-- end -->", replace, page, flags=re.DOTALL)


def write_tables(pages, found):
    """Replaces the tables of `found` in the pages."""
    exit_if_missing(pages, found)
    for path in pages:
        path.write_text(filled(path.read_text(), found))


def check(pages, found):
    """Prints the differences between the tables of the pages and `found`, and exits with 1 if there are any."""
    exit_if_missing(pages, found)
    is_same = True
    for path in pages:
        page = path.read_text()
        expected = filled(page, found)
        sys.stdout.writelines(
            difflib.unified_diff(page.splitlines(True), expected.splitlines(True), str(path), "expected")
        )
        is_same &= page == expected
    sys.exit(not is_same)


def exit_if_missing(pages, found):
    """Exits if a table of `found` is on none of the pages."""
    text = "".join(path.read_text() for path in pages)
    missing = [name for name in found if f"<!-- table {name} -->" not in text]
    if missing:
        names = ", ".join(str(path.relative_to(ROOT)) for path in pages)
        sys.exit(f"{names}: missing tables: {', '.join(missing)} (expected <!-- table NAME --> ... <!-- end -->)")


# --- the command line ---------------------------------------------------------------------------------------


def main(description, pages, results_file, tables, measure, names=(), can_try=False, draw=None, verify=None):
    """The command line of a study that writes `tables(results)` into `pages`.

    `measure(options)` returns results that can be written as JSON, of the measurements selected from `names`. `draw`
    draws images of the results. `verify(results, flagstone)` returns the settings whose defaults have changed since the
    results were measured.
    """
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    commands = parser.add_subparsers(dest="command", required=True)
    measured = argparse.ArgumentParser(add_help=False)
    measured.add_argument(
        "--work", type=pathlib.Path, required=True, help="directory for simulated scans and other large files"
    )
    measured.add_argument("--flagstone", type=pathlib.Path, default=ROOT / "build" / "flagstone")
    if names:
        measured.add_argument("--only", nargs="+", choices=list(names), default=list(names), help="default: all")
    commands.add_parser("run", parents=[measured], help="measure, write the results and the tables")
    if can_try:
        try_command = commands.add_parser("try", parents=[measured], help="measure and print the tables, write nothing")
        try_command.add_argument(
            "--set", action="append", default=[], metavar="KEY=VALUE", help="setting of the method (repeatable)"
        )
    commands.add_parser("page", help="write the tables from the results, without measuring")
    check_command = commands.add_parser("check", help="fail if the tables in the pages differ from the results")
    if verify:
        check_command.add_argument(
            "--flagstone", type=pathlib.Path, help="also fail if the default settings of this command have changed"
        )
    options = parser.parse_args()

    results = json.loads(results_file.read_text()) if results_file.exists() else {}
    if options.command in ("run", "try"):
        options.work = options.work.resolve()
        options.flagstone = options.flagstone.resolve()
        try:
            found = measure(options)
        except KeyboardInterrupt:
            sys.exit("\ninterrupted")
        show_progress("")
        if options.command == "try":
            for name, text in tables(found).items():
                print(f"{name}\n\n{text}\n")
            return
        results |= found
        results_file.write_text(json.dumps(results, indent=1) + "\n")
    if options.command == "check":
        if verify and options.flagstone and (stale := verify(results, options.flagstone.resolve())):
            sys.exit(f"{results_file.name}: measured with other settings: {'; '.join(stale)} (run the study again)")
        check(pages, tables(results))
    write_tables(pages, tables(results))
    if draw:
        draw(results)
