# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Tables in Markdown, and pages that hold them between <!-- table NAME --> and <!-- end -->."""

import difflib
import re
import sys


def percent(share, digits=2):
    return "–" if share is None else f"{100 * share:.{digits}f}"


def with_interval(value):
    return f"{percent(value['mean'])} ± {percent(value['ci95'])}"


def points_more(difference):
    """A difference of shares in points: +0.12 ± 0.05; in bold where the interval does not hold 0."""
    mean = round(100 * difference["mean"], 2) + 0.0  # no minus zero
    text = f"{mean:+.2f} ± {percent(difference['ci95'])}"
    beyond = difference["ci95"] is not None and abs(difference["mean"]) > difference["ci95"]
    return f"**{text}**" if beyond and mean != 0 else text


def table(head, rows, left=1):
    """`left` columns are set flush left, the others right."""
    rule = ["---"] * left + ["---:"] * (len(head) - left)
    return "\n".join("| " + " | ".join(line) + " |" for line in (head, rule, *rows))


def rounded(value):
    """The same with shares to a thousandth of a percent."""
    if isinstance(value, float):
        return round(value, 5)
    if isinstance(value, dict):
        return {key: rounded(entry) for key, entry in value.items()}
    return [rounded(entry) for entry in value] if isinstance(value, list) else value


def filled(page, found):
    """The text of a page with the tables of `found`, by name."""

    def replace(match):
        name = match.group(1)
        if name not in found:
            sys.exit(f"the page wants a table {name}; there are {', '.join(found)}")
        return f"<!-- table {name} -->\n\n{found[name]}\n\n<!-- end -->"

    return re.sub(r"<!-- table (\S+) -->.*?<!-- end -->", replace, page, flags=re.DOTALL)


def check(path, found):
    """Ends the program with exit code 1, and the differences, if the page's tables are not those found."""
    page = path.read_text()
    wanted = filled(page, found)
    sys.stdout.writelines(difflib.unified_diff(page.splitlines(True), wanted.splitlines(True)))
    sys.exit(page != wanted)
