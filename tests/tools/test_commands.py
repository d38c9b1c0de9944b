# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The shell commands in tools/, run in a made-up tree with stand-ins for what they call."""
import os
import shutil
import signal
import subprocess
import tempfile
import time
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[2] / "tools"


def script(path: Path, text: str) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("#!/bin/bash\n" + text)
    path.chmod(0o755)


class Tree(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.here = Path(temporary.name)
        self.tree = self.here / "tree with a space"
        (self.tree / "tools").mkdir(parents=True)
        self.elsewhere = self.here / "elsewhere"
        self.elsewhere.mkdir()
        self.calls = self.here / "calls"

    def take(self, *names):
        for name in names:
            shutil.copy(TOOLS / name, self.tree / "tools" / name)

    def stand_in(self, path: Path, then: str = "") -> None:
        """A script that notes how it was called."""
        script(path, f'echo "{path.name} $*" >>"{self.calls}"\n{then}')

    def noted(self):
        return self.calls.read_text().splitlines() if self.calls.exists() else []


class Run(Tree):
    def setUp(self):
        super().setUp()
        self.take("run")
        self.program = self.tree / "build/release/bin/periporo"
        self.stand_in(self.tree / "tools/build")
        self.stand_in(self.tree / "tools/pictures", 'echo "Verdict: fine"')
        self.stand_in(self.program)

    def called(self, *arguments):
        return subprocess.run(
            [self.tree / "tools/run", *arguments], cwd=self.elsewhere, capture_output=True, text=True, check=False
        )

    def test_it_builds_runs_and_draws_in_this_order(self):
        done = self.called("my case.toml")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(
            self.noted(), ["build release program", "periporo run my case.toml", "pictures results/my case"]
        )
        self.assertEqual(done.stdout.splitlines()[-1], "Verdict: fine")

    def test_the_results_folder_is_named_after_the_case_less_its_last_suffix(self):
        self.called("cases/column/paper_a1.2.toml")
        self.assertEqual(self.noted()[-1], "pictures results/paper_a1.2")

    def test_the_folder_of_out_is_drawn_in_each_way_it_can_be_given(self):
        for arguments in (["--out", "there", "c.toml"], ["c.toml", "--out=there"]):
            self.called(*arguments)
            self.assertEqual(self.noted()[-1], "pictures there")

    def test_values_of_options_are_not_taken_for_the_case(self):
        self.called("--set", "a=b", "--threads", "2", "--plugin-path", "p", "c.toml", "--resume")
        self.assertEqual(self.noted()[1], "periporo run --set a=b --threads 2 --plugin-path p c.toml --resume")
        self.assertEqual(self.noted()[-1], "pictures results/c")

    def test_the_exit_status_of_the_program_is_passed_on_and_nothing_is_drawn(self):
        for status in (1, 2, 130):
            script(self.program, f"exit {status}")
            self.assertEqual(self.called("c.toml").returncode, status)
        self.assertNotIn("pictures", " ".join(self.noted()))

    def test_pictures_that_fail_are_a_failure(self):
        script(self.tree / "tools/pictures", "exit 2")
        self.assertEqual(self.called("c.toml").returncode, 2)

    def test_without_a_case_it_shows_its_usage_and_builds_nothing(self):
        done = self.called("--threads", "2")
        self.assertEqual(done.returncode, 2)
        self.assertIn("Usage", done.stderr)
        self.assertEqual(self.noted(), [])

    def test_a_build_that_fails_runs_nothing(self):
        self.stand_in(self.tree / "tools/build", "exit 1")
        self.assertEqual(self.called("c.toml").returncode, 1)
        self.assertEqual(self.noted(), ["build release program"])

    def test_sigterm_reaches_the_program_and_its_status_comes_back(self):
        # The stand-in ends by itself with 130 once the signal has come, as the program does after its checkpoint.
        script(self.program, f'trap "exit 130" TERM\ntouch "{self.here}/started"\nwhile true; do sleep 0.05; done')
        process = subprocess.Popen(
            [self.tree / "tools/run", "c.toml"], cwd=self.elsewhere, stdout=subprocess.PIPE, stderr=subprocess.PIPE
        )
        deadline = time.monotonic() + 60
        while not (self.here / "started").exists() and time.monotonic() < deadline:
            time.sleep(0.02)
        process.send_signal(signal.SIGTERM)
        _, error = process.communicate(timeout=60)
        self.assertEqual(process.returncode, 130)
        self.assertIn(b"--resume", error)


class Setup(Tree):
    def setUp(self):
        super().setUp()
        self.take("setup")
        self.bin = self.here / "bin"
        self.packages = subprocess.run(
            [self.tree / "tools/setup", "--list"], capture_output=True, text=True, check=True
        ).stdout.split()
        self.stand_in(self.bin / "apt-get", f'echo "frontend $DEBIAN_FRONTEND" >>"{self.calls}"')
        # Used when the tests do not run as root: does at once what it is asked for.
        script(self.bin / "sudo", '[[ $1 != -n ]] || shift\nexec "$@"')

    def installed(self, packages):
        text = "".join(f"{package}=installed " for package in packages)
        script(self.bin / "dpkg-query", f"printf '%s' '{text}'\nexit 1")  # fails when it does not know a name

    def called(self, *arguments):
        return subprocess.run(
            [self.tree / "tools/setup", *arguments], cwd=self.elsewhere, capture_output=True, text=True,
            stdin=subprocess.DEVNULL, env={**os.environ, "PATH": f"{self.bin}:{os.environ['PATH']}"}, check=False,
        )

    def test_when_everything_is_there_apt_is_not_touched_and_nothing_is_said(self):
        self.installed(self.packages)
        done = self.called()
        self.assertEqual((done.returncode, done.stdout, self.noted()), (0, "", []))

    def test_only_what_is_missing_is_installed_without_questions(self):
        self.installed([package for package in self.packages if package not in ("cmake", "libfmt-dev")])
        done = self.called()
        self.assertEqual(done.returncode, 0, done.stderr)
        calls = [line for line in self.noted() if line.startswith("apt-get")]
        self.assertEqual(len(calls), 2)
        self.assertTrue(calls[0].endswith(" update"))
        self.assertTrue(calls[1].endswith(" install --no-install-recommends cmake libfmt-dev"))
        self.assertEqual(self.noted().count("frontend noninteractive"), 2)

    def test_a_package_that_was_removed_but_not_purged_is_missing(self):
        others = "".join(f"{package}=installed " for package in self.packages[1:])
        script(self.bin / "dpkg-query", f"printf '%s' '{self.packages[0]}=config-files {others}'")
        self.called()
        self.assertTrue(self.noted()[2].endswith(f" {self.packages[0]}"))

    def test_when_apt_fails_its_output_is_shown(self):
        self.installed([])
        self.stand_in(self.bin / "apt-get", "echo no network; exit 100")
        done = self.called()
        self.assertEqual(done.returncode, 1)
        self.assertIn("no network", done.stderr)

    def test_what_apt_does_is_shown_now_and_then(self):
        self.installed([])
        self.stand_in(self.bin / "apt-get", "echo Reading lists; echo more of it")
        lines = self.called().stdout.splitlines()
        self.assertEqual(lines[1:], 2 * ["setup: Reading lists"])  # of update and of install

    def test_an_unknown_argument_is_the_users_error(self):
        self.assertEqual(self.called("--fast").returncode, 2)

    def test_no_package_is_listed_twice(self):
        self.assertEqual(len(self.packages), len(set(self.packages)))


class Build(Tree):
    def setUp(self):
        super().setUp()
        self.take("build")
        self.stand_in(self.tree / "tools/setup")
        self.stand_in(self.here / "bin/cmake", "echo a line of cmake")
        self.stand_in(self.here / "bin/ninja")

    def called(self, *arguments):
        environment = {**os.environ, "PATH": f"{self.here}/bin:{os.environ['PATH']}", "PERIPORO_JOBS": "3"}
        return subprocess.run(
            [self.tree / "tools/build", *arguments], cwd=self.elsewhere, capture_output=True, text=True,
            env=environment, check=False,
        )

    def test_it_sets_up_configures_and_builds_in_this_order_and_says_one_line(self):
        done = self.called()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.noted(), ["setup ", "cmake --preset release", "ninja -C build/release -j 3"])
        self.assertEqual(done.stdout.splitlines(), ["build: build/release, 3 at a time"])

    def test_off_a_terminal_it_shows_a_step_now_and_then_and_every_message(self):
        self.stand_in(
            self.here / "bin/ninja",
            'echo "ninja: no work to do."; for step in 1 2 3; do echo "${NINJA_STATUS/\\%f/$step}source"; done; echo "source: a message"; exit 1',
        )
        done = self.called()
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stdout.splitlines()[1:], ["build: [1/%t] source", "source: a message"])

    def test_when_cmake_fails_its_output_is_shown_and_nothing_is_built(self):
        self.stand_in(self.here / "bin/cmake", "echo no such package >&2; exit 1")
        done = self.called("dev")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no such package", done.stderr)
        self.assertEqual(self.noted()[-1], "cmake --preset dev")

    def test_a_source_that_does_not_build_is_a_failure(self):
        self.stand_in(self.here / "bin/ninja", "exit 1")
        self.assertEqual(self.called().returncode, 1)

    def test_without_packages_nothing_is_configured(self):
        self.stand_in(self.tree / "tools/setup", "exit 1")
        self.assertEqual(self.called().returncode, 1)
        self.assertEqual(self.noted(), ["setup "])


class Test(Tree):
    def test_arguments_go_to_ctest_in_the_folder_of_the_presets(self):
        self.take("test")
        self.stand_in(self.tree / "tools/build")
        self.stand_in(self.here / "bin/ctest", f'pwd >>"{self.calls}"')
        done = subprocess.run(
            [self.tree / "tools/test", "-R", "unit case"], cwd=self.elsewhere, capture_output=True, text=True,
            env={**os.environ, "PATH": f"{self.here}/bin:{os.environ['PATH']}"}, check=False,
        )
        self.assertEqual(done.returncode, 0, done.stderr)
        build, ctest, folder = self.noted()
        self.assertEqual(build, "build release")
        self.assertRegex(ctest, r"^ctest --preset release --parallel \d+ -R unit case$")
        self.assertEqual(folder, str(self.tree))


class Help(unittest.TestCase):
    def test_every_command_explains_itself_with_an_example(self):
        for name in ("setup", "build", "run", "test", "pictures", "verify", "dispersion", "drive", "bench"):
            done = subprocess.run([TOOLS / name, "--help"], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 0, name)
            self.assertRegex(done.stdout, r"(?i)usage", name)
            self.assertRegex(done.stdout, r"(?i)examples?:", name)


if __name__ == "__main__":
    unittest.main()
