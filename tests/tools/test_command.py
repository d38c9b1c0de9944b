# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""What the commands in tools/ share."""
import subprocess
import sys
import unittest
from pathlib import Path

TOOLS = Path(__file__).resolve().parents[2] / "tools"
PROGRAM = """
import sys
from periporo_tools.command import run

def main(text):
    for _ in range(100000):
        print(text)
    return 3

sys.exit(run(main, "line"))
"""


class Output(unittest.TestCase):
    def run_cut(self, lines):
        return subprocess.run(
            ["bash", "-c", f'set -o pipefail; "$0" -c "$1" | head -n {lines} >/dev/null; echo "${{PIPESTATUS[0]}}"',
             sys.executable, PROGRAM],
            capture_output=True, text=True, check=False, env={"PYTHONPATH": str(TOOLS), "PATH": "/usr/bin:/bin"},
        )

    def test_a_reader_that_has_seen_enough_is_no_fault(self):
        done = self.run_cut(1)
        self.assertEqual(done.stdout.strip(), "0")
        self.assertEqual(done.stderr, "")

    def test_the_exit_status_is_that_of_the_command(self):
        self.assertEqual(self.run_cut(200000).stdout.strip(), "3")


if __name__ == "__main__":
    unittest.main()
