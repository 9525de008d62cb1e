# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Sets the classification of a LAS or LAZ file and touches nothing else of it."""

from __future__ import annotations

import os
from collections.abc import Iterable
from pathlib import Path

import numpy as np
import numpy.typing as npt

from flagstone._las import opened
from flagstone._las_classes import checked_labels, class_table, default_may_change
from flagstone._las_copy import Layout, Rows, copy_points
from flagstone._laz import BadFileError
from flagstone._progress import Progress
from flagstone._whole_file import written_whole


def classify_las(
    source: str | os.PathLike[str],
    destination: str | os.PathLike[str],
    labels: npt.ArrayLike,
    *,
    may_change: Iterable[int] = default_may_change,
) -> dict[int, int]:
    """Copies a LAS or LAZ file with the classification of its points set from labels.

    Points labelled ground become class 2 (ground), noise 7 (low point); nonground ones that were 0 (never classified),
    2 or 7 become 1 (unclassified) and keep any other class. Points that no method judges (out of range, invalid)
    keep theirs. Only points of classes in `may_change` are changed at all.

    Everything else is kept bit for bit: header, variable length records, all other dimensions, the flags beside the
    class, what stands behind the points. A LAZ file is compressed anew with its own parameters and read back before it
    takes its place; offsets of what stands behind the points, and the index of a COPC file, follow the chunks to where
    they come to lie. Memory holds the labels and a million points at a time.

    Args:
        source: The file, LAS 1.0 to 1.4, point formats 0 to 10. Point formats 0 to 5 have 5 bits for the class.
        destination: The file to write, with the ending of the source; it may be the source. It is there whole or not
            at all.
        labels: Codes of `flagstone.Label`, shape (N,), one a point in the file's order.
        may_change: Classes that may be changed, 0 to 255. The default leaves what says more than ground or not, such
            as plants (3 to 5), buildings (6), water (9), overlap (12), bridges (17) and high noise (18).
            `range(256)` allows all.

    Returns:
        How many points of each class the new file has, by class.

    Raises:
        FileNotFoundError: There is no such source.
        OSError: The destination cannot be written.
        TypeError: The labels are no integers.
        ValueError: The source is damaged, or of a kind that cannot be kept as it is; labels are not one a point or not
            0 to 4; endings differ.
        ImportError: laspy is not installed.
    """
    codes = checked_labels(labels)
    table = class_table(may_change)
    ending = Path(source).suffix.lower()
    if Path(destination).suffix.lower() != ending:
        raise ValueError(f"destination: {os.fspath(destination)} must end with {ending}, as the source does")
    counts = np.zeros(256, np.int64)
    with written_whole(destination) as copy, opened(source) as reader, Path(source).open("rb") as file:
        layout = Layout.of(reader, os.fstat(file.fileno()).st_size)
        class_byte, class_bits = (16, 0xFF) if reader.header.point_format.id >= 6 else (15, 0x1F)
        if len(codes) != layout.count:
            raise BadFileError(f"has {layout.count:,} points, but there are {len(codes):,} labels; give one a point")
        with Progress(layout.count, "points") as progress:

            def classify(rows: Rows, first: int) -> None:
                packed = rows[:, class_byte]
                after = table[codes[first : first + len(rows)], packed & class_bits]
                rows[:, class_byte] = (packed & ~np.uint8(class_bits)) | after
                counts[:] += np.bincount(after, minlength=256)
                progress.add(len(rows))

            copy_points(file, copy, layout, classify)
    return {code: int(count) for code, count in enumerate(counts) if count > 0}
