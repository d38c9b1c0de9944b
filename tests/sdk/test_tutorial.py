# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Follows plugins/README.md word for word: its commands are typed, its files written, its changes made.

A block ```sh is typed into one shell, from the folder of the sources on, with an empty home. A block ```toml is the file
that was named last before it in backticks; a block ```diff changes the file that was named last so. Only the command
that builds the program is left out, since this very build is what is tested.
"""
from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

from clean_environment import clean_environment

SOURCE = Path(__file__).resolve().parents[2]
PAGE = SOURCE / "plugins" / "README.md"

options: argparse.Namespace


class Block:
    """A fenced block of the page, with the file that was named last before it."""

    def __init__(self, language: str, text: str, file: str):
        self.language = language
        self.text = text
        self.file = file


def blocks_of(page: str) -> list[Block]:
    blocks = []
    for match in re.finditer(r"^```(\w+)\n(.*?)^```$", page, re.MULTILINE | re.DOTALL):
        named = re.findall(r"`(\w+\.(?:hpp|cpp|toml))`", page[: match.start()])
        blocks.append(Block(match[1], match[2], named[-1] if named else ""))
    return blocks


def changed(text: str, diff: str) -> str:
    """The text after a change given by lines that begin with a blank (kept), - (gone) or + (new)."""
    lines = diff.splitlines()
    before = "".join(line[1:] + "\n" for line in lines if line[0] in " -")
    after = "".join(line[1:] + "\n" for line in lines if line[0] in " +")
    found = text.count(before)
    if found != 1:
        raise AssertionError(f"these lines stand {found} times in the file, not once:\n{before}")
    return text.replace(before, after)


class Shell:
    """One bash that keeps its folder and variables from block to block."""

    _DONE = "the block is done"

    def __init__(self, folder: Path, home: Path):
        environment = clean_environment() | {
            "HOME": str(home),
            "CXX": options.compiler,
            "CXXFLAGS": options.flags,
            "CMAKE_BUILD_TYPE": options.build_type,
        }
        self._bash = subprocess.Popen(
            ["bash", "--norc", "-e"],
            cwd=folder,
            env=environment,
            text=True,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )

    def folder(self) -> Path:
        return Path(self.type("pwd").strip())

    def type(self, commands: str) -> str:
        """What the commands print; when one of them fails, an error with all of that."""
        self._bash.stdin.write(f"{commands}\necho '{self._DONE}'\n")
        self._bash.stdin.flush()
        said = []
        for line in self._bash.stdout:
            if line.rstrip("\n") == self._DONE:
                return "".join(said)
            said.append(line)
        raise AssertionError(f"{commands}\nended with {self._bash.wait()}:\n{''.join(said)}")

    def close(self) -> None:
        self._bash.stdin.close()
        self._bash.wait()
        self._bash.stdout.close()


class TutorialTest(unittest.TestCase):
    """The page is followed once; each test looks at one thing that it promises."""

    said: dict[str, str] = {}  # by block
    laws: Path

    @classmethod
    def setUpClass(cls):
        home = Path(tempfile.mkdtemp(prefix="periporo_tutorial_"))
        cls.addClassCleanup(shutil.rmtree, home)
        cls.laws = home / "laws" / "quick_clay"
        shell = Shell(SOURCE, home)
        cls.addClassCleanup(shell.close)
        for block in blocks_of(PAGE.read_text()):
            if block.language == "sh":
                commands = re.sub(r"^tools/build$", "", block.text, flags=re.MULTILINE)
                cls.said[block.text] = shell.type(commands.replace("build/release", options.build))
            elif block.language == "toml":
                (shell.folder() / block.file).write_text(block.text)
            else:
                file = shell.folder() / block.file
                file.write_text(changed(file.read_text(), block.text))

    def test_the_law_passes_its_tests_before_and_after_it_was_changed(self):
        runs = [said for typed, said in self.said.items() if "ctest" in typed]
        self.assertEqual(len(runs), 2)
        for said in runs:
            self.assertIn("100% tests passed, 0 tests failed out of 1", said)

    def test_the_new_parameters_are_in_the_reference(self):
        said = [said for typed, said in self.said.items() if "inspect" in typed][-1]
        self.assertIn("sensitivity", said)
        self.assertIn("remoulding_strain", said)

    def test_the_driven_point_is_remoulded(self):
        lines = (self.laws / "results" / "shear" / "path.csv").read_text().splitlines()
        names = [name.split("[")[0].strip() for name in lines[0].split(",")]
        q = [float(line.split(",")[names.index("q")]) for line in lines[1:]]
        # undisturbed 600 Pa, remoulded an eighth of it, and q = 3 eta d eps_s/dt = sqrt(3) eta d gamma/dt of flow
        viscous = 3.0**0.5 * 2.0
        self.assertGreater(max(q), 580.0)
        self.assertLess(max(q), 600.0 + viscous)
        self.assertAlmostEqual(q[-1], 75.0 + viscous, delta=75.0 * 0.1)

    def test_the_column_has_collapsed_and_was_drawn(self):
        results = self.laws / "results" / "quick_clay"
        summary = json.loads((results / "summary.json").read_text())
        self.assertEqual(summary["outcome"], "complete", summary)
        measured = summary["comparison"]["measured"]
        # 160 mm before; "three fifths of its height"
        self.assertAlmostEqual(measured["height"], 0.6 * 0.16, delta=0.01)
        for picture in ("deposit.png", "history.png"):
            self.assertGreater((results / picture).stat().st_size, 10_000, picture)

    def test_the_installed_plugin_is_found_without_a_path(self):
        said = next(said for typed, said in self.said.items() if "cmake --install build" in typed and "~/" in typed
                    and "inspect" in typed)
        self.assertIn("material quick_clay: ", said)
        self.assertIn("no errors", list(self.said.values())[-1])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--build", required=True, help="folder of the build that is installed")
    parser.add_argument("--compiler", default="c++")
    parser.add_argument("--flags", default="")
    parser.add_argument("--build-type", default="Release")
    options = parser.parse_args()
    unittest.main(argv=["test_tutorial.py", "-v"])
