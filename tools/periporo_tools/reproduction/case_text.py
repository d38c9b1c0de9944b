# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""What a case says: its file with includes and overrides, as the program puts them together.

Serves two ends only: to tell whether a case has changed since it ran, and to guess what it costs. The program alone
judges whether the case is sound.
"""
from __future__ import annotations

import hashlib
import json
import os
import tomllib
from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class CaseText:
    """Tables of a case, and the content of the files that it names, as digests."""

    tables: dict
    files: dict[str, str] = field(default_factory=dict)
    unclear: list[str] = field(default_factory=list)  # what could not be read or applied, as text

    def identity(self) -> str:
        """A digest of all but the title: equal for cases that compute the same."""
        tables = {key: value for key, value in self.tables.items() if key != "title"}
        text = json.dumps([tables, self.files, self.unclear], sort_keys=True, default=str)
        return hashlib.sha256(text.encode()).hexdigest()


def read_case(path: Path, overrides: tuple[str, ...] = ()) -> CaseText:
    """The case in `path`. What cannot be read is the program's to complain about: it stays in as text."""
    case = CaseText({})
    case.tables = _with_includes(path, case, ())
    for override in overrides:
        _apply(case, override, path.parent)
    return case


def _with_includes(path: Path, case: CaseText, chain: tuple[Path, ...]) -> dict:
    """Later files lie over earlier ones, table by table; lists are replaced as a whole."""
    try:
        text = path.read_bytes()
        own = tomllib.loads(text.decode())
    except (OSError, ValueError):
        case.unclear.append(f"{path.name}: {hashlib.sha256(text).hexdigest() if path.is_file() else 'not there'}")
        return {}
    included = own.pop("include", [])
    tables: dict = {}
    for name in included if isinstance(included, list) else []:
        member = path.parent / str(name)
        if member.resolve() not in chain:
            _merge(tables, _with_includes(member, case, (*chain, path.resolve())))
    _note_files(own, path.parent, case)
    _merge(tables, own)
    return tables


def _merge(base: dict, over: dict) -> None:
    for key, value in over.items():
        if isinstance(value, dict) and isinstance(base.get(key), dict):
            _merge(base[key], value)
        else:
            base[key] = value


def _note_files(value: object, folder: Path, case: CaseText) -> None:
    """Takes in the content of every file that a text of the case names: maps, meshes, tables."""
    if isinstance(value, dict):
        for member in value.values():
            _note_files(member, folder, case)
    elif isinstance(value, list):
        for member in value:
            _note_files(member, folder, case)
    elif isinstance(value, str) and os.path.isfile(folder / value):
        case.files[value] = hashlib.sha256((folder / value).read_bytes()).hexdigest()


def _apply(case: CaseText, override: str, folder: Path) -> None:
    """Sets one KEY=VALUE: through tables by key, through lists by number or by the name of an entry."""
    key, _, text = override.partition("=")
    value = _toml_value(text.strip())
    _note_files(value, folder, case)
    keys = [part.strip() for part in key.split(".")]
    node: object = case.tables
    for part in keys[:-1]:
        node = node.setdefault(part, {}) if isinstance(node, dict) else _entry(node, part)
    if isinstance(node, dict):
        node[keys[-1]] = value
    elif isinstance(node, list) and keys[-1].isdigit() and int(keys[-1]) < len(node):
        node[int(keys[-1])] = value
    else:
        case.unclear.append(f"{key.strip()} = {value!r}")


def _entry(node: object, part: str) -> object:
    if not isinstance(node, list):
        return None
    if part.isdigit():
        return node[int(part)] if int(part) < len(node) else None
    return next((entry for entry in node if isinstance(entry, dict) and entry.get("name") == part), None)


def _toml_value(text: str) -> object:
    """A TOML value, or the text as it stands."""
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text
