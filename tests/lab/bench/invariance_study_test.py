# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Tests of the changes of scans in bench/invariance_study.py.

    python3 invariance_study_test.py BENCH    BENCH: the directory bench

Exits with 77, which ctest treats as skipped, if NumPy is not installed.
"""

import sys
import unittest

sys.path.insert(0, sys.argv.pop(1))
try:
    import numpy as np
except ImportError as error:
    print(f"skipped: {error}")
    sys.exit(77)
import invariance_study as study

POINTS = np.random.default_rng(3).normal(0, 20, (500, 4)).astype("<f4")


def changed(name):
    """The changed points, and those of them that belong to the original points."""
    change = next(change for change in study.CHANGES if change.name == name)
    points, indices = change.change(POINTS, np.random.default_rng(1))
    return points, points[np.asarray(indices)]


class Changes(unittest.TestCase):
    def test_a_shuffled_scan_has_the_same_points_in_another_order(self):
        points, restored = changed("shuffle 0")
        self.assertFalse((points == POINTS).all())
        np.testing.assert_array_equal(restored, POINTS)

    def test_every_point_occurs_twice_in_a_row(self):
        points, restored = changed("every point twice")
        np.testing.assert_array_equal(points[::2], POINTS)
        np.testing.assert_array_equal(points[1::2], POINTS)
        np.testing.assert_array_equal(restored, POINTS)

    def test_a_turn_keeps_distances_and_heights(self):
        points, restored = changed("turned by 20°")
        np.testing.assert_array_equal(restored, points)
        np.testing.assert_array_equal(points[:, 2:], POINTS[:, 2:])
        azimuth = np.arctan2(points[:, 1], points[:, 0]) - np.arctan2(POINTS[:, 1], POINTS[:, 0])
        np.testing.assert_allclose(azimuth % (2 * np.pi), np.radians(20), atol=1e-5)
        np.testing.assert_allclose(np.hypot(*points[:, :2].T), np.hypot(*POINTS[:, :2].T), rtol=1e-6)

    def test_a_turn_by_90_degrees_is_exact(self):
        points, _ = changed("turned by 90°")
        np.testing.assert_array_equal(points[:, 0], -POINTS[:, 1])
        np.testing.assert_array_equal(points[:, 1], POINTS[:, 0])

    def test_a_flipped_scan_has_the_other_sign_in_one_coordinate(self):
        points, restored = changed("y negated")
        np.testing.assert_array_equal(restored, POINTS * np.float32([1, -1, 1, 1]))
        np.testing.assert_array_equal(points, restored)


class Summary(unittest.TestCase):
    def test_changes_are_averaged_by_kind(self):
        found = {"original": {"protocol": {"a": 0.9, "b": 0.8}}}
        for change in study.CHANGES:
            lower = 0.1 if change.name == "x negated" else 0.0
            found[change.name] = {
                "changed": {"a": lower, "b": 0.0},
                "f1": {"protocol": {"a": 0.9 - lower, "b": 0.8}},
            }
        flipped = study.summary(found)["kinds"]["flipped"]
        self.assertAlmostEqual(flipped["changed"], 0.025)
        self.assertAlmostEqual(flipped["changed_most"], 0.1)
        self.assertAlmostEqual(flipped["f1"]["protocol"]["mean"], -0.025)
        self.assertAlmostEqual(flipped["f1"]["protocol"]["largest"], -0.05)
        self.assertAlmostEqual(flipped["f1"]["protocol"]["largest_of_a_scan"], -0.1)


if __name__ == "__main__":
    unittest.main()
