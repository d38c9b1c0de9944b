# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""tools/reproduce: what is run, what is not run again, and what a run that ends badly leaves.

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

from made_up_sweeps import CASE, Folder, coarse_pictures
from periporo_tools.reproduction.plan import State, plan
from periporo_tools.reproduction.runner import locked
from periporo_tools.reproduction.sweeps import read_sweeps

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
                touch "$out/checkpoint.bin"
                echo '{"outcome": "interrupted"}' >"$out/summary.json"
                exit 130
            }
            trap stop INT TERM
            touch "$here/started"
            for ((i = 0; i < 600; ++i)); do sleep 0.1; done
        fi ;;
esac
rm -f "$out/checkpoint.bin"
touch "$out/results.h5"
echo '{"outcome": "complete", "wall_seconds": 2.0}' >"$out/summary.json"
"""


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
        (self.out / "one/x2/checkpoint.bin").touch()  # left before a disk was full, perhaps
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
        (self.out / "one/x1/checkpoint.bin").touch()
        status, calls, error = self.reproduce()
        self.assertEqual(status, 0)
        self.assertIn("--resume", calls[0])
        self.assertIn("--overwrite", calls[1])
        self.assertIn("x1: goes on", error)

    def test_a_checkpoint_that_the_program_refuses_is_not_used(self):
        text = self.SWEEP.replace("behave=fine", "behave=refuse")
        self.reproduce(text)
        (self.out / "one/x2/summary.json").unlink()
        (self.out / "one/x2/checkpoint.bin").touch()
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
