# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The table of tools/verify, its exit status, and the curves of tools/dispersion."""
import contextlib
import io
import json
import math
import tempfile
import unittest
from pathlib import Path

import matplotlib.image
import numpy as np

from periporo_tools import dispersion
from periporo_tools.verification import checks, report
from periporo_tools.verification.outcome import Curve, Refinement, Row
from periporo_tools.verification.main import main


def row(found, expected=2.0, tolerance=0.1, absolute=False):
    return Row("case", "speed", "m/s", expected, found, tolerance, "because", absolute)


class Rows(unittest.TestCase):
    def test_a_relative_difference_is_over_the_size_of_the_expectation(self):
        self.assertAlmostEqual(row(2.1).difference, 0.05)
        self.assertAlmostEqual(row(-2.1, expected=-2.0).difference, -0.05)
        self.assertTrue(row(2.19).holds)
        self.assertFalse(row(2.21).holds)

    def test_an_absolute_difference_serves_where_zero_is_expected(self):
        self.assertTrue(row(0.09, expected=0.0, absolute=True).holds)
        self.assertFalse(row(-0.11, expected=0.0, absolute=True).holds)

    def test_what_is_no_number_never_holds(self):
        self.assertFalse(row(math.nan).holds)
        self.assertFalse(row(math.inf).holds)

    def test_the_table_marks_rows_outside_their_tolerance(self):
        lines = report.table([row(2.0), row(3.0)]).splitlines()
        self.assertTrue(lines[1].startswith("ok "))
        self.assertTrue(lines[2].startswith("FAIL "))
        self.assertIn("because", lines[2])

    def test_the_json_table_has_what_machines_need(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "table.json"
            report.write_json([row(np.float64(3.0), tolerance=np.float64(0.1))], path)
            (record,) = json.loads(path.read_text())
        for key in ("name", "quantity", "expected", "found", "difference", "tolerance", "reason"):
            self.assertIn(key, record)
        self.assertAlmostEqual(record["difference"], 0.5)
        self.assertFalse(record["holds"])


class Refinements(unittest.TestCase):
    def test_the_order_is_the_slope_between_the_two_finest_lattices(self):
        spacings = np.array([0.02, 0.01, 0.005])
        self.assertAlmostEqual(Refinement("case", spacings, np.array([9.0, -0.4, 0.1])).order, 2.0)
        self.assertAlmostEqual(Refinement("case", spacings, -3.0 * spacings).order, 1.0)

    def test_they_share_the_last_panel_of_the_page(self):
        line = np.array([0.0, 1.0])
        refinement = Refinement("case", np.array([0.02, 0.01]), np.array([0.1, 0.05]))
        with tempfile.TemporaryDirectory() as folder:
            alone = report.draw([Curve("t", "x", "y", [("found", line, line)])], [], Path(folder) / "alone.png")
            both = report.draw([Curve("t", "x", "y", [("found", line, line)])], [refinement], Path(folder) / "both.png")
            widths = [matplotlib.image.imread(picture).shape[1] for picture in (alone, both)]
        self.assertEqual(widths[1], 2 * widths[0])


class Command(unittest.TestCase):
    def run_main(self, *arguments):
        error = io.StringIO()
        with contextlib.redirect_stderr(error), contextlib.redirect_stdout(io.StringIO()):
            try:
                status = main([str(argument) for argument in arguments])
            except SystemExit as stop:
                status = stop.code
        return status, error.getvalue()

    def test_an_unknown_case_is_named_with_those_there_are(self):
        status, error = self.run_main("p_weave")
        self.assertEqual(status, 2)
        self.assertIn("p_weave", error)
        self.assertIn("p_wave", error)

    def test_cases_that_fail_show_their_commands_and_what_the_program_said(self):
        with tempfile.TemporaryDirectory() as folder:
            program = Path(folder) / "program"
            program.write_text("#!/bin/sh\necho 'it went wrong here' >&2\nexit 1\n")
            program.chmod(0o755)
            status, error = self.run_main("--small", "--program", program, "p_wave", "incline")
        self.assertEqual(status, 1)
        self.assertIn("p_wave.toml", error)
        self.assertIn("incline.toml", error)  # the first does not keep the second from running
        self.assertIn("it went wrong here", error)


class Cases(unittest.TestCase):
    def test_every_check_has_its_case(self):
        cases = Path(__file__).resolve().parents[2] / "cases/verification"
        for name in checks.CHECKS:
            self.assertTrue((cases / f"{name}.toml").is_file(), name)


class Dispersion(unittest.TestCase):
    TABLE = "force_state,influence,direction,wave,wave_number_times_spacing,relative_phase_speed\n" + "".join(
        f"energy_conjugate,linear,{direction},{wave},{k},{1.0 - 0.1 * k}\n"
        for direction in ("100", "110", "111")
        for wave in "PS"
        for k in (0.785398, 1.570796, 3.141593)
    )

    def test_curves_are_drawn_and_summed_up(self):
        with tempfile.TemporaryDirectory() as folder:
            table = Path(folder) / "table.csv"
            table.write_text(self.TABLE)
            curves = dispersion.read(table)
            picture = dispersion.draw(curves, Path(folder) / "picture.png")
            self.assertGreater(picture.stat().st_size, 5000)
        self.assertEqual(len(curves), 6)
        lines = dispersion.summary(curves).splitlines()
        self.assertEqual(len(lines), 3)
        self.assertIn("0.921", lines[1])  # 1 - 0.1 pi/4
        self.assertIn("0.686", lines[1])  # 1 - 0.1 pi


if __name__ == "__main__":
    unittest.main()
