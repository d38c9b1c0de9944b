# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The perspective image: balls where they belong, nearer ones in front."""
import math
import unittest

import numpy as np

from periporo_tools.rendering import Camera, aimed_at, render, smaller

RED, BLUE = [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]


def level_camera():
    """Looks along -x from ten metres; a metre there is 100 pixels."""
    return Camera(np.zeros(3), 10.0, 0.0, 0.0, 1000.0, 200, 160)


class Rendering(unittest.TestCase):
    def test_a_point_is_projected_by_similar_triangles(self):
        column, row, depth = level_camera().project(np.array([[0.0, 0.5, 0.25], [5.0, 0.5, 0.25]]))
        np.testing.assert_allclose(column, [100 + 50, 100 + 100])
        np.testing.assert_allclose(row, [80 - 25, 80 - 50])
        np.testing.assert_allclose(depth, [10.0, 5.0])

    def test_a_ball_covers_the_area_of_its_disc(self):
        image = render(np.zeros((1, 3)), np.array([RED]), 0.3, level_camera())
        # The rim is a circle of 30 pixels radius: its length is the most that rounding can add or take.
        self.assertAlmostEqual(image[..., 3].sum(), math.pi * 30**2, delta=2 * math.pi * 30 * 0.5)

    def test_the_nearer_ball_hides_the_farther_one(self):
        points = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
        for order in ([0, 1], [1, 0]):
            image = render(points[order], np.array([RED, BLUE])[order], 0.2, level_camera())
            self.assertGreater(image[80, 100, 0], 0.3)
            self.assertEqual(image[80, 100, 2], 0.0)

    def test_a_box_aimed_at_lies_inside_the_image_and_reaches_its_sides(self):
        lower, upper = np.array([-0.3, -0.2, 0.0]), np.array([0.3, 0.2, 0.15])
        camera = aimed_at(lower, upper, 800)
        corners = np.array([[x, y, z] for x in (-0.3, 0.3) for y in (-0.2, 0.2) for z in (0.0, 0.15)])
        column, row, _ = camera.project(corners)
        self.assertGreaterEqual(column.min(), -1e-6)
        self.assertLessEqual(column.max(), 800 + 1e-6)
        self.assertGreaterEqual(row.min(), -1.0)
        self.assertLessEqual(row.max(), camera.height + 1.0)
        self.assertTrue(column.min() < 8 or column.max() > 792)

    def test_making_an_image_smaller_keeps_the_colour_at_the_rim_and_halves_its_cover(self):
        image = np.zeros((2, 2, 4))
        image[:, 0] = [1.0, 0.5, 0.0, 1.0]
        np.testing.assert_allclose(smaller(image, 2)[0, 0], [1.0, 0.5, 0.0, 0.5])


if __name__ == "__main__":
    unittest.main()
