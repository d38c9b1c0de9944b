# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""tools/drive and the picture it draws of a material path."""
import subprocess
import tempfile
import unittest
from pathlib import Path

import matplotlib.image
import numpy as np

from periporo_tools import drive
from test_commands import Tree, script

_COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "xz")


def write_path(
    folder: Path, *, slope: bool = True, surface: bool = True, shear: float = 0.1, volume: float = 0.01
) -> Path:
    """A made-up drained triaxial path of eleven rows: q = 3 (p - 100 kPa), strains in proportion."""
    way = np.linspace(0.0, 1.0, 11)
    columns = {"step": np.arange(11), "stage": np.minimum(np.arange(11), 1), "time [s]": 10.0 * way}
    held = -1e5 + 0.0 * way
    stress = dict.fromkeys(_COMPONENTS, 0.0 * way) | {"xx": held, "yy": held, "zz": held - 6e4 * way}
    lateral = (0.5 * shear - volume / 3.0) * way
    strain = dict.fromkeys(_COMPONENTS, 0.0 * way) | {"xx": lateral, "yy": lateral, "zz": -(shear + volume / 3.0) * way}
    columns |= {f"stress_{name} [Pa]": values for name, values in stress.items()}
    columns |= {f"strain_{name} [-]": values for name, values in strain.items()}
    columns |= {"p [Pa]": 1e5 + 2e4 * way, "q [Pa]": 6e4 * way, "volumetric_compression [-]": volume * way}
    columns |= {"equivalent_shear_strain [-]": shear * way, "suction [Pa]": 0.0 * way, "saturation [-]": 0.0 * way}
    folder.mkdir(parents=True, exist_ok=True)
    rows = np.array(list(columns.values())).T
    lines = [",".join(columns)] + [",".join(map(repr, map(float, row))) for row in rows]
    (folder / "path.csv").write_text("\n".join(lines) + "\n")
    (folder / "path.toml").write_text(
        'title = "made up"\n[material.clay]\nmodel = "clay"\n' + ("critical_state_slope = 1.1\n" if slope else "")
    )
    if surface:
        (folder / "yield_surface.csv").write_text(
            "moment,p [Pa],q [Pa]\ninitial,125000,0\ninitial,62500,68750\ninitial,0,0\nfinal,150000,0\nfinal,0,0\n"
        )
    return folder


class Picture(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name) / "path"

    def panels(self, **options):
        return [panel.__name__ for panel in drive._panels(drive.read(write_path(self.folder, **options)))]

    def test_the_files_are_read_with_columns_by_name_and_surfaces_by_moment(self):
        path = drive.read(write_path(self.folder))
        self.assertEqual(path.columns["p"][-1], 1.2e5)
        self.assertEqual(path.critical_state_slope, 1.1)
        np.testing.assert_array_equal(path.surfaces["initial"][1], [0.0, 68750.0, 0.0])
        self.assertFalse(path.failed)

    def test_a_picture_is_drawn_and_nothing_unfinished_is_left(self):
        drive.main(str(write_path(self.folder)))
        image = matplotlib.image.imread(self.folder / "path.png")
        self.assertGreater(len(np.unique(np.round(image[..., :3].reshape(-1, 3), 1), axis=0)), 5)
        self.assertEqual(list(self.folder.glob("*.part")), [])

    def test_a_law_without_surface_and_critical_state_is_drawn_too(self):
        drive.main(str(write_path(self.folder, slope=False, surface=False)))
        self.assertTrue((self.folder / "path.png").exists())

    def test_a_start_alone_is_drawn_too(self):
        lines = (write_path(self.folder) / "path.csv").read_text().splitlines()
        (self.folder / "path.csv").write_text("\n".join(lines[:2]) + "\n")
        (self.folder / "failing_step.toml").write_text("")
        drive.main(str(self.folder))
        self.assertTrue(drive.read(self.folder).failed)

    def test_shear_is_drawn_with_the_sign_of_triaxial_extension(self):
        path = drive.read(write_path(self.folder, shear=-0.1))
        np.testing.assert_allclose(drive._shear_of(path).strain[-1], -0.1)

    def test_panels_that_would_say_nothing_give_way(self):
        self.assertEqual(self.panels()[1::2], ["_shear_response", "_void_ratio"])
        self.assertEqual(self.panels(shear=0.0)[1::2], ["_pressure_against_compression", "_void_ratio"])
        self.assertEqual(self.panels(volume=0.0)[1::2], ["_shear_response", "_pressure_against_shear"])

    def test_the_window_holds_path_and_closed_surface_and_cuts_one_that_is_far_larger(self):
        path = drive.read(write_path(self.folder))
        self.assertAlmostEqual(drive._window(path)[1], 1.08 * 150e3)
        path.surfaces["final"] = (np.array([1e8, 0.0]), np.array([1e8, 0.0]))
        self.assertAlmostEqual(drive._window(path)[1], 1.08 * 2.0 * 120e3)


class Command(Tree):
    def setUp(self):
        super().setUp()
        self.take("drive")
        (self.tree / "tools/periporo_tools").symlink_to(Path(drive.__file__).parent)
        self.program = self.tree / "build/release/bin/periporo"
        self.stand_in(self.tree / "tools/build")
        self.out = write_path(self.elsewhere / "results/my path")

    def called(self, status, *arguments):
        script(self.program, f'echo "periporo $*" >>"{self.calls}"\nexit {status}')
        return subprocess.run(
            [self.tree / "tools/drive", *arguments], cwd=self.elsewhere, capture_output=True, text=True, check=False
        )

    def test_it_builds_drives_and_draws(self):
        done = self.called(0, "my path.toml", "--set", "a=b")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(self.noted(), ["build release program", "periporo drive my path.toml --set a=b"])
        self.assertTrue((self.out / "path.png").exists())

    def test_a_step_that_failed_is_drawn_and_still_a_failure(self):
        (self.out / "failing_step.toml").write_text("")
        self.assertEqual(self.called(1, "my path.toml").returncode, 1)
        self.assertTrue((self.out / "path.png").exists())

    def test_wrong_input_is_passed_on_and_nothing_is_drawn(self):
        self.assertEqual(self.called(2, "my path.toml").returncode, 2)
        self.assertFalse((self.out / "path.png").exists())


if __name__ == "__main__":
    unittest.main()
