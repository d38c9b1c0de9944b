# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""tools/reproduce: statements, figures, tables and the page, from made-up results."""
import json
import shutil
import tempfile
import unittest
from pathlib import Path

import h5py
import matplotlib.image
import numpy as np
from PIL import Image

import synthetic
from made_up_sweeps import CASE, Folder, coarse_pictures
from periporo_tools.reproduction import figures, page, statements, tables
from periporo_tools.reproduction.outcomes import Measurer
from periporo_tools.reproduction.plan import plan
from periporo_tools.reproduction.sweeps import SweepError, read_sweeps


def add_fields(folder, times=(0.1, 0.2, 0.9)):
    """What the real program writes and synthetic results lack: stress and water, outcome, resolved case."""
    with h5py.File(folder / "results.h5", "r+") as file:
        for snapshot in file["snapshots"].values():
            height = snapshot["position"][:, 2].max()
            stress = np.zeros((len(snapshot["position"]), 6))
            stress[:, 2] = -synthetic.DENSITY * 9.81 * (height - snapshot["position"][:, 2]) - 0.5 * 2000.0
            snapshot["effective_stress"] = stress
            snapshot["suction"] = np.full(len(stress), 2000.0)
            snapshot["saturation"] = np.full(len(stress), 0.5)
    summary = json.loads((folder / "summary.json").read_text())
    summary.update(outcome="complete", steps=1000, points=300, wall_seconds=12.5)
    (folder / "summary.json").write_text(json.dumps(summary))
    (folder / "case.toml").write_text(f"[[output]]\nwriter = \"hdf5\"\ntimes = {list(times)}\n")


def record(run):
    run.record.write_text(json.dumps({"identity": run.identity, "program": "periporo 9.9"}))


class Drawing(Folder):
    """Everything of two sweeps from made-up results."""

    TEXT = """
[[sweep]]
name = "columns"
title = "Columns"
case = "column_{a}.toml"
statements = true
figures = ["initial_stress", "snapshots", "deposits", "response", "scaling"]
[[sweep.axis]]
name = "a"
values = ["0.6", "1.2"]
[[sweep.axis]]
name = "s"
unit = "kPa"
set = ["body.column.water.suction = {s}"]
values = [0, 20, 40]

[[sweep]]
name = "states"
title = "Force states"
case = "column_1.2.toml"
figures = ["response", "deposits"]
[[sweep.axis]]
name = "state"
set = ["operator.state = '{state}'"]
values = ["conjugate", "projection"]
[[sweep.axis]]
name = "floor"
set = ["floor = '{floor}'"]
values = ["rough", "smooth"]
"""

    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.here = Path(cls.temporary.name)
        cls.out = cls.here / "out"
        for a in ("0.6", "1.2"):
            (cls.here / f"column_{a}.toml").write_text(CASE.replace("120 mm", f"{a[0]}{a[2]}0 mm"))
        (cls.here / "sweeps.toml").write_text(cls.TEXT)
        cls.book = read_sweeps(cls.here / "sweeps.toml")
        cls.runs = plan(cls.book, cls.out)
        for run in [*cls.runs["columns"][:-1], *cls.runs["states"][1:]]:  # one of each is missing
            a = 0.06 if run.name.startswith("a0.6") else 0.12
            suction = (run.values[1].number or 0.0) / 20.0
            if not run.folder.exists():
                synthetic.write_results(run.folder, spacing=0.02, initial_height=a, height=0.06 + 0.01 * suction,
                                        base_radius=0.2 - 0.02 * suction)
                add_fields(run.folder)
                record(run)
        (cls.here / "README.md").write_text(
            "# Beside the paper\n\n<!-- table: columns -->\nold\n<!-- end -->\nKeep  this.\n"
            "<!-- table: statements -->\n<!-- end -->\n![r](pictures/columns_response.png) ![p](pictures/photo.png)\n"
            '<img src="pictures/columns_initial_stress.png" width="500">\n'
        )
        with coarse_pictures():
            cls.status, cls.text, cls.error = Folder.called(cls, "--draw", "--page", "--json", cls.here / "all.json")

    def setUp(self):
        pass

    def test_the_exit_status_is_zero(self):
        self.assertEqual(self.status, 0, self.error)

    def test_every_figure_is_drawn_in_more_than_one_colour(self):
        names = ["columns_initial_stress", "columns_snapshots_a0.6", "columns_snapshots_a1.2", "columns_deposits_a0.6",
                 "columns_deposits_a1.2", "columns_response", "columns_scaling", "states_response",
                 "states_deposits_state-conjugate", "states_deposits_state-projection"]
        self.assertEqual({path.stem for path in (self.out / "pictures").iterdir()}, set(names))
        for name in names:
            image = matplotlib.image.imread(self.out / "pictures" / f"{name}.png")
            self.assertGreater(image.shape[1], 400, name)
            self.assertGreater(len(np.unique(np.round(image[::3, ::3, :3].reshape(-1, 3), 1), axis=0)), 5, name)

    def test_vertical_stress_is_total_and_positive_in_compression(self):
        (outcome,) = Measurer(self.fail)(self.book.sweeps[0], self.runs["columns"][:1]).outcomes
        with outcome.results() as results:
            stress = figures.vertical_stress(results, results.release)
            height = results.snapshot(results.release).position[:, 2]
            depth = height.max() - height
        np.testing.assert_allclose(stress.values, 1e-3 * synthetic.DENSITY * 9.81 * depth, atol=1e-12)

    def test_tables_have_a_row_for_each_run_and_say_which_is_missing(self):
        text = (self.out / "tables/columns.md").read_text()
        rows = [line for line in text.splitlines() if line.startswith("|")]
        self.assertEqual(len(rows), 2 + 6)
        self.assertEqual(len({line.count("|") for line in rows}), 1)
        self.assertTrue(rows[0].startswith("| a | s [kPa] | points | run-out [r0] |"))
        self.assertIn("40 (not run)", rows[-1])
        self.assertIn("Lube et al. 2004", text)

    def test_what_the_terminal_shows_fits_80_columns(self):
        lines = [line for line in self.text.splitlines() if str(self.here) not in line]
        self.assertLessEqual(max(map(len, lines)), 80, self.text)
        self.assertIn("a0.6_s20", self.text)

    def test_the_json_file_reads_back_with_every_run_and_number(self):
        content = json.loads((self.here / "all.json").read_text())
        self.assertEqual(content["variant"], "full")
        columns, states = content["sweeps"]
        self.assertEqual([len(sweep["runs"]) for sweep in (columns, states)], [6, 4])
        first, last = columns["runs"][0], columns["runs"][-1]
        self.assertEqual(first["axes"]["s"], {"label": "0", "number": 0.0})
        self.assertEqual((first["steps"], first["points"], first["wall_seconds"], first["spacing"]),
                         (1000, 300, 12.5, 0.02))
        self.assertTrue(first["complete"])
        self.assertAlmostEqual(first["rest_time"], 0.3, delta=0.5 / 400)  # one row of the history
        self.assertAlmostEqual(first["energy_error"], 0.05 / 10.0)
        self.assertEqual(first["escaped_share"], 0.0)
        self.assertAlmostEqual(first["run_out"], first["front"] / 0.1 - 1.0)
        law = next(row for row in first["laws"] if row["quantity"] == "run_out" and row["law"] is not None)
        self.assertAlmostEqual(law["difference"], first["run_out"] / (1.24 * 0.6) - 1.0)
        self.assertEqual((last["complete"], last["run_out"], last["state"]), (False, None, "not run"))
        self.assertEqual(len(columns["statements"]), 9)
        self.assertEqual(json.loads(json.dumps(content)), content)

    def test_the_page_has_tables_and_pictures_and_keeps_the_rest(self):
        text = (self.here / "README.md").read_text()
        self.assertTrue(text.startswith("# Beside the paper\n\n<!-- table: columns -->\n| a | s [kPa] |"))
        self.assertIn("<!-- end -->\nKeep  this.\n<!-- table: statements -->\n| the paper | is held to be so", text)
        self.assertNotIn("old", text)
        self.assertEqual({path.name for path in (self.here / "pictures").iterdir()},
                         {"columns_response.png", "columns_initial_stress.png"})
        self.assertIn("photo.png", self.error)

    def test_pictures_of_the_page_have_a_palette_of_128_and_are_small(self):
        for path in (self.here / "pictures").iterdir():
            self.assertLess(path.stat().st_size, 300_000)
            with Image.open(path) as picture:
                self.assertEqual(picture.mode, "P")
                self.assertLessEqual(len(picture.getcolors()), 128)

    def test_writing_the_page_again_changes_nothing(self):
        before = (self.here / "README.md").read_text()
        written = {path.stem: path.read_text().rstrip() for path in (self.out / "tables").iterdir()}
        changes = page.update(self.here / "README.md", written, list(written), [])
        self.assertEqual(changes.tables, ["columns", "statements"])
        self.assertEqual((self.here / "README.md").read_text(), before)

    def test_a_run_of_an_earlier_text_is_shown_and_said_so(self):
        runs = plan(read_sweeps(self.here / "sweeps.toml"), self.out)["columns"]
        record_text = runs[0].record.read_text()
        self.addCleanup(runs[0].record.write_text, record_text)
        runs[0].record.write_text(record_text.replace(runs[0].identity, "another"))
        result = Measurer(self.fail)(self.book.sweeps[0], runs[:1])
        self.assertIn("0 (of an earlier text of the case)", tables.markdown(result))


class Pages(unittest.TestCase):
    def test_a_region_without_end_is_refused_with_its_line(self):
        for text in ("\n<!-- table: a -->\n", "\n<!-- table: a -->\n<!-- table: b -->\n<!-- end -->\n"):
            with self.assertRaisesRegex(SweepError, "page.md, line 2: the table a has no end"):
                page.with_tables(text, {}, ["a", "b"], Path("page.md"))

    def test_an_unknown_table_is_refused_with_those_there_are(self):
        with self.assertRaisesRegex(SweepError, "line 1: there is no table c; there are a, b"):
            page.with_tables("<!-- table: c -->\n<!-- end -->", {}, ["a", "b"], Path("page.md"))

    def test_regions_whose_table_is_not_given_stay(self):
        text = "x\n<!-- table: a -->\nold\n<!-- end -->\ny\n<!-- table: b -->\nold\n<!-- end -->"
        changed, names = page.with_tables(text, {"b": "new"}, ["a", "b"], Path("page.md"))
        self.assertEqual(changed, text[:-len("old\n<!-- end -->")] + "new\n<!-- end -->")
        self.assertEqual(names, ["b"])

    def test_tables_and_pictures_of_the_small_variant_have_places_of_their_own(self):
        text = "<!-- table: a -->\nfull\n<!-- end -->\n<!-- table: small_a -->\nold\n<!-- end -->\n"
        with tempfile.TemporaryDirectory() as folder:
            there = Path(folder)
            (there / "page.md").write_text(text + "![f](pictures/one.png) ![s](pictures/small_one.png)\n")
            Image.new("RGB", (4, 4)).save(there / "one.png")
            changes = page.update(there / "page.md", {"a": "new"}, ["a"], [there / "one.png"], small=True)
            self.assertEqual(changes.tables, ["small_a"])
            self.assertTrue((there / "page.md").read_text().startswith(text.replace("old", "new")))
            self.assertEqual([path.name for path in (there / "pictures").iterdir()], ["small_one.png"])
            self.assertEqual(changes.missing, ["one.png"])

    def test_a_page_that_is_not_there_says_what_marks_a_table(self):
        with self.assertRaisesRegex(SweepError, "<!-- table: NAME -->"):
            page.update(Path("/nowhere/README.md"), {}, [], [])

    def test_a_picture_that_is_too_large_is_scaled_down(self):
        with tempfile.TemporaryDirectory() as folder:
            noise = np.random.default_rng(1).integers(0, 255, (650, 650, 3), dtype=np.uint8)
            Image.fromarray(noise).save(Path(folder) / "noise.png")
            page.small_png(Path(folder) / "noise.png", Path(folder) / "small.png")
            self.assertLess((Path(folder) / "small.png").stat().st_size, 300_000)


class Statements(Folder):
    """Deposits that are known to be so, and to be not so."""

    SPACING = 0.01

    def deposit(self, run, a, final, strain, early=None):
        """Results of a column that ends at `final`: initial positions, changed; `early` is how it looks at 0.1 s."""
        initial = synthetic.box(0.1, 0.1 * a, self.SPACING, True)
        run.folder.mkdir(parents=True)
        with h5py.File(run.folder / "results.h5", "w") as file:
            snapshots = file.create_group("snapshots")
            moments = [(0.0, initial, np.zeros(len(initial))), (0.1, initial if early is None else early, strain),
                       (0.3, final, strain)]
            for index, (moment, points, strained) in enumerate(moments):
                synthetic.write_snapshot(snapshots, f"{index:06d}", moment, points, self.SPACING)
                group = snapshots[f"{index:06d}"]
                group["displacement"][:] = points - initial
                group["equivalent_plastic_shear_strain"][:] = strained
        case = {"spacing": self.SPACING, "symmetry": ["x", "y"],
                "comparison": {"law": "axisymmetric_column", "radius": 0.1, "height": 0.1 * a}}
        (run.folder / "summary.json").write_text(json.dumps({"outcome": "complete", "case": case}))
        (run.folder / "case.toml").write_text("[[output]]\ntimes = [0.1]\n")
        record(run)

    def results(self, change):
        """The sweep of nine columns; `change(a, s, initial)` gives final positions, strains and early positions of
        those that have run."""
        text = """
[[sweep]]
name = "columns"
title = "Columns"
case = "column_0.6.toml"
statements = true
set = ["h = {a}", "s = {s}"]
[[sweep.axis]]
name = "a"
values = [0.6, 1.2, 2.0]
[[sweep.axis]]
name = "s"
unit = "kPa"
values = [0, 20, 40]
"""
        book, runs = self.columns(text)
        for run in runs["columns"]:
            a, s = (value.number for value in run.values)
            if (found := change(a, s, synthetic.box(0.1, 0.1 * a, self.SPACING, True))) is not None:
                self.deposit(run, a, *found)
        return Measurer(self.fail)(book.sweeps[0], runs["columns"])

    def dry(self, a, change):
        """Only the dry column of one ratio."""
        return self.results(lambda ratio, s, initial: change(initial) if (ratio, s) == (a, 0.0) else None)

    def test_a_core_whose_axis_stands_to_the_top_is_undisturbed(self):
        outside = lambda x: (np.hypot(x[:, 0], x[:, 1]) > 0.05).astype(float)
        found = statements.undisturbed_core(self.dry(0.6, lambda x: (x, outside(x))))
        self.assertEqual(found.outcome, "reproduced")
        share = float((outside(synthetic.box(0.1, 0.06, self.SPACING, True)) == 0).mean())
        self.assertAlmostEqual(found.numbers["undisturbed_share"], share)
        self.assertAlmostEqual(found.numbers["undisturbed_height"], 0.06)

    def test_a_core_that_is_sheared_above_half_its_height_is_not(self):
        above = lambda x: 0.02 * (x[:, 2] > 0.03)
        found = statements.undisturbed_core(self.dry(0.6, lambda x: (x, above(x))))
        self.assertEqual(found.outcome, "not reproduced")
        self.assertAlmostEqual(found.numbers["undisturbed_height"], 0.03)

    def test_the_entire_column_deforms_when_no_more_than_a_hundredth_does_not(self):
        for undeformed, outcome in ((0.009, "reproduced"), (0.012, "not reproduced")):
            with self.subTest(undeformed):
                strain = lambda x: (np.arange(len(x)) >= undeformed * len(x)).astype(float)
                self.assertEqual(statements.all_deforms(self.dry(1.2, lambda x: (x, strain(x)))).outcome, outcome)
                shutil.rmtree(self.out)

    def test_the_peak_stays_when_it_sinks_by_no_more_than_a_spacing(self):
        for sunk, outcome in ((0.5, "reproduced"), (1.5, "not reproduced")):
            with self.subTest(sunk):
                lower = lambda x: x - [0.0, 0.0, sunk * self.SPACING]
                found = statements.peak_stays(self.dry(1.2, lambda x: (lower(x), np.ones(len(x)))))
                self.assertEqual(found.outcome, outcome)
                self.assertAlmostEqual(found.numbers["height"], 0.12 - sunk * self.SPACING)
                shutil.rmtree(self.out)

    def test_all_moves_when_every_point_has_at_the_first_time(self):
        fallen = lambda x: (x * [1.3, 1.3, 0.5], np.ones(len(x)), x - [0.0, 0.0, 1.1 * self.SPACING])
        found = statements.all_moves(self.dry(2.0, fallen))
        self.assertEqual((found.outcome, found.numbers["moved_share"]), ("reproduced", 1.0))

    def test_not_all_moves_when_the_lower_half_still_stands(self):
        upper = lambda x: x - np.outer(x[:, 2] > 0.1, [0.0, 0.0, 1.1 * self.SPACING])
        found = statements.all_moves(self.dry(2.0, lambda x: (x, np.ones(len(x)), upper(x))))
        self.assertEqual((found.outcome, found.numbers["moved_share"]), ("not reproduced", 0.5))

    def test_the_upper_half_falls_straight_or_leans_out(self):
        def early(x, outward):
            upper = x[:, 2] > 0.1
            direction = x * [1.0, 1.0, 0.0] / np.hypot(x[:, 0], x[:, 1])[:, None]
            return x - np.outer(upper, [0.0, 0.0, 0.04]) + direction * np.where(upper, outward, 0.02)[:, None]

        for outward, outcome in ((0.005, "reproduced"), (0.015, "not reproduced")):
            with self.subTest(outward):
                found = statements.upper_half_falls(self.dry(2.0, lambda x: (x, np.ones(len(x)), early(x, outward))))
                self.assertEqual(found.outcome, outcome)
                self.assertAlmostEqual(found.numbers["upper_down"], 0.04)
                self.assertAlmostEqual(found.numbers["upper_outward"], outward)
                self.assertAlmostEqual(found.numbers["lower_outward"], 0.02)
                shutil.rmtree(self.out)

    def mound(self, x, reach):
        """The points of a column put into a mound 0.1 m high and wide, on a layer that reaches farther."""
        layer = synthetic.lattice((0.0, 0.0, 0.0), (reach, reach, self.SPACING), self.SPACING)
        layer = layer[np.hypot(layer[:, 0], layer[:, 1]) < reach]
        mound = synthetic.cone(0.12, 0.12, self.SPACING, True)
        return np.concatenate([layer, mound, np.tile(mound[:1], (len(x) - len(layer) - len(mound), 1))])

    def test_a_rim_is_wide_when_it_is_as_wide_as_the_column(self):
        for reach, outcome in ((0.28, "reproduced"), (0.16, "not reproduced")):
            with self.subTest(reach):
                found = statements.thin_rim(self.dry(2.0, lambda x: (self.mound(x, reach), np.ones(len(x)))))
                self.assertEqual(found.outcome, outcome)
                self.assertAlmostEqual(found.numbers["front"], reach, delta=1.5 * self.SPACING)
                shutil.rmtree(self.out)

    def wide(self, width):
        """Every column ends `width(a, s)` times as wide and as high as it began, over the square."""
        return self.results(lambda a, s, x: (x * [width(a, s), width(a, s), 1.0 / width(a, s) ** 2], np.ones(len(x))))

    def test_run_out_falls_height_rises_and_the_effect_grows(self):
        result = self.wide(lambda a, s: 1.3 - 0.002 * a * s)
        for statement in (statements.run_out_falls, statements.height_rises, statements.effect_grows):
            self.assertEqual(statement(result).outcome, "reproduced", statement(result))
        self.assertEqual([len(row) for row in statements.run_out_falls(result).numbers["run_out"].values()], [3, 3, 3])

    def test_one_step_that_does_not_fall_is_enough_against_it(self):
        result = self.wide(lambda a, s: 1.3 - (0.0 if (a, s) == (1.2, 40.0) else 0.002 * a * s))
        self.assertEqual(statements.run_out_falls(result).outcome, "not reproduced")
        self.assertEqual(statements.height_rises(result).outcome, "not reproduced")

    def test_an_effect_that_is_smaller_at_larger_a_is_not_reproduced(self):
        self.assertEqual(statements.effect_grows(self.wide(lambda a, s: 1.3 - 0.002 * s / a)).outcome, "not reproduced")

    def test_a_deposit_as_high_as_its_column_need_not_rise(self):
        result = self.wide(lambda a, s: 1.0 if a == 0.6 else 1.3 - 0.002 * a * s)
        self.assertEqual(statements.height_rises(result).outcome, "reproduced")

    def test_without_runs_nothing_is_judged(self):
        found = statements.findings(self.results(lambda a, s, x: None))
        self.assertEqual({finding.outcome for finding in found}, {"not run"})


if __name__ == "__main__":
    unittest.main()
