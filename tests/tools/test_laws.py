# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The published laws as data say what the papers say."""
import math
import unittest

from periporo_tools.laws import predictions, read_laws


def prediction(law, quantity, source, aspect_ratio):
    return next(
        row for row in predictions(law, aspect_ratio) if row.quantity == quantity and row.source.startswith(source)
    )


class Laws(unittest.TestCase):
    def test_axisymmetric_run_out_is_linear_below_1_7_and_a_root_above(self):
        self.assertAlmostEqual(prediction("axisymmetric_column", "run_out", "Lube", 0.6).value, 1.24 * 0.6)
        self.assertAlmostEqual(prediction("axisymmetric_column", "run_out", "Lube", 4.0).value, 1.6 * 2.0)

    def test_axisymmetric_height_is_the_initial_one_below_0_74_and_a_sixth_root_above_1_7(self):
        self.assertAlmostEqual(prediction("axisymmetric_column", "height", "Lube", 0.6).value, 0.6)
        self.assertAlmostEqual(prediction("axisymmetric_column", "height", "Lube", 64.0).value, 0.88 * 2.0)

    def test_a_gap_between_ranges_gives_no_value_and_both_neighbouring_ends(self):
        height = prediction("axisymmetric_column", "height", "Lube", 1.2)
        self.assertIsNone(height.value)
        self.assertEqual([edge.aspect_ratio for edge in height.neighbours], [0.74, 1.7])
        self.assertAlmostEqual(height.neighbours[0].value, 0.74)
        self.assertAlmostEqual(height.neighbours[1].value, 0.88 * 1.7 ** (1 / 6))

    def test_below_the_only_range_one_neighbour_is_given(self):
        run_out = prediction("axisymmetric_column", "run_out", "Lajeunesse", 0.6)
        self.assertIsNone(run_out.value)
        self.assertEqual([edge.aspect_ratio for edge in run_out.neighbours], [0.74])

    def test_a_cone_of_lajeunesse_has_the_volume_of_its_cylinder(self):
        for aspect_ratio in (0.8, 1.2, 2.0, 8.0):
            radius = 1.0 + prediction("axisymmetric_column", "run_out", "Lajeunesse", aspect_ratio).value
            height = prediction("axisymmetric_column", "height", "Lajeunesse", aspect_ratio).value
            self.assertAlmostEqual(math.pi * radius**2 * height / 3.0, math.pi * aspect_ratio)

    def test_planar_run_out_has_lubes_gap_between_1_8_and_2_8(self):
        self.assertAlmostEqual(prediction("planar_column", "run_out", "Lube", 1.0).value, 1.2)
        self.assertAlmostEqual(prediction("planar_column", "run_out", "Lube", 8.0).value, 1.9 * 4.0)
        gap = prediction("planar_column", "run_out", "Lube", 2.0)
        self.assertIsNone(gap.value)
        self.assertAlmostEqual(gap.neighbours[0].value, 1.2 * 1.8)
        self.assertAlmostEqual(gap.neighbours[1].value, 1.9 * 2.8 ** (2 / 3))

    def test_planar_run_out_of_lajeunesse_changes_at_3(self):
        self.assertAlmostEqual(prediction("planar_column", "run_out", "Lajeunesse", 2.0).value, 3.6)
        self.assertAlmostEqual(prediction("planar_column", "run_out", "Lajeunesse", 8.0).value, 2.3 * 4.0)

    def test_planar_height_is_the_initial_one_below_1_15(self):
        self.assertAlmostEqual(prediction("planar_column", "height", "Lube", 1.0).value, 1.0)
        self.assertAlmostEqual(prediction("planar_column", "height", "Lube", 32.0).value, 4.0)

    def test_motion_ends_after_three_fall_times(self):
        self.assertAlmostEqual(prediction("axisymmetric_column", "end_of_motion", "Lube", 1.2).value, 3.0)

    def test_an_unknown_law_is_refused_with_the_known_names(self):
        with self.assertRaisesRegex(KeyError, "axisymmetric_column, planar_column"):
            predictions("axisymetric_column", 1.0)

    def test_every_row_names_its_source_and_its_ranges_rise(self):
        for law in read_laws():
            self.assertRegex(law.source, r"\d{4}")
            bounds = [bound for piece in law.pieces for bound in (piece.lower, piece.upper)]
            self.assertEqual(bounds, sorted(bounds))


if __name__ == "__main__":
    unittest.main()
