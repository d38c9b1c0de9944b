# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""The schema for editors: a schema, that accepts every shipped case and sees what an editor should underline."""
from __future__ import annotations

import copy
import json
import os
import subprocess
import tomllib
import unittest
from pathlib import Path

import jsonschema

_CASES = Path(__file__).resolve().parents[2] / "cases"
_QUICKSTART = _CASES / "column_collapse" / "quickstart.toml"


def printed_schema() -> dict:
    done = subprocess.run([os.environ["PERIPORO"], "schema"], capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


class Schema(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.validator = jsonschema.Draft4Validator(printed_schema())

    def refused(self, change) -> bool:
        """Whether the quickstart is refused after change(case)."""
        case = tomllib.loads(_QUICKSTART.read_text())
        self.assertTrue(self.validator.is_valid(case))
        changed = copy.deepcopy(case)
        change(changed)
        return not self.validator.is_valid(changed)

    def test_is_a_schema_of_draft_4(self):
        jsonschema.Draft4Validator.check_schema(self.validator.schema)

    def test_accepts_every_shipped_case(self):
        cases = [f for f in _CASES.rglob("*.toml") if f.parent.name != "material" and f.name != "sweeps.toml"]
        self.assertGreater(len(cases), 15)
        for file in cases:
            with self.subTest(case=file.name):
                self.assertEqual([e.message for e in self.validator.iter_errors(tomllib.loads(file.read_text()))], [])

    def test_refuses_a_misspelt_key_of_the_framework(self):
        self.assertTrue(self.refused(lambda case: case["discretization"].update(spacng="10 mm")))

    def test_refuses_a_key_of_another_plugin(self):
        self.assertTrue(self.refused(lambda case: case["material"]["soil"].update(yield_stress="1 kPa")))

    def test_refuses_a_plugin_that_is_not_there(self):
        self.assertTrue(self.refused(lambda case: case["material"]["soil"].update(model="clay")))

    def test_refuses_a_choice_that_is_none(self):
        self.assertTrue(self.refused(lambda case: case["operator"].update(influence="parabolic")))

    def test_refuses_a_number_out_of_range_and_a_text_without_a_number(self):
        self.assertTrue(self.refused(lambda case: case["material"]["soil"].update(porosity=1.2)))
        self.assertTrue(self.refused(lambda case: case["discretization"].update(spacing="wide")))

    def test_says_meaning_unit_and_default(self):
        horizon = self.validator.schema["properties"]["discretization"]["properties"]["horizon"]
        self.assertEqual(horizon["default"], 3.015)
        self.assertIn("Horizon delta in spacings", horizon["description"])
        spacing = self.validator.schema["properties"]["discretization"]["properties"]["spacing"]
        self.assertIn("(m, > 0)", spacing["description"])


if __name__ == "__main__":
    unittest.main()
