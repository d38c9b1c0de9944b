# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Which points hang together."""
import unittest

import numpy as np

from periporo_tools.clusters import close_pairs, components, heaviest_component


class Clusters(unittest.TestCase):
    def test_close_pairs_are_those_that_comparing_all_with_all_finds(self):
        points = np.random.default_rng(1).uniform(-1.0, 1.0, (400, 3))
        first, second = close_pairs(points, 0.3)
        found = {tuple(sorted(pair)) for pair in zip(first.tolist(), second.tolist())}
        apart = np.linalg.norm(points[:, None] - points[None], axis=2)
        expected = {(i, j) for i in range(400) for j in range(i + 1, 400) if apart[i, j] <= 0.3}
        self.assertEqual(found, expected)
        self.assertEqual(len(first), len(expected))  # each pair once

    def test_a_long_chain_is_one_component_whatever_the_order_of_its_points(self):
        order = np.random.default_rng(2).permutation(500)
        points = np.zeros((500, 3))
        points[order, 0] = np.arange(500.0)
        label = components(500, *close_pairs(points, 1.1))
        self.assertEqual(set(label), {0})

    def test_the_heaviest_component_is_by_mass_not_by_count(self):
        points = np.array([[0.0, 0, 0], [1.0, 0, 0], [2.0, 0, 0], [9.0, 0, 0]])
        chosen = heaviest_component(points, np.array([1.0, 1.0, 1.0, 5.0]), 1.5)
        self.assertEqual(chosen.tolist(), [False, False, False, True])


if __name__ == "__main__":
    unittest.main()
