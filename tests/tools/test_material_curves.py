# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""tools/material_curves: every law against its closed forms, and that a curve which is off is noticed.

PERIPORO_PROGRAM is the program that drives the paths; without it, that of build/release.
"""
import contextlib
import io
import math
import os
import tempfile
import unittest
import unittest.mock
from pathlib import Path

import matplotlib.image
import numpy as np

from periporo_tools.material_curves.comparison import Curve, Panel, curve_over, table, through
from periporo_tools.material_curves.driver import Driver
from periporo_tools.material_curves.main import LAWS, main
from test_commands import TOOLS, script

PROGRAM = Path(os.environ.get("PERIPORO_PROGRAM", TOOLS.parent / "build/release/bin/periporo"))
# A parameter that each law's curves must notice.
TELLING = {
    "linear_elastic": "bulk_modulus", "drucker_prager": "cohesion", "mohr_coulomb": "cohesion",
    "j2_plasticity": "yield_stress", "mu_i_rheology": "static_friction",
    "viscoplastic_critical_state": "compression_index",
}


def line(*found, tolerance=0.01):
    x = np.arange(len(found), dtype=float)
    return curve_over("curve", x, np.array(found), lambda at: 2.0 * at, tolerance, "because")


def panel(*curves):
    return Panel("test", "x", "y", "y = 2 x", list(curves))


def outside(panels):
    return [f"{one.title}: {curve.name}" for one in panels for curve in one.curves if not curve.holds]


class Comparison(unittest.TestCase):
    def test_the_difference_is_the_largest_one_over_the_largest_expectation(self):
        self.assertAlmostEqual(line(0.0, 2.2, 3.9).difference, 0.2 / 4.0)

    def test_a_curve_holds_up_to_its_tolerance(self):
        self.assertTrue(line(0.0, 2.03, 4.0).holds)
        self.assertFalse(line(0.0, 2.05, 4.0).holds)

    def test_what_is_no_number_and_what_is_nothing_never_hold(self):
        self.assertFalse(line(0.0, math.nan, 4.0).holds)
        nothing = np.array([])
        self.assertFalse(Curve("", (nothing, nothing), (nothing, nothing), nothing, nothing, 1.0, "").holds)

    def test_the_table_marks_what_is_outside(self):
        lines = table({"law": [panel(line(0.0, 2.0, 4.0), line(0.0, 2.0, 5.0))]}).splitlines()
        self.assertTrue(lines[1].startswith("ok "))
        self.assertTrue(lines[2].startswith("FAIL "))

    def test_a_formula_by_a_parameter_is_one_of_x(self):
        angle = np.linspace(0.0, np.pi, 10001)
        self.assertAlmostEqual(float(through(-np.cos(angle), np.sin(angle))(0.6)), 0.8, 7)


class Laws(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.drive = Driver(PROGRAM, Path(temporary.name))

    def test_every_law_keeps_to_its_closed_forms(self):
        for name, panels in LAWS.items():
            with self.subTest(name):
                self.assertEqual(outside(panels(self.drive)), [])

    def test_a_parameter_that_is_off_by_one_per_cent_is_noticed_in_every_law(self):
        right = Driver.__call__

        def wrong(drive, material, *rest):
            return right(drive, material | {parameter: 1.01 * material[parameter]}, *rest)

        for name, parameter in TELLING.items():
            with self.subTest(name), unittest.mock.patch.object(Driver, "__call__", wrong):
                self.assertNotEqual(outside(LAWS[name](self.drive)), [])

    def test_every_law_with_a_page_is_driven_but_for_routines_of_others(self):
        pages = {page.parent.name for page in (TOOLS.parent / "plugins/material").glob("*/README.md")}
        self.assertEqual(pages - {"abaqus_user_material"}, set(LAWS))
        self.assertEqual(set(TELLING), set(LAWS))


class Command(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def called(self, *arguments, program=PROGRAM):
        output, error = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(output), contextlib.redirect_stderr(error):
            try:
                status = main([*arguments, "--out", str(self.folder), "--program", str(program)])
            except SystemExit as stop:
                status = stop.code
        return status, output.getvalue() + error.getvalue()

    def test_a_law_is_drawn_and_nothing_unfinished_is_left(self):
        status, output = self.called("linear_elastic")
        self.assertEqual(status, 0, output)
        image = matplotlib.image.imread(self.folder / "linear_elastic.png")
        self.assertGreater(len(np.unique(np.round(image[..., :3].reshape(-1, 3), 1), axis=0)), 5)
        self.assertEqual([file.name for file in self.folder.iterdir()], ["linear_elastic.png"])

    def test_a_curve_that_is_off_is_a_failure(self):
        off = {"linear_elastic": lambda drive: [panel(line(0.0, 2.0, 5.0)), panel(line(0.0, 2.0, 4.0))]}
        with unittest.mock.patch.dict(LAWS, off):
            status, output = self.called("linear_elastic")
        self.assertEqual(status, 1)
        self.assertIn("1 of 2 curves", output)

    def test_a_path_that_fails_shows_what_the_program_said(self):
        script(self.folder / "program", "echo 'it went wrong here' >&2\nexit 1\n")
        status, output = self.called("linear_elastic", program=self.folder / "program")
        self.assertEqual(status, 1)
        self.assertIn("it went wrong here", output)

    def test_an_unknown_law_is_named_with_those_there_are(self):
        status, output = self.called("mohr_culomb")
        self.assertEqual(status, 2)
        self.assertIn("mohr_culomb", output)
        self.assertIn("mohr_coulomb", output)


if __name__ == "__main__":
    unittest.main()
