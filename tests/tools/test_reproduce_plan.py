# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""tools/reproduce: the runs of a file of sweeps, when two are the same, and what they cost."""
import unittest

from made_up_sweeps import CASE, COLUMNS, Folder
from periporo_tools.reproduction.case_text import read_case
from periporo_tools.reproduction.cost import Cost, Pace, cost_of, duration_text
from periporo_tools.reproduction.plan import distinct


class Plan(Folder):
    def test_every_combination_is_a_run_with_its_name_case_and_overrides(self):
        _, runs = self.columns()
        self.assertEqual([run.name for run in runs["columns"]], ["a0.6_s0", "a0.6_s20", "a1.2_s0", "a1.2_s20"])
        last = runs["columns"][-1]
        self.assertEqual(last.case.name, "column_1.2.toml")
        self.assertEqual(last.overrides, ('body.column.water.suction = "20 kPa"',))
        self.assertEqual(last.folder, self.out / "columns" / "a1.2_s20")
        self.assertEqual(last.record, self.out / "columns" / "a1.2_s20.json")

    def test_a_number_is_set_apart_from_a_name_that_ends_in_one(self):
        text = COLUMNS.replace('name = "friction"\nset', 'name = "K0"\nset').replace("{friction}", "{K0}")
        _, runs = self.columns(text)
        self.assertEqual(runs["friction"][1].name, "K0-0.5")

    def test_labels_in_braces_leave_tables_of_toml_alone(self):
        text = COLUMNS.replace("""'body.column.water.suction = "{s} kPa"'""",
                               """'body.column.water = { type = "uniform", suction = "{s} kPa" }'""")
        _, runs = self.columns(text)
        self.assertEqual(runs["columns"][1].overrides,
                         ('body.column.water = { type = "uniform", suction = "20 kPa" }',))

    def test_a_value_can_bring_its_own_case_and_a_label_of_words(self):
        self.write(CASE, "cylinder.toml")
        text = COLUMNS.replace('"0.6", "1.2"', '"0.6", { label = "a cylinder", case = "cylinder.toml" }')
        _, runs = self.columns(text)
        self.assertEqual(runs["columns"][2].name, "a-a-cylinder_s0")
        self.assertEqual(runs["columns"][2].case.name, "cylinder.toml")

    def test_runs_that_compute_the_same_share_a_folder(self):
        _, runs = self.columns()
        own, same = runs["columns"][0], runs["friction"][0]  # its friction of 0.2 is that of the case
        self.assertEqual(same.folder, own.folder)
        self.assertEqual(same.shared_with, "columns/a0.6_s0")
        self.assertEqual(len(distinct(runs["columns"] + runs["friction"])), 4 + 2)


class CaseTexts(Folder):
    def identity(self, *overrides):
        return read_case(self.here / "case.toml", overrides).identity()

    def setUp(self):
        super().setUp()
        self.write(CASE, "base.toml")
        self.write('include = ["base.toml"]\n[discretization]\nspacing = "5 mm"\n', "case.toml")

    def test_own_keys_lie_over_included_ones(self):
        tables = read_case(self.here / "case.toml").tables
        self.assertEqual(tables["discretization"]["spacing"], "5 mm")
        self.assertEqual(tables["contact"][0]["friction"], 0.2)

    def test_comments_and_the_title_do_not_change_what_is_computed(self):
        before = self.identity()
        self.write("# a remark\n" + CASE.replace("A column", "The column"), "base.toml")
        self.assertEqual(self.identity(), before)

    def test_a_number_in_an_included_file_does(self):
        before = self.identity()
        self.write(CASE.replace("0.2", "0.3"), "base.toml")
        self.assertNotEqual(self.identity(), before)

    def test_an_override_is_as_good_as_the_same_text_in_the_file(self):
        changed = self.identity("contact.0.friction = 0.3", "stage.collapse.duration = 1 s")
        self.write(CASE.replace("0.2", "0.3").replace("0.65 s", "1 s"), "base.toml")
        self.assertEqual(self.identity(), changed)

    def test_the_content_of_a_file_that_the_case_names_counts(self):
        self.write("0 0 0", "map.asc")
        before = self.identity('body.ground.file = "map.asc"')
        self.write("1 1 1", "map.asc")
        self.assertNotEqual(self.identity('body.ground.file = "map.asc"'), before)

    def test_what_cannot_be_read_is_left_to_the_program(self):
        self.write("a = ", "base.toml")
        broken = self.identity()
        self.write("a = = ", "base.toml")
        self.assertNotEqual(self.identity(), broken)
        self.assertNotEqual(self.identity("contact.7.friction = 1"), self.identity())


class Costs(Folder):
    def cost(self, *overrides):
        return cost_of(read_case(self.write(CASE, "case.toml"), overrides))

    def test_points_fill_the_boxes(self):
        self.assertEqual(self.cost().points, 10 * 10 * 12)
        self.assertEqual(self.cost('discretization.spacing = "5 mm"').points, 8 * 1200)

    def test_symmetry_planes_cut_bodies(self):
        cut = ('body.column.geometry.origin = ["-50 mm", "0 mm", "0 mm"]',
               'boundary = [{ type = "symmetry", plane = "x = 0 mm" }]')
        self.assertEqual(self.cost(*cut).points, 600)
        cylinder = 'body.column.geometry = { generator = "cylinder", radius = "100 mm", height = "100 mm" }'
        self.assertEqual(self.cost(cylinder, cut[1]).points, 1571)  # half of pi 10^2 10

    def test_half_the_spacing_takes_sixteen_times_as_long(self):
        fine = self.cost('discretization.spacing = "5 mm"')
        self.assertAlmostEqual(fine.point_steps / self.cost().point_steps, 16.0)

    def test_what_it_does_not_know_it_does_not_guess(self):
        self.assertEqual(self.cost('body.column.geometry.generator = "sphere"'), Cost(None, None))
        self.assertEqual(self.cost("stage = 3"), Cost(1200, None))

    def test_the_time_left_follows_the_speed_seen(self):
        pace = Pace(threads=2)
        pace.add(Cost(10, 1e6), 50.0)
        pace.add(Cost(10, 3e6), 150.0)
        self.assertAlmostEqual(pace.seconds([Cost(10, 2e6), Cost(10, 1e6)]), 150.0)

    def test_a_run_of_unknown_cost_counts_as_the_mean_of_the_others(self):
        pace = Pace()
        self.assertIsNone(pace.seconds([Cost(None, None)]))
        pace.add(Cost(10, 1e6), 50.0)
        pace.add(Cost(None, None), 70.0)
        self.assertAlmostEqual(pace.seconds([Cost(None, None), Cost(10, 1e6)]), 60.0 + 50.0)

    def test_before_anything_has_run_two_threads_are_twice_as_fast(self):
        one, two = (Pace(threads).seconds([Cost(10, 1e6)]) for threads in (1, 2))
        self.assertAlmostEqual(one, 2.0 * two)

    def test_durations_are_said_as_the_program_says_them(self):
        self.assertEqual([duration_text(s) for s in (40, 185, 7800)], ["40 s", "3 min 5 s", "2 h 10 min"])


if __name__ == "__main__":
    unittest.main()
