# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Every header of the SDK compiles by itself, and those that need no linear algebra include none."""
import os
import shlex
import subprocess
import tempfile
import unittest
from pathlib import Path

COMPILER = [*shlex.split(os.environ["PERIPORO_COMPILER"]), "-std=c++20", "-march=native", "-fsyntax-only", "-Wall", "-Wextra", "-Werror"]
INCLUDE = Path(__file__).resolve().parents[3] / "framework/include"
FOLDERS = ["-I", str(INCLUDE), *(word for folder in os.environ["PERIPORO_EIGEN"].split(";") for word in ("-isystem", folder))]
HEADERS = sorted(str(header.relative_to(INCLUDE)) for header in INCLUDE.rglob("*.hpp"))
LIGHT = ["plugin", "parameters", "material", "retention", "output", "units", "file"]


def compiled(text: str, *options: str) -> subprocess.CompletedProcess:
    with tempfile.NamedTemporaryFile("w", suffix=".cpp") as source:
        source.write(text)
        source.flush()
        return subprocess.run(
            [*COMPILER, *FOLDERS, *options, source.name], capture_output=True, text=True, check=False
        )


class StandingAlone(unittest.TestCase):
    def test_each_header_includes_what_it_uses(self):
        self.assertGreater(len(HEADERS), 20)
        for header in HEADERS:
            with self.subTest(header):
                done = compiled(f'#include "{header}"\n')
                self.assertEqual(done.returncode, 0, done.stderr)

    def test_headers_without_linear_algebra_include_neither_eigen_nor_packs(self):
        for name in LIGHT:
            with self.subTest(name):
                done = compiled(f'#include "periporo/{name}.hpp"\n', "-M")
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertNotIn("Eigen/", done.stdout)
                self.assertNotIn("experimental/simd", done.stdout)

    def test_interfaces_with_vectors_include_no_packs(self):
        for name in ("geometry", "contact", "vector"):
            with self.subTest(name):
                self.assertNotIn("experimental/simd", compiled(f'#include "periporo/{name}.hpp"\n', "-M").stdout)


if __name__ == "__main__":
    unittest.main()
