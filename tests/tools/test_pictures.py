# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""tools/pictures as a user calls it: pictures, summary, verdict, table, series, exit status."""
import contextlib
import io
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import h5py
import matplotlib.image
import numpy as np

import synthetic
from periporo_tools.main import main
from periporo_tools.results import Results, ResultError, write_comparison

PROGRAM = Path(__file__).resolve().parents[2] / "tools" / "pictures"


def called(*arguments):
    """Exit status, standard output and standard error."""
    out, error = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
        status = main([str(argument) for argument in arguments])
    return status, out.getvalue(), error.getvalue()


class Pictures(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = synthetic.write_results(
            Path(cls.temporary.name) / "run", extra=np.array([[0.3, 0.05, 0.005]])
        )
        cls.status, cls.text, _ = called(cls.folder)
        cls.summary = json.loads((cls.folder / "summary.json").read_text())
        cls.comparison = cls.summary["comparison"]

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_the_exit_status_is_zero(self):
        self.assertEqual(self.status, 0)

    def test_four_pictures_show_something_in_more_than_one_colour(self):
        for name in ("deposit", "profile", "history", "sequence"):
            image = matplotlib.image.imread(self.folder / f"{name}.png")
            self.assertGreater(image.shape[1], 800, name)
            colours = np.unique(np.round(image[..., :3].reshape(-1, 3), 1), axis=0)
            self.assertGreater(len(colours), 5, name)

    def test_nothing_unfinished_is_left_behind(self):
        self.assertEqual(list(self.folder.glob("*.part")), [])

    def test_the_programs_own_keys_stay_in_the_summary(self):
        self.assertEqual(self.summary["exit"], "complete")
        self.assertEqual(self.summary["case"]["spacing"], 0.01)

    def test_differences_are_measured_over_law_less_one(self):
        rows = {(row["quantity"], row["source"]): row for row in self.comparison["laws"]}
        run_out = rows["run_out", "Lube et al. 2004"]
        self.assertAlmostEqual(run_out["law"], 1.24 * 1.2)
        self.assertAlmostEqual(run_out["measured"], self.comparison["measured"]["front_mean"] / 0.1 - 1.0)
        self.assertAlmostEqual(run_out["difference"], run_out["measured"] / (1.24 * 1.2) - 1.0)
        height = rows["height", "Lajeunesse et al. 2004"]
        self.assertAlmostEqual(height["difference"], self.comparison["measured"]["height"] / 0.1 / 0.74 - 1.0)

    def test_where_a_law_has_a_gap_the_neighbours_are_recorded(self):
        gap = next(row for row in self.comparison["laws"] if row["law"] is None)
        self.assertEqual((gap["quantity"], gap["source"]), ("height", "Lube et al. 2004"))
        self.assertEqual([edge["aspect_ratio"] for edge in gap["gap_between"]], [0.74, 1.7])
        self.assertIsNone(gap["difference"])

    def test_time_of_rest_and_energies_come_from_the_histories(self):
        measured = self.comparison["measured"]
        self.assertAlmostEqual(measured["rest_time"], 0.3, delta=0.5 / 400)  # one row of the history
        self.assertAlmostEqual(measured["potential_energy_released"], 10.0)
        self.assertAlmostEqual(measured["energy_error_largest"], 0.05 / 10.0)
        motion = next(row for row in self.comparison["laws"] if row["quantity"] == "end_of_motion")
        self.assertAlmostEqual(motion["measured"], measured["rest_time"] / math.sqrt(0.12 / 9.81))

    def test_the_escaped_point_is_counted(self):
        self.assertEqual(self.comparison["measured"]["escaped_points"], 1)

    def test_the_last_line_is_the_verdict(self):
        last = self.text.rstrip().splitlines()[-1]
        self.assertEqual(last, "Verdict: " + self.comparison["verdict"])
        self.assertIn("law 1.49 (Lube et al. 2004)", last)
        self.assertIn("1 of ", last)

    def test_drawing_twice_gives_the_same_comparison(self):
        called(self.folder)
        again = json.loads((self.folder / "summary.json").read_text())
        self.assertEqual(again["comparison"], self.comparison)

    def test_the_table_has_a_row_for_each_run_and_names_the_sources(self):
        status, text, _ = called("--table", self.folder, self.folder)
        self.assertEqual(status, 0)
        rows = [line for line in text.splitlines() if line.startswith("| A made-up heap")]
        self.assertEqual(len(rows), 2)
        self.assertEqual({line.count("|") for line in text.splitlines() if line.startswith("|")}, {15})
        self.assertIn("Lajeunesse et al. 2004", text)

    def test_a_series_is_one_picture(self):
        picture = self.folder / "series.png"
        status, text, _ = called("--series", self.folder, self.folder, "--out", picture)
        self.assertEqual(status, 0)
        self.assertEqual(text.strip(), str(picture))
        self.assertGreater(matplotlib.image.imread(picture).shape[0], 300)

    def test_runs_side_by_side_are_one_picture_twice_as_wide(self):
        pictures = [self.folder / name for name in ("one.png", "two.png")]
        for picture, folders in zip(pictures, ([self.folder], [self.folder, self.folder])):
            status, text, _ = called("--side-by-side", *folders, "--out", picture)
            self.assertEqual(status, 0)
            self.assertEqual(text.strip(), str(picture))
        one, two = (matplotlib.image.imread(picture) for picture in pictures)
        self.assertGreater(two.shape[1], 1.5 * one.shape[1])


class UnusualResults(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.folder = Path(self.temporary.name) / "run"

    def comparison(self):
        return json.loads((self.folder / "summary.json").read_text())["comparison"]

    def test_without_a_comparison_no_law_is_drawn(self):
        synthetic.write_results(self.folder, case={"spacing": 0.01, "symmetry": ["x", "y"]})
        status, text, _ = called(self.folder)
        self.assertEqual(status, 0)
        self.assertNotIn("laws", self.comparison())
        self.assertNotIn("Lube", text)

    def test_a_slab_one_point_thick_against_a_wall_is_measured_along_x(self):
        synthetic.write_results(self.folder, quarter=False, case={"spacing": 0.01, "symmetry": []})
        with h5py.File(self.folder / "results.h5", "r+") as file:
            for group in file["snapshots"].values():
                x, y, _ = np.asarray(group["position"]).T
                kept = (y >= 0.0) & (y < 0.01) & (x > 0.0)  # one row
                for name, values in [(name, np.asarray(data)[kept]) for name, data in group.items()]:
                    unit = group[name].attrs["unit"]
                    del group[name]
                    group.create_dataset(name, data=values).attrs["unit"] = unit
        status, text, _ = called(self.folder)
        self.assertEqual(status, 0)
        # the lowest row of the cone, y = z = 5 mm, ends where hypot(x, y) <= 0.2 m (1 - z/0.08 m): at x = 185 mm
        self.assertAlmostEqual(self.comparison()["measured"]["front_mean"], 0.19)
        self.assertNotIn("along x and y", text)

    def test_without_a_summary_the_spacing_comes_from_the_volumes(self):
        synthetic.write_results(self.folder, quarter=False)
        (self.folder / "summary.json").unlink()
        self.assertEqual(called(self.folder)[0], 0)
        self.assertAlmostEqual(self.comparison()["spacing"], 0.01)

    def test_an_unknown_law_is_named_and_the_pictures_are_drawn(self):
        case = {"spacing": 0.01, "symmetry": ["x", "y"], "comparison": {"law": "conical", "radius": 0.1, "height": 0.1}}
        synthetic.write_results(self.folder, case=case)
        status, _, error = called(self.folder)
        self.assertEqual(status, 0)
        self.assertIn('no law is called "conical"', error)
        self.assertTrue((self.folder / "profile.png").is_file())

    def test_without_histories_and_plastic_strain_the_displacement_is_drawn(self):
        synthetic.write_results(self.folder, strain=False, history=False)
        self.assertEqual(called(self.folder)[0], 0)
        self.assertFalse((self.folder / "history.png").exists())
        with Results(self.folder) as results:
            colour = results.snapshot(-1).colour
        self.assertEqual((colour.name, colour.unit), ("displacement", "mm"))
        np.testing.assert_allclose(colour.values, 5.0)  # (3, 0, 4) mm

    def test_any_field_can_colour_the_pictures_a_vector_by_its_length_or_a_component(self):
        synthetic.write_results(self.folder)
        for field, unit, value in (("displacement", "m", 5e-3), ("displacement.z", "m", 4e-3), ("density", "kg/m3", 0.0)):
            with self.subTest(field=field), Results(self.folder, field) as results:
                colour = results.snapshot(-1).colour
                self.assertEqual((colour.name, colour.unit), (field.replace(".", " "), unit))
                np.testing.assert_allclose(colour.values, value or synthetic.DENSITY)
        self.assertEqual(called(self.folder, "--field", "density")[0], 0)

    def test_a_field_that_is_not_there_is_the_users_error_and_says_what_is(self):
        synthetic.write_results(self.folder)
        for field, part in (("satur", "there are body, density"), ("displacement.q", "displacement.x"),
                            ("density.x", "has no components")):
            with self.subTest(field=field):
                status, _, error = called(self.folder, "--field", field)
                self.assertEqual(status, 2)
                self.assertIn(part, error)

    def test_an_incomplete_run_says_so(self):
        synthetic.write_results(self.folder)
        with h5py.File(self.folder / "results.h5", "r+") as file:
            file.attrs["complete"] = 0
        called(self.folder)
        self.assertIn("NOT COMPLETE", self.comparison()["verdict"])

    def test_a_run_that_stopped_before_the_release_is_drawn(self):
        synthetic.write_results(self.folder, history=False)
        with h5py.File(self.folder / "results.h5", "r+") as file:
            for name in list(file["snapshots"])[1:]:
                del file["snapshots"][name]
        self.assertEqual(called(self.folder)[0], 0)

    def test_a_folder_without_results_is_the_users_error(self):
        status, _, error = called(self.folder)
        self.assertEqual(status, 2)
        self.assertIn("results.h5", error)

    def test_points_that_are_not_finite_are_left_out_and_counted(self):
        synthetic.write_results(self.folder)
        with h5py.File(self.folder / "results.h5", "r+") as file:
            file["snapshots"]["000011"]["position"][7, 1] = np.nan
        self.assertEqual(called(self.folder)[0], 0)
        self.assertEqual(self.comparison()["measured"]["not_finite_points"], 1)
        self.assertIn("1 POINTS NOT FINITE", self.comparison()["verdict"])

    def test_a_snapshot_without_any_finite_point_is_an_error_that_names_it(self):
        synthetic.write_results(self.folder)
        with h5py.File(self.folder / "results.h5", "r+") as file:
            file["snapshots"]["000011"]["position"][:, 2] = np.nan
        status, _, error = called(self.folder)
        self.assertEqual(status, 2)
        self.assertIn("snapshot 000011", error)

    def test_a_summary_that_is_not_json_is_left_as_it_is(self):
        synthetic.write_results(self.folder)
        (self.folder / "summary.json").write_text("{")
        with self.assertRaises(ResultError):
            write_comparison(self.folder, {})
        self.assertEqual((self.folder / "summary.json").read_text(), "{")

    def test_the_program_itself_runs_from_any_folder(self):
        synthetic.write_results(self.folder)
        done = subprocess.run(
            [PROGRAM, "--table", "run"], cwd=self.folder.parent, capture_output=True, text=True,
            env={**os.environ, "PYTHONPATH": ""}, check=False,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("A made-up heap", done.stdout)


if __name__ == "__main__":
    unittest.main()
