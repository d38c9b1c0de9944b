# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Case files as Python dictionaries, and back to text."""
from __future__ import annotations

import json
import math
import tomllib
from collections.abc import Iterator
from pathlib import Path

Keys = tuple[str | int, ...]


def load_case(file: Path) -> dict:
    """Returns a case with its included files merged in, and paths of other files made absolute."""
    case = tomllib.loads(file.read_text())
    merged: dict = {}
    for name in case.pop("include", []):
        _merge(merged, load_case(file.parent / name))
    _merge(merged, _with_absolute_paths(case, file.parent))
    return merged


def _merge(into: dict, other: dict) -> None:
    """Adds `other`: tables are merged, and other values replaced."""
    for key, value in other.items():
        if isinstance(value, dict) and isinstance(into.get(key), dict):
            _merge(into[key], value)
        else:
            into[key] = value


def _with_absolute_paths(value, folder: Path):
    if isinstance(value, dict):
        return {key: _with_absolute_paths(item, folder) for key, item in value.items()}
    if isinstance(value, list):
        return [_with_absolute_paths(item, folder) for item in value]
    if isinstance(value, str) and "." in value and "\n" not in value and (folder / value).is_file():
        return str(folder / value)
    return value


def to_text(case: dict) -> str:
    """Writes a case as TOML, a line for each key."""
    return "\n".join(_lines(case, "")) + "\n"


def _lines(table: dict, name: str) -> Iterator[str]:
    own = {key: value for key, value in table.items() if not _is_section(value)}
    for key, value in own.items():
        yield f"{_key(key)} = {value_text(value)}"
    for key, value in table.items():
        if key in own:
            continue
        path = f"{name}.{_key(key)}" if name else _key(key)
        for item in value if isinstance(value, list) else [value]:
            yield f"[[{path}]]" if isinstance(value, list) else f"[{path}]"
            yield from _lines(item, path)


def _is_section(value) -> bool:
    return isinstance(value, dict) or (isinstance(value, list) and bool(value) and all(isinstance(v, dict) for v in value))


def _key(key: str) -> str:
    return key if key.replace("_", "").replace("-", "").isalnum() and key.isascii() else json.dumps(key)


def value_text(value) -> str:
    """Returns a value in one line of TOML."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return {math.inf: "inf", -math.inf: "-inf"}.get(value, "nan" if math.isnan(value) else repr(value))
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, list):
        return "[" + ", ".join(value_text(item) for item in value) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_key(key)} = {value_text(item)}" for key, item in value.items()) + "}"
    return str(value)


def leaves(value, at: Keys = ()) -> Iterator[Keys]:
    """Yields where every value stands that is no table and no list."""
    if isinstance(value, dict):
        for key, item in value.items():
            yield from leaves(item, (*at, key))
    elif isinstance(value, list):
        for number, item in enumerate(value):
            yield from leaves(item, (*at, number))
    else:
        yield at


def keys_of(value, at: Keys = ()) -> Iterator[Keys]:
    """Yields where every key of every table stands."""
    for name, item in value.items() if isinstance(value, dict) else enumerate(value):
        if isinstance(value, dict):
            yield (*at, name)
        if isinstance(item, (dict, list)):
            yield from keys_of(item, (*at, name))


def parent_of(case: dict, at: Keys):
    """Returns the table or list that holds the value."""
    for key in at[:-1]:
        case = case[key]
    return case
