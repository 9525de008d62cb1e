# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Scans by the million: labels for a folder or a bucket of scans, on one machine or on a Ray cluster.

`segment` labels every scan of a tree, `statistics` reads the table of what was done. The command
`flagstone-ray` does the same from a shell.
"""

from flagstone.ray.job import segment
from flagstone.ray.statistics import statistics
from flagstone.ray.summary import Failure, Summary

__all__ = ["Failure", "Summary", "segment", "statistics"]
