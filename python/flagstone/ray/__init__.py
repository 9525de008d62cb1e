# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Labels for millions of scans in a directory or bucket, on one machine or on a Ray cluster.

`segment` labels all scans. `statistics` reads the table of results. `flagstone ray` is the command for `segment`.
"""

from flagstone.ray.job import segment
from flagstone.ray.statistics import statistics
from flagstone.ray.summary import Failure, Summary

__all__ = ["Failure", "Summary", "segment", "statistics"]
