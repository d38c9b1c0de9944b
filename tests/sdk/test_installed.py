# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Installs the build, moves the installation, and lets its program write a plugin of each kind.

Each project is built against the installed SDK with warnings as errors, its own tests are run, the program inspects
its plugin, and runs its case to the end. Nothing of the source tree or of the build is used but `cmake --install`.
"""
from __future__ import annotations

import argparse
import json
import os
import shutil
import subprocess
import tempfile
import unittest
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

from clean_environment import clean_environment

KINDS = ("material", "geometry", "contact", "retention", "output")
WITH_A_CASE = tuple(kind for kind in KINDS if kind != "retention")

# GCC 12 sees uninitialised values and overflows in its own headers of packs, as in the sources of the project.
WARNINGS = "-Wall -Wextra -Wpedantic -Werror -Wno-maybe-uninitialized -Wno-stringop-overflow"

options: argparse.Namespace


def done(command: list[str], folder: Path) -> str:
    """What a command prints; when it fails, an error with all of that."""
    result = subprocess.run(
        command, cwd=folder, env=clean_environment(), text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT
    )
    if result.returncode != 0:
        raise AssertionError(f"{' '.join(command)}\nended with {result.returncode}:\n{result.stdout}")
    return result.stdout


class Installation:
    """A prefix that was moved after it was installed, to a path with a space, and one project for each kind."""

    def __init__(self, folder: Path):
        self.prefix = folder / "a moved prefix"
        self.labs = folder / "labs"
        self.labs.mkdir()
        first = folder / "first"
        done([options.cmake, "--install", options.build, "--prefix", str(first)], folder)
        first.rename(self.prefix)
        self.program = self.prefix / "bin" / "periporo"
        for kind in KINDS:
            done([str(self.program), "new", kind, self.name(kind)], self.labs)

    def name(self, kind: str) -> str:
        return f"lab_{kind}"

    def project(self, kind: str) -> Path:
        return self.labs / self.name(kind)

    def build(self, kind: str) -> None:
        definitions = [
            f"-DCMAKE_PREFIX_PATH={self.prefix}",
            f"-DCMAKE_CXX_COMPILER={options.compiler}",
            f"-DCMAKE_CXX_FLAGS={options.flags} {WARNINGS}",
            f"-DCMAKE_BUILD_TYPE={options.build_type}",
        ]
        done([options.cmake, "-G", "Ninja", "-B", "build", *definitions], self.project(kind))
        done([options.cmake, "--build", "build", "-j", "1"], self.project(kind))


class InstalledTest(unittest.TestCase):
    folder: Path
    installation: Installation
    builds: dict[str, Future]

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="periporo_sdk_")).resolve()
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        cls.installation = Installation(cls.folder)
        # All at once, one compiler each; the first, with packs, takes the longest.
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            cls.builds = {kind: pool.submit(cls.installation.build, kind) for kind in KINDS}

    def run_program(self, kind: str, *arguments: str) -> str:
        return done([str(self.installation.program), *arguments], self.installation.project(kind))

    def test_the_installed_program_finds_the_installed_plugins(self):
        listing = self.run_program("material", "inspect", "linear_elastic")
        self.assertIn(str(self.installation.prefix), listing)

    def test_a_new_plugin_of_each_kind_builds_without_warnings(self):
        for kind in KINDS:
            with self.subTest(kind=kind):
                self.builds[kind].result()

    def test_a_new_plugin_of_each_kind_passes_its_tests(self):
        ctest = str(Path(options.cmake).with_name("ctest"))
        for kind in KINDS:
            with self.subTest(kind=kind):
                said = done([ctest, "--test-dir", "build", "--output-on-failure"], self.installation.project(kind))
                self.assertIn("100% tests passed, 0 tests failed out of 1", said)

    def test_the_program_inspects_a_new_plugin_of_each_kind(self):
        for kind in KINDS:
            with self.subTest(kind=kind):
                name = self.installation.name(kind)
                said = self.run_program(kind, "inspect", name, "--plugin-path", "build/lib/periporo")
                self.assertIn(f"{kind} {name}: ", said)
                self.assertIn(f"periporo_{kind}_{name}.so", said)

    def test_the_case_of_a_new_plugin_runs_to_its_end(self):
        for kind in WITH_A_CASE:
            with self.subTest(kind=kind):
                name = self.installation.name(kind)
                self.run_program(kind, "run", f"{name}.toml", "--quiet", "--threads", "2")
                results = self.installation.project(kind) / "results" / name
                summary = json.loads((results / "summary.json").read_text())
                self.assertEqual(summary["outcome"], "complete", summary)

    def test_a_plugin_that_is_installed_beside_those_of_the_program_is_found_without_a_path(self):
        prefix = shutil.copytree(self.installation.prefix, self.folder / "copy", symlinks=True)
        done([options.cmake, "--install", "build", "--prefix", str(prefix)], self.installation.project("retention"))
        said = done([str(prefix / "bin" / "periporo"), "inspect", self.installation.name("retention")], self.folder)
        self.assertIn(str(prefix), said)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", required=True, type=os.path.abspath, help="folder of the build that is installed")
    parser.add_argument("--cmake", default="cmake")
    parser.add_argument("--compiler", default="c++")
    parser.add_argument("--flags", default="", help="compiler flags of the build, such as those of a sanitizer")
    parser.add_argument("--build-type", default="Release")
    options = parser.parse_args()
    unittest.main(argv=["test_installed.py", "-v"])
