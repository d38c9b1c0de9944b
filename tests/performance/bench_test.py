# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The benchmark's table is complete and its comparisons are right; how fast anything is, is not asked here."""
import contextlib
import io
import json
import os
import tempfile
import unittest
from pathlib import Path

from periporo_tools.benchmark import peer, table
from periporo_tools.benchmark.loads import Load, Measurement
from periporo_tools.benchmark.machine import Ceilings
from periporo_tools.benchmark.main import main

_PHASES = {
    "refresh": 1.0, "kinematics": 4.0, "material": 3.0, "force": 2.0, "contact": 0.0, "integration": 0.0,
    "step_estimate": 0.0, "output": 0.0,
}


def _report(flops_per_second: float, seconds: float) -> table.Report:
    load = Load("energy_conjugate", "viscoplastic_critical_state", 2, 10, 100)
    found = Measurement(
        load.force_state, load.material, load.threads, points=1000, steps=100, refreshes=4, bonds_per_point=80.0,
        bytes_per_point=1e4, peak_bytes_per_point=1.2e4, flowing=1.0, seconds=seconds, phase_seconds=_PHASES,
    )
    ceilings = {2: Ceilings(2, flops_per_second, 1e10)}
    return table.Report("a machine", "2026-01-01", ceilings, [(load, found)])


class Tables(unittest.TestCase):
    def test_rates_are_points_times_steps_over_seconds(self):
        row = _report(1e11, 10.0).as_json()["rows"][0]
        self.assertEqual(row["point_steps_per_second"], 1e4)
        self.assertEqual(row["bond_steps_per_second"], 8e5)

    def test_phases_are_microseconds_of_one_thread(self):
        _, found = _report(1e11, 10.0).rows[0]
        self.assertAlmostEqual(found.microseconds("kinematics"), 80.0)

    def test_a_faster_machine_makes_no_faster_program(self):
        stored = _report(1e11, 10.0).as_json()
        text = table.against(_report(2e11, 5.0), stored)
        self.assertIn("| 2.00 | 1.00", text)

    def test_rows_without_a_counterpart_are_left_out(self):
        stored = _report(1e11, 10.0).as_json()
        stored["rows"][0]["points"] = 999
        self.assertIn("no row in common", table.against(_report(1e11, 10.0), stored))


class Peer(unittest.TestCase):
    def test_the_rate_is_read_from_the_loop_time(self):
        printed = "Loop time of 2.5 on 2 procs for 60 steps with 27000 atoms\n"
        found = peer.read_loop("peri/lps", 2, printed)
        self.assertEqual((found.points, found.point_steps_per_second), (27000, 648000.0))

    def test_a_run_that_broke_off_is_an_error_with_its_words(self):
        with self.assertRaisesRegex(ValueError, "Lost atoms"):
            peer.read_loop("peri/lps", 1, "ERROR: Lost atoms")


class Benchmark(unittest.TestCase):
    def test_a_small_block_gives_every_number_of_the_table(self):
        with tempfile.TemporaryDirectory() as folder:
            out = Path(folder) / "bench.json"
            printed = io.StringIO()
            with contextlib.redirect_stdout(printed), contextlib.redirect_stderr(io.StringIO()):
                status = main(["--quick", "--edge", "8", "--steps", "60", "--json", str(out), "--against", "none",
                               "--build", os.environ["PERIPORO_BUILD_DIR"]])
            self.assertEqual(status, 0)
            content = json.loads(out.read_text())
        self.assertEqual({row["force_state"] for row in content["rows"]}, {"energy_conjugate", "bond_projection"})
        for row in content["rows"]:
            self.assertEqual(row["points"], 512)
            self.assertGreater(row["steps"], 40)  # about 60, at the step that the program takes
            self.assertEqual(row["flowing"], 1.0)  # the load is what it claims to be
            self.assertGreaterEqual(row["refreshes"], 1)
            self.assertGreater(row["point_steps_per_second"], 0.0)
            self.assertGreater(row["bytes_per_point"], 1000.0)
            self.assertGreater(row["peak_bytes_per_point"], row["bytes_per_point"])
            self.assertTrue(0.0 < row["ceiling_fraction"] < 1.0)
            self.assertGreater(row["phase_seconds"]["material"], 0.0)
        self.assertIn("point-steps/s", printed.getvalue())


if __name__ == "__main__":
    unittest.main()
