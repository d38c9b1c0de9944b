# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Reads a file of sweeps (TOML), in its full or its small variant.

@code{.toml}
[small]                                         # what --small sets in every run
set = ['discretization.spacing = "10 mm"']

[[sweep]]
name = "friction"
title = "How rough the floor is"
case = "column_a{a}.toml"                       # relative to this file; {NAME} is the label on the axis NAME
figures = ["response"]

[[sweep.axis]]
name = "friction"
title = "friction of the floor"
set = ["contact.0.friction = {friction}"]       # of every value without its own `set`
values = [0.1, { label = "0.2", set = [] }, 0.5]

[[sweep.axis]]
name = "a"
values = ["0.6", { label = "2.0", small = false }]
@endcode
"""
from __future__ import annotations

import difflib
import math
import re
import tomllib
from dataclasses import dataclass
from pathlib import Path

FIGURES = ("initial_stress", "snapshots", "deposits", "response", "scaling")
DEFAULT_FIGURES = ("response",)
STATEMENTS = "statements"  # the name of the table of the paper's statements
_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]*")
_BRACES = re.compile(r"\{(\w+)\}")
_SET_EXAMPLE = """set = ['contact.0.friction = 0.3']"""


class SweepError(Exception):
    """A mistake in a file of sweeps or in what is asked of it: file, sweep, key, and a way out."""


@dataclass(frozen=True)
class Value:
    """One place on an axis."""

    label: str
    number: float | None  # where it stands in a plot; None for values that are no numbers
    set: tuple[str, ...]  # KEY=VALUE for `periporo run --set`, before braces are filled in
    case: str | None  # takes the place of the sweep's case


@dataclass(frozen=True)
class Axis:
    name: str
    title: str  # what a plot calls it
    unit: str  # "-" without one
    logarithmic: bool
    values: tuple[Value, ...]

    @property
    def numeric(self) -> bool:
        return all(value.number is not None for value in self.values)

    @property
    def heading(self) -> str:
        """\"s [kPa]\"."""
        return self.name if self.unit == "-" else f"{self.name} [{self.unit}]"

    @property
    def plot_label(self) -> str:
        return self.title if self.unit == "-" else f"{self.title} [{self.unit}]"

    def words(self, value: Value) -> str:
        """\"s = 20 kPa\", or the label alone where it says enough."""
        if value.number is None:
            return value.label
        return f"{self.name} = {value.label}" + ("" if self.unit == "-" else f" {self.unit}")


@dataclass(frozen=True)
class Sweep:
    """Every combination of the values of its axes is a run."""

    name: str
    title: str
    case: str | None
    set: tuple[str, ...]  # of every run, before those of the values
    small_set: tuple[str, ...]  # the same of the small variant, after `set`
    axes: tuple[Axis, ...]
    figures: tuple[str, ...]
    statements: bool  # whether the paper's statements are held against it

    def axis(self, name: str) -> Axis | None:
        return next((axis for axis in self.axes if axis.name == name), None)


@dataclass(frozen=True)
class Book:
    """All sweeps of a file."""

    path: Path
    small: bool
    sweeps: tuple[Sweep, ...]

    def sweep(self, name: str) -> Sweep:
        """@throws SweepError naming the sweeps there are."""
        for sweep in self.sweeps:
            if sweep.name == name:
                return sweep
        raise SweepError(f"no sweep is called \"{name}\"{_near(name, [sweep.name for sweep in self.sweeps])}")


def _near(name: str, known: list[str] | tuple[str, ...]) -> str:
    """\"; did you mean x? There are x, y and z\"."""
    close = difflib.get_close_matches(name, known, 1)
    meant = f"; did you mean \"{close[0]}\"?" if close else ";"
    return f"{meant} There {'is' if len(known) == 1 else 'are'} {', '.join(known)}"


class _Table:
    """A table of the file and where it stands, for messages."""

    def __init__(self, content: object, place: str, known: tuple[str, ...]):
        self.place = place
        if not isinstance(content, dict):
            keys = ", ".join(known)
            raise SweepError(f"{place}: expected a table, found {_kind(content)}; it may have the keys {keys}")
        self.content = content
        for key in content:
            if key not in known:
                raise SweepError(f"{place}: there is no key \"{key}\"{_near(key, known)}")

    def fail(self, key: str, what: str) -> SweepError:
        return SweepError(f"{self.place}: {key}: {what}")

    def text(self, key: str, default: str | None = None) -> str:
        value = self.content.get(key, default)
        if value is None:
            raise SweepError(f"{self.place}: the key \"{key}\" is missing; write {key} = \"...\"")
        if not isinstance(value, str) or not value:
            raise self.fail(key, f"expected a text, found {_kind(value)}; write {key} = \"...\"")
        return value

    def name(self, key: str = "name") -> str:
        name = self.text(key)
        if not _NAME.fullmatch(name):
            raise self.fail(key, f"\"{name}\" is no name; use letters, digits and _, and begin with a letter")
        return name

    def optional_text(self, key: str) -> str | None:
        return self.text(key) if key in self.content else None

    def flag(self, key: str) -> bool:
        value = self.content.get(key, False)
        if not isinstance(value, bool):
            raise self.fail(key, f"expected true or false, found {_kind(value)}")
        return value

    def list(self, key: str) -> list:
        value = self.content.get(key, [])
        if not isinstance(value, list):
            raise self.fail(key, f"expected a list, found {_kind(value)}; write {key} = [...]")
        return value

    def overrides(self, key: str = "set") -> tuple[str, ...]:
        for entry in self.list(key):
            if not isinstance(entry, str) or not re.match(r"\s*[^\s=]+\s*=\s*\S", entry):
                raise self.fail(key, f"{entry!r} is not \"KEY = VALUE\"; write {_SET_EXAMPLE}")
        return tuple(entry.strip() for entry in self.list(key))


def _kind(value: object) -> str:
    kinds = {dict: "a table", list: "a list", str: f"\"{value}\"", bool: str(value).lower()}
    return kinds.get(type(value), str(value))


def _called(content: object, place: str) -> str:
    """\"sweeps.toml, sweep 2\" with the name instead of the number where there is one."""
    name = content.get("name") if isinstance(content, dict) else None
    return f"{place.rsplit(' ', 1)[0]} \"{name}\"" if isinstance(name, str) and name else place


def _as_number(label: str) -> float | None:
    try:
        number = float(label)
    except ValueError:
        return None
    return number if math.isfinite(number) else None


_VALUE_KEYS = ("label", "number", "set", "case")


def _value(content: object, place: str, axis_set: tuple[str, ...], small: bool) -> Value | None:
    """None for a value that the small variant leaves out."""
    if isinstance(content, (str, int, float)) and not isinstance(content, bool):
        content = {"label": str(content)}
    table = _Table(content, place, (*_VALUE_KEYS, "small"))
    instead = table.content.get("small", {})
    if instead is not False:
        _Table(instead, f"{place}: small", _VALUE_KEYS)
    if small and instead is False:
        return None
    if small:
        table = _Table({**table.content, **instead}, place, (*_VALUE_KEYS, "small"))
        if "label" in instead and "number" not in instead:
            table.content.pop("number", None)
    label = table.text("label")
    number = table.content.get("number", _as_number(label))
    if number is not None and (isinstance(number, bool) or not isinstance(number, (int, float))):
        raise table.fail("number", f"expected a number, found {_kind(number)}; leave it out where the label is one")
    own_set = table.overrides() if "set" in table.content else axis_set
    return Value(label, None if number is None else float(number), own_set, table.optional_text("case"))


def _axis(content: object, place: str, small: bool) -> Axis:
    place = _called(content, place)
    table = _Table(content, place, ("name", "title", "unit", "scale", "set", "values"))
    name = table.name()
    common = table.overrides()
    values = [
        value
        for count, entry in enumerate(table.list("values"), 1)
        if (value := _value(entry, f"{place}, value {count}", common, small))
    ]
    if not values:
        raise table.fail("values", "there is none" + (" in the small variant" if small else "")
                         + "; write values = [0.1, 0.2] or values = [{ label = \"0.1\", set = [...] }]")
    labels = [value.label for value in values]
    if twice := next((label for label in labels if labels.count(label) > 1), None):
        raise table.fail("values", f"\"{twice}\" is there twice; every value needs a label of its own")
    scale = table.text("scale", "linear")
    if scale not in ("linear", "log"):
        raise table.fail("scale", f"\"{scale}\" is no scale; it may be \"linear\" or \"log\"")
    if scale == "log" and any(value.number is None or value.number <= 0.0 for value in values):
        raise table.fail("scale", "\"log\" needs numbers above zero; give each value a number, or leave scale out")
    return Axis(name, table.text("title", name), table.text("unit", "-"), scale == "log", tuple(values))


def _sweep(content: object, place: str, small: bool, small_set: tuple[str, ...]) -> Sweep:
    place = _called(content, place)
    table = _Table(content, place, ("name", "title", "case", "set", "small", "axis", "figures", "statements"))
    name = table.name()
    if name == STATEMENTS:
        raise table.fail("name", f"\"{name}\" is the name of the table of statements; choose another")
    axes = tuple(_axis(entry, f"{place}, axis {count}", small) for count, entry in enumerate(table.list("axis"), 1))
    if not axes:
        raise SweepError(f"{place}: it has no axis; write [[sweep.axis]] with name and values below it")
    names = [axis.name for axis in axes]
    if len(set(names)) < len(names):
        raise SweepError(f"{place}: two axes have the same name; they are {', '.join(names)}")
    figures = tuple(table.list("figures")) if "figures" in table.content else DEFAULT_FIGURES
    for figure in figures:
        if figure not in FIGURES:
            raise table.fail("figures", f"there is no figure \"{figure}\"{_near(str(figure), FIGURES)}")
    if "small" in table.content:
        small_set = table.overrides("small")
    sweep = Sweep(name, table.text("title"), table.optional_text("case"), table.overrides(), small_set if small else (),
                  axes, figures, table.flag("statements"))
    if sweep.statements:
        for wanted in ("a", "s"):
            axis = sweep.axis(wanted)
            if axis is None or not axis.numeric:
                raise table.fail("statements", f"they need an axis \"{wanted}\" whose values are numbers; name it so,"
                                 " or leave statements out")
    return sweep


def fill(text: str, labels: dict[str, str], place: str) -> str:
    """Puts labels of axes into braces. @throws SweepError for braces around anything else."""

    def label(found: re.Match) -> str:
        if found[1] not in labels:
            raise SweepError(f"{place}: {found[0]} in \"{text}\" is no axis{_near(found[1], list(labels))}")
        return labels[found[1]]

    return _BRACES.sub(label, text)


def read_sweeps(path: Path, small: bool = False) -> Book:
    """@throws SweepError for every mistake, naming file, sweep and key."""
    try:
        content = tomllib.loads(path.read_text())
    except OSError as error:
        raise SweepError(f"{path}: cannot be read ({error.strerror}); --sweeps FILE reads another") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise SweepError(f"{path}: not a TOML file: {error}") from error
    table = _Table(content, str(path), ("small", "sweep"))
    small_set = _Table(content.get("small", {}), f"{path}, [small]", ("set",)).overrides()
    sweeps = tuple(
        _sweep(entry, f"{path}, sweep {count}", small, small_set) for count, entry in enumerate(table.list("sweep"), 1)
    )
    if not sweeps:
        raise SweepError(f"{path}: it has no sweep; write [[sweep]] with name, title, case and [[sweep.axis]] below it")
    names = [sweep.name for sweep in sweeps]
    if twice := next((name for name in names if names.count(name) > 1), None):
        raise SweepError(f"{path}: two sweeps are called \"{twice}\"; every sweep needs a name of its own")
    with_statements = [sweep.name for sweep in sweeps if sweep.statements]
    if len(with_statements) > 1:
        raise SweepError(f"{path}: only one sweep can have statements = true, not {' and '.join(with_statements)}")
    return Book(path, small, sweeps)
