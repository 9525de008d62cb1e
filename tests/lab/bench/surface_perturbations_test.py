# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Tests of the perturbations in bench/surface_perturbations.py.

    python3 surface_perturbations_test.py BENCH    BENCH: the directory bench

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
import surface_perturbations as perturbations

ROAD, BUILDING = 40, 50


def a_scan():
    """Four beams of 90 points on level ground 1.73 m below the sensor, and a wall."""
    azimuths = np.radians(np.arange(90) * 4 + 1.5)
    points, classes = [], []
    for ring in (4, 6, 8, 10):
        flat = np.full(90, -perturbations.HEIGHT)
        points.append(np.stack([ring * np.cos(azimuths), ring * np.sin(azimuths), flat, flat], axis=1))
        classes.append(np.full(90, ROAD))
    azimuths = np.radians(np.arange(80) + 1.5)
    heights = np.linspace(-1.2, 1.0, 80)
    points.append(np.stack([6.2 * np.cos(azimuths), 6.2 * np.sin(azimuths), heights, heights], axis=1))
    classes.append(np.full(80, BUILDING))
    return np.concatenate(points).astype("<f4"), np.concatenate(classes).astype("<u4")


def perturbed(name):
    points, classes = a_scan()
    perturbation = next(entry for entry in perturbations.PERTURBATIONS if entry.name == name)
    moved, their_classes, sources = perturbation.perturb(points, classes, np.random.default_rng(1))
    return points, classes, moved, their_classes, np.asarray(sources)


class Perturbations(unittest.TestCase):
    def test_a_roll_of_3_degrees_raises_the_left_and_keeps_distances(self):
        points, _, moved, _, _ = perturbed("rolled by +3°")
        left = np.argmax(points[:, 1])
        self.assertAlmostEqual(
            float(moved[left, 2] - points[left, 2]), np.sin(np.radians(3)) * points[left, 1], delta=0.01
        )
        np.testing.assert_allclose(
            np.linalg.norm(moved[:, :3], axis=1), np.linalg.norm(points[:, :3], axis=1), rtol=1e-5
        )

    def test_a_pitch_of_3_degrees_lowers_points_ahead(self):
        points, _, moved, _, _ = perturbed("pitched by +3°")
        ahead = np.argmax(points[:, 0])
        self.assertLess(moved[ahead, 2], points[ahead, 2] - 0.3)

    def test_every_other_beam_is_kept_complete(self):
        points, classes, moved, their_classes, sources = perturbed("every other beam")
        np.testing.assert_array_equal(sources, np.r_[0:90, 180:270, 360:440])
        np.testing.assert_array_equal(moved, points[sources])
        np.testing.assert_array_equal(their_classes, classes[sources])

    def test_the_four_quarters_of_the_view_add_up_to_the_scan(self):
        kept = [perturbed(f"90° field of view, {name}")[4] for name in ("front", "left", "rear", "right")]
        np.testing.assert_array_equal(np.sort(np.concatenate(kept)), np.arange(440))

    def test_the_left_quarter_has_positive_y(self):
        _, _, moved, _, _ = perturbed("90° field of view, left")
        self.assertGreater(moved[:, 1].min(), 0)

    def test_one_percent_of_the_points_get_a_ghost_point_below_the_ground(self):
        points, _, moved, their_classes, sources = perturbed("1 % ghost points, not scored")
        ghosts = sources < 0
        self.assertEqual(ghosts.sum(), len(points) // 100)
        np.testing.assert_array_equal(their_classes[ghosts], perturbations.OUTLIER)
        np.testing.assert_array_equal(moved[~ghosts], points)
        for ghost in moved[ghosts]:
            above = points[(points[:, :2] == ghost[:2]).all(axis=1)]
            self.assertAlmostEqual(float(ghost[2]), -2 * perturbations.HEIGHT - float(above[0, 2]), places=4)


if __name__ == "__main__":
    unittest.main()
