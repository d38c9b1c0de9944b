# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""tools/reproduce: the file of sweeps, and what it says to one that is wrong."""
import unittest

from made_up_sweeps import CASE, COLUMNS, Folder
from periporo_tools.reproduction.plan import plan
from periporo_tools.reproduction.sweeps import SweepError, read_sweeps


class Sweeps(Folder):
    def test_axes_values_and_defaults_are_read(self):
        book, _ = self.columns()
        columns, friction = book.sweeps
        a, s = columns.axes
        self.assertEqual([value.label for value in a.values], ["0.6", "1.2"])
        self.assertEqual([value.number for value in s.values], [0.0, 20.0])
        self.assertEqual(s.words(s.values[1]), "s = 20 kPa")
        self.assertEqual(s.plot_label, "suction [kPa]")
        self.assertEqual([value.set for value in s.values], [(), ('body.column.water.suction = "{s} kPa"',)])
        self.assertEqual(friction.figures, ("response",))
        self.assertEqual(friction.axes[0].title, "friction")

    def test_a_label_that_is_no_number_stands_nowhere_on_a_line(self):
        axis = read_sweeps(self.write(
            '[[sweep]]\nname = "n"\ntitle = "t"\ncase = "c"\n[[sweep.axis]]\nname = "x"\n'
            'values = ["rough", { label = "smooth", number = 3 }]'
        )).sweeps[0].axes[0]
        self.assertEqual([value.number for value in axis.values], [None, 3.0])
        self.assertFalse(axis.numeric)
        self.assertEqual(axis.words(axis.values[0]), "rough")

    def test_the_small_variant_leaves_out_and_replaces(self):
        book, runs = self.columns(small=True)
        self.assertEqual([value.label for value in book.sweeps[1].axes[0].values], ["0.2", "0.8"])
        self.assertEqual(runs["friction"][1].overrides,
                         ('discretization.spacing = "20 mm"', "contact.0.friction = 0.8"))

    def test_a_sweep_can_have_a_small_variant_of_its_own(self):
        text = COLUMNS.replace('title = "Columns"', 'title = "Columns"\nsmall = ["stage.0.duration = \\"1 ms\\""]')
        _, runs = self.columns(text, small=True)
        self.assertEqual(runs["columns"][0].overrides, ('stage.0.duration = "1 ms"',))
        self.assertEqual(runs["friction"][0].overrides[0], 'discretization.spacing = "20 mm"')
        _, runs = self.columns(text)
        self.assertEqual(runs["columns"][0].overrides, ())


HEAD = '[[sweep]]\nname = "one"\ntitle = "t"\ncase = "case.toml"\n'
AXIS = '[[sweep.axis]]\nname = "x"\nvalues = [1, 2]\n'


class Mistakes(Folder):
    """Each is an error that names the file, the place in it and a way out."""

    def refused(self, text, *words, planned=False):
        self.write(CASE, "case.toml")
        with self.assertRaises(SweepError) as caught:
            book = read_sweeps(self.write(text))
            if planned:
                plan(book, self.out)
        for word in ("sweeps.toml", *words):
            self.assertIn(word, str(caught.exception))

    def test_what_is_no_toml_is_refused_with_its_line(self):
        self.refused('[[sweep]]\nname = one\n', "line 2")

    def test_a_file_that_is_not_there_names_the_option_for_another(self):
        with self.assertRaisesRegex(SweepError, "nowhere.toml.*--sweeps"):
            read_sweeps(self.here / "nowhere.toml")

    def test_a_file_without_sweeps_says_how_one_is_written(self):
        self.refused("", "[[sweep]]")

    def test_unknown_keys_are_refused_with_the_nearest_one(self):
        self.refused("[[sweeps]]\n", '"sweeps"', '"sweep"')
        self.refused("[small]\nsets = []\n" + HEAD + AXIS, "[small]", '"sets"', '"set"')
        self.refused(HEAD + 'figure = []\n' + AXIS, 'sweep "one"', '"figures"')
        self.refused(HEAD + AXIS + 'log = true\n', 'axis "x"', "scale")
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = [{ label = "1", sets = [] }]', "value 1", '"set"')
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = [{ label = "1", small = { labels = "2" } }]',
                     "value 1", "small", '"label"')

    def test_what_is_missing_is_named(self):
        self.refused('[[sweep]]\ntitle = "t"\n' + AXIS, "sweep 1", '"name"')
        self.refused('[[sweep]]\nname = "one"\n' + AXIS, 'sweep "one"', '"title"')
        self.refused(HEAD, 'sweep "one"', "[[sweep.axis]]")
        self.refused(HEAD + '[[sweep.axis]]\nvalues = [1]', 'sweep "one", axis 1', '"name"')
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"', 'axis "x"', "values = [0.1, 0.2]")
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = [{ set = [] }]', "value 1", '"label"')

    def test_names_must_be_fit_for_files_and_their_own(self):
        self.refused(HEAD.replace('"one"', '"one/two"') + AXIS, "name", "letters")
        self.refused((HEAD + AXIS) * 2, '"one"', "two sweeps")
        self.refused(HEAD + AXIS * 2, 'sweep "one"', "two axes")
        self.refused(HEAD.replace('"one"', '"statements"') + AXIS, "statements", "choose another")
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = [1, "1"]', 'axis "x"', "twice")
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = ["a b", "a-b"]', 'sweep "one"', "x-a-b", planned=True)

    def test_overrides_are_key_and_value(self):
        for wrong in ('set = ["friction"]', 'set = [3]', 'set = ["= 3"]', 'set = "a = 3"'):
            self.refused(HEAD + wrong + "\n" + AXIS, 'sweep "one"', "set")

    def test_wrong_kinds_are_named(self):
        self.refused(HEAD.replace('"t"', "3") + AXIS, "title", "3")
        self.refused(HEAD + "statements = 1\n" + AXIS, "statements", "true or false")
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = [[1]]', "value 1", "a list")
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nvalues = [{ label = "l", number = "2" }]', "number")

    def test_scales_and_figures_are_those_there_are(self):
        self.refused(HEAD + AXIS + 'scale = "logarithmic"', 'axis "x"', '"log"')
        self.refused(HEAD + '[[sweep.axis]]\nname = "x"\nscale = "log"\nvalues = [0, 1]', "above zero")
        self.refused(HEAD + 'figures = ["respond"]\n' + AXIS, '"respond"', '"response"')

    def test_statements_need_their_axes_and_one_sweep(self):
        self.refused(HEAD + "statements = true\n" + AXIS, "statements", '"a"')
        both = HEAD + "statements = true\n" + AXIS.replace('"x"', '"a"') + AXIS.replace('"x"', '"s"')
        self.refused(both + both.replace('"one"', '"two"'), "one and two")

    def test_braces_hold_axes(self):
        self.refused(HEAD.replace("case.toml", "case_{y}.toml") + AXIS, "{y}", "There is x", planned=True)
        self.refused(HEAD + 'set = ["a.b = {xx}"]\n' + AXIS, "{xx}", '"x"', planned=True)

    def test_cases_must_be_there(self):
        self.refused(HEAD.replace("case.toml", "cased.toml") + AXIS, "cased.toml", "relative to", planned=True)
        self.refused(HEAD.replace('case = "case.toml"\n', "") + AXIS, 'case = "FILE.toml"', planned=True)

    def test_the_command_says_so_and_returns_two(self):
        self.write("[[sweeps]]")
        status, _, error = self.called()
        self.assertEqual(status, 2)
        self.assertTrue(error.startswith("reproduce: "))

    def test_an_unknown_sweep_is_named_with_those_there_are(self):
        self.columns()
        status, _, error = self.called("colums")
        self.assertEqual(status, 2)
        self.assertIn('did you mean "columns"?', error)


if __name__ == "__main__":
    unittest.main()
