# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Results of a run that goes on, whose snapshots are links to files of their own, and of one that lost some."""
import shutil
import tempfile
import unittest
from pathlib import Path

import h5py

from periporo_tools.results import ResultError, Results
from synthetic import write_results


def into_parts(folder: Path) -> None:
    """Gives results.h5 the form that it has while a run goes on."""
    parts = folder / "results.parts"
    parts.mkdir()
    with h5py.File(folder / "results.h5") as whole, h5py.File(folder / "master.h5", "w") as master:
        for key, value in whole.attrs.items():
            master.attrs[key] = value
        master.attrs["complete"] = 0
        whole.copy("history", master)
        snapshots = master.create_group("snapshots")
        for name in whole["snapshots"]:
            with h5py.File(parts / f"{name}-0.h5", "w") as part:
                whole.copy(f"snapshots/{name}", part, "snapshot")
            snapshots[name] = h5py.ExternalLink(f"results.parts/{name}-0.h5", "/snapshot")
    (folder / "results.h5").rename(folder / "merged.h5")
    (folder / "master.h5").rename(folder / "results.h5")


class ResultsTest(unittest.TestCase):
    def setUp(self) -> None:
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory())) / "run"
        write_results(self.folder)

    def test_links_read_as_the_snapshots_themselves(self) -> None:
        with Results(self.folder) as whole:
            expected = [whole.snapshot(index).position for index in range(len(whole.times))]
        into_parts(self.folder)
        with Results(self.folder) as results:
            self.assertFalse(results.complete)
            for index, position in enumerate(expected):
                self.assertTrue((results.snapshot(index).position == position).all())

    def test_a_run_that_is_merged_while_its_results_are_open(self) -> None:
        into_parts(self.folder)
        with Results(self.folder) as results:
            before = results.snapshot(3).position
            (self.folder / "merged.h5").rename(self.folder / "results.h5")
            shutil.rmtree(self.folder / "results.parts")
            self.assertTrue((results.snapshot(3).position == before).all())
            self.assertEqual(len(results.snapshot(-1).position), len(results.values(-1, "volume")))

    def test_a_copy_without_its_parts_is_an_error_that_says_so(self) -> None:
        into_parts(self.folder)
        shutil.rmtree(self.folder / "results.parts")
        with self.assertRaisesRegex(ResultError, "results.parts"):
            Results(self.folder)

    def test_what_is_missing_is_told(self) -> None:
        with h5py.File(self.folder / "results.h5", "r+") as file:
            file.attrs["missing"] = "snapshot 000002 of step 20\nrows of the history between steps 3 and 5"
        with Results(self.folder) as results:
            self.assertEqual(results.missing[1], "rows of the history between steps 3 and 5")


if __name__ == "__main__":
    unittest.main()
