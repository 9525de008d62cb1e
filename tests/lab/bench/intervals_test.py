# SPDX-FileCopyrightText: 2026 flagstone contributors
# SPDX-License-Identifier: MIT
"""Tests of bench/study.py: confidence intervals by Student's t, and replacement of tables in pages.

python3 intervals_test.py BENCH    BENCH: the directory bench
"""

import math
import sys
import unittest

sys.path.insert(0, sys.argv.pop(1))
import study


def scans(**f1):
    return {"per_scan": [{"scan": name, "f1": value} for name, value in f1.items()]}


class Intervals(unittest.TestCase):
    def test_quantiles_match_printed_tables(self):
        printed = {
            1: 12.706,
            2: 4.303,
            3: 3.182,
            5: 2.571,
            7: 2.365,
            19: 2.093,
            29: 2.045,
            30: 2.042,
            120: 1.980,
        }
        for degrees, quantile in printed.items():
            self.assertAlmostEqual(study.t_975(degrees), quantile, delta=0.0006, msg=f"{degrees} degrees")

    def test_differences_are_paired_by_scan_in_any_order(self):
        of = scans(a=0.9, b=0.5, c=0.7)
        other = scans(c=0.6, a=0.7, b=0.5)
        found = study.paired(of, other, "f1")
        self.assertAlmostEqual(found["mean"], 0.1)
        self.assertAlmostEqual(found["ci95"], 4.3027 * 0.1 / math.sqrt(3), places=4)
        self.assertEqual(found["scans"], 3)

    def test_one_scan_has_no_interval(self):
        self.assertIsNone(study.mean_of([0.1])["ci95"])
        self.assertEqual(study.percentage_points(study.mean_of([0.1])), "+10.00 ± –")

    def test_a_difference_is_bold_if_its_interval_excludes_zero(self):
        self.assertEqual(study.percentage_points({"mean": 0.02, "ci95": 0.01}), "**+2.00 ± 1.00**")
        self.assertEqual(study.percentage_points({"mean": -0.01, "ci95": 0.02}), "-1.00 ± 2.00")

    def test_a_difference_of_zero_has_no_minus_sign(self):
        self.assertEqual(study.percentage_points({"mean": -1e-6, "ci95": 1e-7}), "+0.00 ± 0.00")


class Pages(unittest.TestCase):
    def test_replaces_a_table_and_keeps_the_text_around_it(self):
        page = "before\n<!-- table a -->\nold\n<!-- end -->\nafter"
        self.assertEqual(study.filled(page, {"a": "new"}), "before\n<!-- table a -->\n\nnew\n\n<!-- end -->\nafter")

    def test_keeps_tables_of_other_studies(self):
        page = "<!-- table b -->\nold\n<!-- end -->"
        self.assertEqual(study.filled(page, {"a": "new"}), page)

    def test_names_a_table_missing_from_the_pages(self):
        with self.assertRaisesRegex(SystemExit, "README.md: missing tables: no-such-table"):
            study.exit_if_missing([study.ROOT / "README.md"], {"no-such-table": ""})


if __name__ == "__main__":
    unittest.main()
