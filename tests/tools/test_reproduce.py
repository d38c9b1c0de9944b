# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""tools/reproduce: the file of sweeps, the plan, what it costs, what is run again and what is not.

PERIPORO_PROGRAM is the program that the last test runs; without it, that of build/release.
"""
import json
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

from made_up_sweeps import CASE, COLUMNS, Folder, coarse_pictures
from periporo_tools.reproduction.case_text import read_case
from periporo_tools.reproduction.cost import Cost, Pace, cost_of, duration_text
from periporo_tools.reproduction.plan import State, distinct, plan
from periporo_tools.reproduction.runner import locked
from periporo_tools.reproduction.sweeps import SweepError, read_sweeps

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = Path(os.environ.get("PERIPORO_PROGRAM", ROOT / "build/release/bin/periporo"))

# Notes how it was called and leaves what the program leaves; `behave` in the overrides says how it ends.
FAKE = """#!/bin/bash
if [[ $1 == --version ]]; then echo "periporo 9.9"; exit; fi
here=$(dirname "$0")
echo "$*" >>"$here/calls"
while [[ $1 != --out ]]; do shift; done
out=$2
case "$*" in
    *behave=wrong*) echo "case.toml: error: unknown key"; exit 2 ;;
    *refuse*--resume* | *--resume*refuse*) echo "periporo: checkpoint of another case"; exit 2 ;;
esac
mkdir -p "$out"
touch "$out/case.toml" "$out/run.log"
case "$*" in
    *behave=fail*)
        echo "collapse: 0.1 s (10 %), 1e5 point-steps/s" >&2
        echo "periporo: stage 'collapse', step 7: point 3 is not finite" >&2
        echo '{"outcome": "failed"}' >"$out/summary.json"
        exit 1 ;;
    *behave=crash*) exit 1 ;;
    *behave=wait*)
        if [[ "$*" != *--resume* ]]; then
            stop() {
                touch "$out/checkpoint.h5"
                echo '{"outcome": "interrupted"}' >"$out/summary.json"
                exit 130
            }
            trap stop INT TERM
            touch "$here/started"
            for ((i = 0; i < 600; ++i)); do sleep 0.1; done
        fi ;;
esac
rm -f "$out/checkpoint.h5"
touch "$out/results.h5"
echo '{"outcome": "complete", "wall_seconds": 2.0}' >"$out/summary.json"
"""


class Sweeps(Folder):
    def test_axes_values_and_defaults_are_read(self):
        book, _ = self.columns()
        columns, friction = book.sweeps
        a, s = columns.axes
        self.assertEqual([value.label for value in a.values], ["0.6", "1.2"])
        self.assertEqual([value.number for value in s.values], [0.0, 20.0])
        self.assertEqual(s.words(s.values[1]), "s = 20 kPa")
        self.assertEqual(s.plot_label, "suction [kPa]")
        self.assertEqual([value.set for value in s.values], [(), ('body.column.water.suction = "{s} kPa"',)])
        self.assertEqual(friction.figures, ("response",))
        self.assertEqual(friction.axes[0].title, "friction")

    def test_a_label_that_is_no_number_stands_nowhere_on_a_line(self):
        axis = read_sweeps(self.write(
            '[[sweep]]\nname = "n"\ntitle = "t"\ncase = "c"\n[[sweep.axis]]\nname = "x"\n'
            'values = ["rough", { label = "smooth", number = 3 }]'
        )).sweeps[0].axes[0]
        self.assertEqual([value.number for value in axis.values], [None, 3.0])
        self.assertFalse(axis.numeric)
        self.assertEqual(axis.words(axis.values[0]), "rough")

    def test_the_small_variant_leaves_out_and_replaces(self):
        book, runs = self.columns(small=True)
        self.assertEqual([value.label for value in book.sweeps[1].axes[0].values], ["0.2", "0.8"])
        self.assertEqual(runs["friction"][1].overrides,
                         ('discretization.spacing = "20 mm"', "contact.0.friction = 0.8"))

    def test_a_sweep_can_have_a_small_variant_of_its_own(self):
        text = COLUMNS.replace('title = "Columns"', 'title = "Columns"\nsmall = ["stage.0.duration = \\"1 ms\\""]')
        _, runs = self.columns(text, small=True)
        self.assertEqual(runs["columns"][0].overrides, ('stage.0.duration = "1 ms"',))
        self.assertEqual(runs["friction"][0].overrides[0], 'discretization.spacing = "20 mm"')
        _, runs = self.columns(text)
        self.assertEqual(runs["columns"][0].overrides, ())


HEAD = '[[sweep]]\nname = "one"\ntitle = "t"\ncase = "case.toml"\n'
AXIS = '[[sweep.axis]]\nname = "x"\nvalues = [1, 2]\n'


class Mistakes(Folder):
    """Each is an error that names the file, the place in it and a way out."""

    def refused(self, text, *words, planned=False):
        self.write(CASE, "case.toml")
        with self.assertRaises(SweepError) as caught:
            book = read_sweeps(self.write(text))
            if planned:
                plan(book, self.out)
        for word in ("sweeps.toml", *words):
            self.assertIn(word, str(caught.exception))

    def test_what_is_no_toml_is_refused_with_its_line(self):
        self.refused('[[sweep]]\nname = one\n', "line 2")

    def test_a_file_that_is_not_there_names_the_option_for_another(self):
        with self.assertRaisesRegex(SweepError, "nowhere.toml.*--sweeps"):
            read_sweeps(self.here / "nowhere.toml")

    def test_a_file_without_sweeps_says_how_one_is_written(self):
        self.refused("", "[[sweep]]")

    def test_unknown_keys_are_refused_with_the_nearest_one(self):
        self.refused("[[sweeps]]\n", '"sweeps"', '"sweep"')
        self.refused("[small]\nsets = []\n" + HEAD + AXIS, "[small]", '"sets"', '"set"')
        self.refused(HEAD + 'figure = []\n' + AXIS, 'sweep "one"', '"figures"')
        self.refused(HEAD + AXIS + 'log = true\n', 'axis "x"', "scale")
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = [{ label = "1", sets = [] }]', "value 1", '"set"')
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = [{ label = "1", small = { labels = "2" } }]',
                     "value 1", "small", '"label"')

    def test_what_is_missing_is_named(self):
        self.refused('[[sweep]]\ntitle = "t"\n' + AXIS, "sweep 1", '"name"')
        self.refused('[[sweep]]\nname = "one"\n' + AXIS, 'sweep "one"', '"title"')
        self.refused(HEAD, 'sweep "one"', "[[sweep.axis]]")
        self.refused(HEAD + '[[sweep.axis]]\nvalues = [1]', 'sweep "one", axis 1', '"name"')
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"', 'axis "x"', "values = [0.1, 0.2]")
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = [{ set = [] }]', "value 1", '"label"')

    def test_names_must_be_fit_for_files_and_their_own(self):
        self.refused(HEAD.replace('"one"', '"one/two"') + AXIS, "name", "letters")
        self.refused((HEAD + AXIS) * 2, '"one"', "two sweeps")
        self.refused(HEAD + AXIS * 2, 'sweep "one"', "two axes")
        self.refused(HEAD.replace('"one"', '"statements"') + AXIS, "statements", "choose another")
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = [1, "1"]', 'axis "x"', "twice")
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = ["a b", "a-b"]', 'sweep "one"', "x-a-b", planned=True)

    def test_overrides_are_key_and_value(self):
        for wrong in ('set = ["friction"]', 'set = [3]', 'set = ["= 3"]', 'set = "a = 3"'):
            self.refused(HEAD + wrong + "\n" + AXIS, 'sweep "one"', "set")

    def test_wrong_kinds_are_named(self):
        self.refused(HEAD.replace('"t"', "3") + AXIS, "title", "3")
        self.refused(HEAD + "statements = 1\n" + AXIS, "statements", "true or false")
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = [[1]]', "value 1", "a list")
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = [{ label = "l", number = "2" }]', "number")

    def test_scales_and_figures_are_those_there_are(self):
        self.refused(HEAD + AXIS + 'scale = "logarithmic"', 'axis "x"', '"log"')
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nscale = "log"\nvalues = [0, 1]', "above zero")
        self.refused(HEAD + 'figures = ["respond"]\n' + AXIS, '"respond"', '"response"')

    def test_statements_need_their_axes_and_one_sweep(self):
        self.refused(HEAD + "statements = true\n" + AXIS, "statements", '"a"')
        both = HEAD + "statements = true\n" + AXIS.replace('"x"', '"a"') + AXIS.replace('"x"', '"s"')
        self.refused(both + both.replace('"one"', '"two"'), "one and two")

    def test_braces_hold_axes(self):
        self.refused(HEAD.replace("case.toml", "case_{y}.toml") + AXIS, "{y}", "There is x", planned=True)
        self.refused(HEAD + 'set = ["a.b = {xx}"]\n' + AXIS, "{xx}", '"x"', planned=True)

    def test_cases_must_be_there(self):
        self.refused(HEAD.replace("case.toml", "cased.toml") + AXIS, "cased.toml", "relative to", planned=True)
        self.refused(HEAD.replace('case = "case.toml"\n', "") + AXIS, 'case = "FILE.toml"', planned=True)

    def test_the_command_says_so_and_returns_two(self):
        self.write("[[sweeps]]")
        status, _, error = self.called()
        self.assertEqual(status, 2)
        self.assertTrue(error.startswith("reproduce: "))

    def test_an_unknown_sweep_is_named_with_those_there_are(self):
        self.columns()
        status, _, error = self.called("colums")
        self.assertEqual(status, 2)
        self.assertIn('did you mean "columns"?', error)


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


class Running(Folder):
    """With a stand-in for the program."""

    SWEEP = """
[[sweep]]
name = "one"
title = "One"
case = "case.toml"
[[sweep.axis]]
name = "x"
set = ["contact.0.x = {x}"]
values = [1, { label = "2", set = ["behave=fine"] }, 3]
"""

    def setUp(self):
        super().setUp()
        self.write(CASE, "case.toml")
        self.program = self.write(FAKE, "program")
        self.program.chmod(0o755)

    def reproduce(self, text=SWEEP, *arguments):
        """Exit status, what the program was called with, standard error."""
        self.write(text)
        calls = self.here / "calls"
        calls.unlink(missing_ok=True)
        status, _, error = self.called("one", "--program", self.program, *arguments)
        return status, calls.read_text().splitlines() if calls.exists() else [], error

    def states(self):
        return [run.state() for run in plan(read_sweeps(self.here / "sweeps.toml"), self.out)["one"]]

    def test_missing_runs_are_run_with_their_overrides(self):
        status, calls, error = self.reproduce(self.SWEEP, "--threads", "3")
        self.assertEqual(status, 0)
        self.assertEqual(calls[0], f"run {self.here}/case.toml --out {self.out}/one/x1 --overwrite --threads 3"
                                   " --set contact.0.x = 1")
        self.assertEqual(len(calls), 3)
        self.assertEqual(self.states(), [State.COMPLETE] * 3)
        self.assertIn("[1/3] one/x1: begins", error)
        self.assertIn("[1/3] one/x1: done", error)
        record = json.loads((self.out / "one/x1.json").read_text())
        self.assertEqual((record["overrides"], record["program"]), (["contact.0.x = 1"], "periporo 9.9"))

    def test_what_is_complete_is_not_run_again(self):
        self.reproduce()
        status, calls, error = self.reproduce()
        self.assertEqual((status, calls), (0, []))
        self.assertIn("all 3 runs are done", error)

    def test_only_the_run_whose_case_has_changed_is_run_anew_and_said_so(self):
        self.reproduce()
        changed = self.SWEEP.replace("behave=fine", "behave=well")
        self.write(changed)
        self.assertEqual(self.states(), [State.COMPLETE, State.CHANGED, State.COMPLETE])
        self.assertIn("one/x2", self.called()[1])
        status, calls, error = self.reproduce(changed)
        self.assertEqual((status, len(calls)), (0, 1))
        self.assertIn("--overwrite", calls[0])
        self.assertIn("one/x2: the case has changed, runs anew", error)

    def test_results_that_are_gone_are_made_again(self):
        self.reproduce()
        (self.out / "one/x3/results.h5").unlink()
        self.assertEqual(len(self.reproduce()[1]), 1)

    def test_a_run_that_fails_is_reported_the_others_go_on(self):
        status, calls, error = self.reproduce(self.SWEEP.replace("behave=fine", "behave=fail"))
        self.assertEqual((status, len(calls)), (1, 3))
        self.assertIn("one/x2: FAILED (exit status 1)", error)
        self.assertIn("point 3 is not finite", error)
        self.assertNotIn("10 %", error)  # the program's progress is not its complaint
        self.assertEqual(self.states(), [State.COMPLETE, State.FAILED, State.COMPLETE])
        _, calls, error = self.reproduce(self.SWEEP.replace("behave=fine", "behave=fail"))
        self.assertEqual(len(calls), 1)
        self.assertIn("failed the last time", error)

    def test_a_program_that_ends_without_a_word_has_failed_too(self):
        text = self.SWEEP.replace("behave=fine", "behave=crash")
        self.assertEqual(self.reproduce(text)[0], 1)
        self.assertEqual(self.states(), [State.COMPLETE, State.FAILED, State.COMPLETE])
        (self.out / "one/x2/checkpoint.h5").touch()  # left before a disk was full, perhaps
        self.assertEqual(self.states()[1], State.INTERRUPTED)

    def test_a_case_that_the_program_refuses_leaves_the_earlier_results_those_of_the_earlier_case(self):
        self.reproduce()
        status, _, error = self.reproduce(self.SWEEP.replace("behave=fine", "behave=wrong"))
        self.assertEqual(status, 1)
        self.assertIn("unknown key", error)
        self.write(self.SWEEP)
        self.assertEqual(self.states(), [State.COMPLETE] * 3)

    def test_a_folder_without_a_record_is_not_touched(self):
        (self.out / "one/x1").mkdir(parents=True)
        (self.out / "one/x1/thesis.txt").write_text("precious")
        status, calls, error = self.reproduce()
        self.assertEqual((status, len(calls)), (1, 2))
        self.assertIn("move it away", error)
        self.assertEqual((self.out / "one/x1/thesis.txt").read_text(), "precious")

    def test_a_run_that_was_killed_goes_on_from_its_checkpoint_or_begins_again_without_one(self):
        self.reproduce()
        for name in ("x1", "x3"):
            (self.out / "one" / name / "summary.json").unlink()
        (self.out / "one/x1/checkpoint.h5").touch()
        status, calls, error = self.reproduce()
        self.assertEqual(status, 0)
        self.assertIn("--resume", calls[0])
        self.assertIn("--overwrite", calls[1])
        self.assertIn("x1: goes on", error)

    def test_a_checkpoint_that_the_program_refuses_is_not_used(self):
        text = self.SWEEP.replace("behave=fine", "behave=refuse")
        self.reproduce(text)
        (self.out / "one/x2/summary.json").unlink()
        (self.out / "one/x2/checkpoint.h5").touch()
        status, calls, error = self.reproduce(text)
        self.assertEqual(status, 0)
        self.assertEqual(["--resume" in call for call in calls], [True, False])
        self.assertIn("cannot be used", error)
        self.assertEqual(self.states(), [State.COMPLETE] * 3)

    def test_ctrl_c_ends_after_the_checkpoint_and_the_same_command_goes_on(self):
        text = self.SWEEP.replace("behave=fine", "behave=wait")
        for number in (signal.SIGINT, signal.SIGTERM):
            with self.subTest(number):
                self.write(text)
                started = self.here / "started"
                started.unlink(missing_ok=True)
                process = subprocess.Popen(
                    [sys.executable, "-c",
                     "import sys; from periporo_tools.reproduction.main import main; sys.exit(main())",
                     "--sweeps", self.here / "sweeps.toml", "--out", self.out, "--program", self.program, "one"],
                    stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True,
                )
                while not started.exists() and process.poll() is None:
                    time.sleep(0.02)
                process.send_signal(number)
                _, error = process.communicate(timeout=60)
                self.assertEqual(process.returncode, 130, error)
                self.assertIn("x2: stopped with a checkpoint; the same command goes on", error)
                self.assertEqual(self.states()[1:], [State.INTERRUPTED, State.MISSING])
                status, calls, error = self.reproduce(text)
                self.assertEqual((status, len(calls)), (0, 2))
                self.assertIn("--resume", calls[0])
                self.assertEqual(self.states(), [State.COMPLETE] * 3)
            for name in ("x2", "x3"):  # once more with the other signal
                shutil.rmtree(self.out / "one" / name)

    def test_two_at_a_time_in_one_folder_are_refused(self):
        with locked(self.out):
            status, calls, error = self.reproduce()
        self.assertEqual((status, calls), (2, []))
        self.assertIn("another tools/reproduce is running", error)

    def test_a_program_that_does_not_start_is_the_users_error(self):
        self.write(self.SWEEP)
        status, _, error = self.called("one", "--program", self.here / "nowhere")
        self.assertEqual(status, 2)
        self.assertIn("tools/build", error)

    def test_the_list_runs_nothing_and_says_what_is_done(self):
        self.reproduce(self.SWEEP.replace("behave=fine", "behave=fail"))
        (self.here / "calls").unlink()
        status, text, _ = self.called()
        self.assertEqual(status, 0)
        self.assertFalse((self.here / "calls").exists())
        row = next(line.split() for line in text.splitlines() if line.startswith("  one"))
        self.assertEqual(row[:4], ["one", "3", "2", "1,200"])
        self.assertLessEqual(max(map(len, text.splitlines()[1:])), 80)


class RealRuns(Folder):
    SWEEP = f"""
[[sweep]]
name = "floor"
title = "Two floors"
case = "{ROOT}/cases/column_collapse/quickstart.toml"
set = ['discretization.spacing = "20 mm"', 'stage.collapse.duration = "20 ms"']
figures = ["initial_stress", "response"]
[[sweep.axis]]
name = "friction"
set = ["contact.0.friction = {{friction}}"]
values = [0.3, 0.6]
"""

    def test_two_tiny_runs_are_run_measured_and_drawn_and_the_second_call_runs_nothing(self):
        if not PROGRAM.is_file():
            self.skipTest(f"{PROGRAM} is not built")
        self.write(self.SWEEP)
        arguments = ("floor", "--program", PROGRAM, "--threads", 1, "--json", self.here / "floor.json")
        with coarse_pictures():
            status, text, error = self.called(*arguments)
        self.assertEqual(status, 0, error)
        self.assertIn("[2/2] floor/friction0.6: done", error)
        (sweep,) = json.loads((self.here / "floor.json").read_text())["sweeps"]
        for run, planned in zip(sweep["runs"], plan(read_sweeps(self.here / "sweeps.toml"), self.out)["floor"]):
            self.assertTrue(run["complete"])
            self.assertEqual(run["points"], 150)
            self.assertEqual(planned.cost.points, 150)
            self.assertEqual(run["spacing"], 0.02)
            self.assertLess(run["energy_error"], 0.05)
        for name in ("initial_stress", "response"):
            self.assertTrue((self.out / f"pictures/floor_{name}.png").is_file())
        begin = [path.stat().st_mtime_ns for path in sorted(self.out.glob("floor/*/results.h5"))]
        with coarse_pictures():
            status, again, error = self.called(*arguments)
        self.assertEqual(status, 0)
        self.assertIn("all 2 runs are done", error)
        self.assertEqual([path.stat().st_mtime_ns for path in sorted(self.out.glob("floor/*/results.h5"))], begin)
        self.assertEqual(again.splitlines()[:5], text.splitlines()[:5])


if __name__ == "__main__":
    unittest.main()
