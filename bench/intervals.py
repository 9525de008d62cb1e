# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Differences between two rows of `flagstone eval`, scan by scan, with their 95 % interval."""

import math
import statistics


def t_975(degrees):
    """Quantile 0.975 of Student's t: 12.71 for one degree of freedom, towards 1.96 for many."""
    if degrees >= 30:  # Abramowitz and Stegun, 26.7.5
        z = statistics.NormalDist().inv_cdf(0.975)
        return z + (z**3 + z) / (4 * degrees) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * degrees**2)
    low, high = 1.0, 20.0
    while high - low > 1e-9:
        middle = (low + high) / 2
        low, high = (middle, high) if share_within(middle, degrees) < 0.95 else (low, middle)
    return low


def share_within(t, degrees):
    """Probability that |T| < t for Student's T: Abramowitz and Stegun, 26.7.3 and 26.7.4."""
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


def mean_of(differences):
    """Mean and the half width of its 95 % interval; scans are taken for independent."""
    count = len(differences)
    half_width = None
    if count > 1:
        half_width = t_975(count - 1) * statistics.stdev(differences) / math.sqrt(count)
    return {"mean": statistics.fmean(differences), "ci95": half_width, "scans": count}


def paired(of, other, figure):
    """The mean difference between two methods' entries of an evaluation, scan by scan."""
    theirs = {scan["scan"]: scan[figure] for scan in other["per_scan"]}
    return mean_of([scan[figure] - theirs[scan["scan"]] for scan in of["per_scan"]])
