# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Measures of heaps whose extent is known in closed form."""
import math
import unittest

import numpy as np

import synthetic
from periporo_tools import measures
from periporo_tools.results import Snapshot

QUARTER = frozenset({"x", "y"})
SPACING = 0.004
BASE, TIP = 0.2, 0.08  # the cone's radius and height [m]


def snapshot(points):
    count = len(points)
    return Snapshot(0.5, "collapse", points, np.full(count, 2.0), np.zeros(count, dtype=int), None)


def cone(quarter=True):
    return synthetic.cone(BASE, TIP, SPACING, quarter)


class ConeShape(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.shape = measures.shape(snapshot(cone()), SPACING, QUARTER)

    def test_the_front_is_the_base_radius(self):
        # The lowest points lie half a spacing above the floor, where the cone is narrower; the lattice adds a diagonal.
        tolerance = 0.5 * SPACING * BASE / TIP + math.sqrt(2) * SPACING
        self.assertAlmostEqual(self.shape.front_mean, BASE, delta=tolerance)
        self.assertAlmostEqual(self.shape.front_axes, BASE, delta=tolerance)
        self.assertAlmostEqual(self.shape.front_largest, BASE, delta=tolerance)

    def test_the_height_is_the_tip(self):
        self.assertAlmostEqual(self.shape.height, TIP, delta=SPACING)

    def test_99_per_cent_of_the_mass_lie_where_the_cones_volume_says(self):
        # The share of a cone's volume within x = r/R is 3 x^2 - 2 x^3.
        low, high = 0.0, 1.0
        for _ in range(60):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if 3 * middle**2 - 2 * middle**3 < 0.99 else (low, middle)
        self.assertAlmostEqual(self.shape.radius_99, low * BASE, delta=SPACING)

    def test_nothing_escaped(self):
        self.assertEqual(self.shape.escaped, 0)
        self.assertEqual(self.shape.escaped_mass, 0.0)


class Shapes(unittest.TestCase):
    def test_an_undeformed_box_measures_its_own_half_width_and_height_exactly(self):
        box = snapshot(synthetic.box(0.1, 0.06, 0.01, quarter=True))
        shape = measures.shape(box, 0.01, QUARTER)
        self.assertAlmostEqual(shape.front_axes, 0.1, delta=1e-12)
        self.assertAlmostEqual(shape.height, 0.06, delta=1e-12)

    def test_the_mean_front_of_a_square_is_the_mean_of_its_edge_over_directions(self):
        half = 0.1
        box = snapshot(synthetic.box(half, 0.004, 0.002, quarter=True))
        exact = half * 4.0 / math.pi * math.log(1.0 + math.sqrt(2.0))
        # The farthest point of a sector of 5 degrees lies on average half a sector further along the rising edge.
        sector = half * (math.sqrt(2.0) - 1.0) / (math.pi / 4) * math.radians(2.5)
        self.assertAlmostEqual(measures.shape(box, 0.002, QUARTER).front_mean, exact + sector, delta=0.002)

    def test_a_quarter_and_its_full_body_measure_alike(self):
        quarter = measures.shape(snapshot(cone(True)), SPACING, QUARTER)
        full = measures.shape(snapshot(cone(False)), SPACING, frozenset())
        for name in ("front_mean", "front_axes", "front_largest", "radius_99", "height"):
            # The same numbers up to the rounding of lattices that start at different corners.
            self.assertAlmostEqual(getattr(quarter, name), getattr(full, name), delta=1e-9, msg=name)

    def test_a_point_far_from_the_rest_is_escaped_and_moves_no_front(self):
        heap = cone()
        alone = np.concatenate([heap, [[0.5, 0.0, 0.002]]])
        before = measures.shape(snapshot(heap), SPACING, QUARTER)
        after = measures.shape(snapshot(alone), SPACING, QUARTER)
        self.assertEqual(after.escaped, 1)
        self.assertAlmostEqual(after.escaped_mass, 1.0 / len(alone))
        self.assertEqual(after.front_largest, before.front_largest)
        self.assertEqual(after.front_mean, before.front_mean)

    def test_a_chain_of_points_that_touch_carries_the_front_outward(self):
        heap = cone()
        edge = heap[(heap[:, 1:] < SPACING).all(axis=1), 0].max()  # of the lowest row beside y = 0
        row = np.array([[edge + 1.3 * SPACING * step, 0.002, 0.002] for step in range(1, 13)])
        shape = measures.shape(snapshot(np.concatenate([heap, row])), SPACING, QUARTER)
        self.assertEqual(shape.escaped, 0)
        self.assertAlmostEqual(shape.front_largest, math.hypot(row[-1, 0], 0.002) + 0.5 * SPACING)

    def test_a_planar_deposit_is_measured_along_x_on_each_side(self):
        slab = snapshot(synthetic.lattice((-0.1, 0.0, 0.0), (0.16, 0.02, 0.01), 0.01))
        shape = measures.shape(slab, 0.01, frozenset(), planar=True)
        self.assertAlmostEqual(shape.front_mean, 0.13)
        self.assertAlmostEqual(shape.front_largest, 0.16)


class Profiles(unittest.TestCase):
    def test_the_profile_of_a_cone_is_its_slope(self):
        line = measures.profile(cone(), SPACING, QUARTER)
        exact = np.clip(TIP * (1.0 - line.radius / BASE), 0.0, None)
        # The surface of the lattice is a staircase: one spacing up, one ring along.
        self.assertLess(np.abs(line.mean - exact).max(), SPACING * (1.0 + TIP / BASE))
        rounding = 1e-12  # of a mean of equal heights
        self.assertTrue((line.lowest <= line.mean + rounding).all() and (line.mean <= line.highest + rounding).all())

    def test_the_profile_ends_at_zero(self):
        self.assertEqual(measures.profile(cone(), SPACING, QUARTER).highest[-1], 0.0)


class MotionFromHistories(unittest.TestCase):
    MASS, HEIGHT = 2.0, 0.12

    def history(self, speed, error=None):
        time = np.linspace(-0.01, 0.5, 511)
        part = np.clip(time / 0.5, 0.0, 1.0)
        return {
            "time": time,
            "kinetic_energy": 0.5 * self.MASS * speed(time) ** 2,
            "gravity_energy": 40.0 - 8.0 * part,
            "energy_error": 3.0 + (0.0 * time if error is None else error(time)),
        }

    def test_rest_is_the_moment_the_speed_falls_below_the_limit_for_good(self):
        limit = measures.REST * math.sqrt(9.81 * self.HEIGHT)
        # Below the limit at 0.1 s, above it again, and below it from 0.35 s on.
        fast = lambda time: np.where((time < 0.1) | ((time > 0.2) & (time < 0.35)), 10 * limit, 0.5 * limit)
        motion = measures.motion(self.history(fast), self.MASS, self.HEIGHT)
        self.assertAlmostEqual(motion.rest_time, 0.35, delta=1.01e-3)  # the rows are 1 ms apart

    def test_a_column_that_moves_to_the_end_has_no_time_of_rest(self):
        self.assertIsNone(measures.motion(self.history(lambda time: 1.0 + 0 * time), self.MASS, self.HEIGHT).rest_time)

    def test_energy_error_counts_from_the_release_and_over_the_potential_energy_released(self):
        bump = lambda time: 0.4 * np.sin(np.pi * np.clip(time / 0.5, 0, 1)) - 0.08 * np.clip(time / 0.5, 0, 1)
        motion = measures.motion(self.history(lambda time: 0 * time, bump), self.MASS, self.HEIGHT)
        self.assertAlmostEqual(motion.released, 8.0)
        self.assertAlmostEqual(motion.error_final, 0.01)
        part = np.linspace(0, 1, 100001)
        self.assertAlmostEqual(motion.error_largest, (0.4 * np.sin(np.pi * part) - 0.08 * part).max() / 8.0, places=5)

    def test_without_histories_there_is_no_motion(self):
        self.assertIsNone(measures.motion({}, self.MASS, self.HEIGHT))


if __name__ == "__main__":
    unittest.main()
