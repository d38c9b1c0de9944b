# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Files of sweeps and their cases in a temporary folder, and tools/reproduce as a user calls it."""
from __future__ import annotations

import contextlib
import io
import tempfile
import unittest
import unittest.mock
from pathlib import Path

from periporo_tools.reproduction import figures
from periporo_tools.reproduction.main import main
from periporo_tools.reproduction.plan import plan
from periporo_tools.reproduction.sweeps import read_sweeps

CASE = """
title = "A column"
[discretization]
spacing = "10 mm"
[body.column]
geometry = { generator = "box", size = ["100 mm", "100 mm", "120 mm"] }
[[contact]]
friction = 0.2
[[stage]]
name = "collapse"
type = "dynamic"
duration = "0.65 s"
"""

COLUMNS = """
[small]
set = ['discretization.spacing = "20 mm"']

[[sweep]]
name = "columns"
title = "Columns"
case = "column_{a}.toml"
[[sweep.axis]]
name = "a"
values = ["0.6", "1.2"]
[[sweep.axis]]
name = "s"
title = "suction"
unit = "kPa"
set = ['body.column.water.suction = "{s} kPa"']
values = [{ label = "0", set = [] }, 20]

[[sweep]]
name = "friction"
title = "Friction of the floor"
case = "column_0.6.toml"
[[sweep.axis]]
name = "friction"
set = ["contact.0.friction = {friction}"]
values = [0.2, { label = "0.5", small = false }, { label = "0.7", small = { label = "0.8" } }]
"""


def coarse_pictures():
    """Pictures of few pixels are drawn sooner."""
    return unittest.mock.patch.object(figures, "_PIXELS", 250)


class Folder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.here = Path(temporary.name)
        self.out = self.here / "out"

    def write(self, text, name="sweeps.toml"):
        (self.here / name).write_text(text)
        return self.here / name

    def columns(self, text=COLUMNS, small=False):
        """The book and the plan of two sweeps."""
        for a in ("0.6", "1.2"):
            self.write(CASE.replace("120 mm", f"{a[0]}{a[2]}0 mm"), f"column_{a}.toml")
        book = read_sweeps(self.write(text), small)
        return book, plan(book, self.out)

    def called(self, *arguments):
        """Exit status, standard output, standard error of the command."""
        out, error = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(error):
            try:
                status = main([str(word) for word in ("--sweeps", self.here / "sweeps.toml", "--out", self.out,
                                                      *arguments)])
            except SystemExit as stop:
                status = stop.code
        return status, out.getvalue(), error.getvalue()
