# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Cases with one mistake each: in a key, in a value, in the text."""
from __future__ import annotations

import copy
import os
import random
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from pathlib import Path

from toml_text import Keys, keys_of, leaves, parent_of, to_text, value_text


@dataclass
class Broken:
    """An input with one mistake."""

    kind: str
    what: str  # in words
    content: Callable[[], tuple[bytes, bool]]  # the case, and whether no user can mean it
    files: Callable[[Path], None] | None = None  # makes other files in the folder of the case
    arguments: list[str] = field(default_factory=lambda: ["check", "case.toml"])
    # What a refusal names: a file with line and column, or a case that cannot be read or lacks a key at the top.
    named: str = r"\.toml:\d+:\d+: error|case\.toml: error: (cannot read|missing)"
    exits: tuple[int, ...] = (0, 2)


_QUANTITY = re.compile(r"\s*[-+]?[0-9.]+(?:[eE][-+]?[0-9]+)?\s+([A-Za-z%][\w/*^.% -]*)$")


def _text_of(keys: Keys) -> str:
    return ".".join(str(key) for key in keys)


def _changed(case: dict, keys: Keys, value) -> dict:
    changed = copy.deepcopy(case)
    parent_of(changed, keys)[keys[-1]] = value
    return changed


def fixed(case: bytes, must_refuse: bool) -> Callable[[], tuple[bytes, bool]]:
    """Returns what makes a case that is known already. Most are made only when they are tried."""
    return lambda: (case, must_refuse)


def _removed(case: dict, keys: Keys) -> dict:
    changed = copy.deepcopy(case)
    del parent_of(changed, keys)[keys[-1]]
    return changed


def _misspelt(case: dict, keys: Keys) -> dict:
    changed = copy.deepcopy(case)
    table = parent_of(changed, keys)
    table[f"{keys[-1]}x"] = table.pop(keys[-1])
    return changed


def broken_keys(case: dict, is_valid: Callable[[dict], bool]) -> Iterator[Broken]:
    """Every key removed, misspelt and given twice. `is_valid` compares a case with the JSON schema."""
    def removed(keys: Keys) -> tuple[bytes, bool]:
        changed = _removed(case, keys)
        return to_text(changed).encode(), not is_valid(changed)

    def misspelt(keys: Keys) -> tuple[bytes, bool]:
        # A name that the user gives, of a material or of a body that nothing refers to, may be any other.
        is_name = len(keys) == 2 and keys[0] in ("material", "geometry", "body", "obstacle")
        return to_text(_misspelt(case, keys)).encode(), not is_name

    for keys in keys_of(case):
        where = _text_of(keys)
        yield Broken("key removed", where, lambda keys=keys: removed(keys))
        yield Broken("key misspelt", where, lambda keys=keys: misspelt(keys))
        value = parent_of(case, keys)[keys[-1]]
        if not isinstance(value, (dict, list)) and all(isinstance(key, str) for key in keys):
            yield Broken("key twice", where, lambda keys=keys, value=value: (_twice(case, keys, value), True))


def _twice(case: dict, keys: Keys, value) -> bytes:
    table = ".".join(str(key) for key in keys[:-1])
    text = to_text(case)
    at = text.index(f"[{table}]\n") + len(table) + 3 if table else 0
    return f"{text[:at]}{keys[-1]} = {value_text(value)}\n{text[at:]}".encode()


def broken_values(case: dict, is_valid: Callable[[dict], bool]) -> Iterator[Broken]:
    """Every value of another type and unit, negative, zero, huge, tiny, and not finite."""
    def broken(kind: str, keys: Keys, value, must_refuse: bool | None = True) -> Broken:
        def content() -> tuple[bytes, bool]:
            changed = _changed(case, keys, value)
            return to_text(changed).encode(), not is_valid(changed) if must_refuse is None else must_refuse
        return Broken(kind, f"{_text_of(keys)} = {value_text(value)}", content)

    for keys in leaves(case):
        value = parent_of(case, keys)[keys[-1]]
        for other in (True, {"a": 1}, [[]]) if not isinstance(value, bool) else ("yes", {"a": 1}):
            yield broken("another type", keys, other)
        unit = _QUANTITY.match(value) if isinstance(value, str) else None
        is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
        if not unit and not is_number:
            continue
        suffix = f" {unit[1]}" if unit else ""
        # An angle is a number too, and so is a length of one unit of a mesh.
        is_angle = unit is not None and unit[1] in ("deg", "rad")
        for other in ("3 mol", "3 K/m") if is_angle or not unit else ("3 mol", "3", "3 K/m"):
            yield broken("another unit", keys, other)
        for number in ("nan", "inf", "-inf"):
            yield broken("not finite", keys, f"{number}{suffix}" if unit else float(number))
        for kind, number in (("negative", -7.3), ("zero", 0.0), ("huge", 1e300), ("tiny", 1e-300)):
            yield broken(kind, keys, f"{number}{suffix}" if unit else number, None)


def broken_texts(case: dict, dice: random.Random) -> Iterator[Broken]:
    """The text cut, disturbed, in other encodings, with endless lines and depths."""
    text = to_text(case)
    for _ in range(30):
        at = dice.randrange(1, len(text))
        yield Broken("text cut", f"at {at}", fixed(text[:at].encode(), False))
        at = dice.randrange(len(text))
        more = dice.choice(['"', "'", "[", "]", "{", "}", "=", "\n", '"""', "#", "\\", ".", ",", "\x07"])
        yield Broken("text disturbed", f"{more!r} at {at}", fixed((text[:at] + more + text[at:]).encode(), False))
    data = text.encode()
    yield Broken("encoding", "byte order mark", fixed(b"\xef\xbb\xbf" + data, False))
    yield Broken("encoding", "UTF-16", fixed(text.encode("utf-16"), True))
    yield Broken("encoding", "UTF-32", fixed(text.encode("utf-32"), True))
    yield Broken("encoding", "Latin-1", fixed(b"# \xe9t\xe9\n" + data, True))
    yield Broken("encoding", "NUL", fixed(data + b"\0\n", True))
    yield Broken("encoding", "ends of lines of Windows", fixed(text.replace("\n", "\r\n").encode(), False))
    yield Broken("encoding", "ends of lines of old Macs", fixed(text.replace("\n", "\r").encode(), True))
    size, depth = 10_000_000, 30_000
    yield Broken("long line", "key", fixed(b"k" * size + b" = 1\n" + data, True))
    yield Broken("long line", "text", fixed(b"nonsense = '" + b"t" * size + b"'\n" + data, True))
    yield Broken("long line", "number", fixed(b"nonsense = " + b"1" * size + b"\n" + data, True))
    yield Broken("long line", "comment", fixed(b"# " + b"c" * size + b"\n" + data, False))
    yield Broken("long line", "list", fixed(b"nonsense = [" + b"1," * (size // 2) + b"]\n" + data, True))
    yield Broken("depth", "lists", fixed(b"nonsense = " + b"[" * depth + b"]" * depth + b"\n" + data, True))
    yield Broken("depth", "tables", fixed(b"nonsense = " + b"{a=" * depth + b"1" + b"}" * depth + b"\n" + data, True))
    yield Broken("depth", "dotted key", fixed(b"a" + b".a" * depth + b" = 1\n" + data, True))
    yield Broken("depth", "header", fixed(data + b"[a" + b".a" * depth + b"]\n", True))
    yield Broken("empty", "nothing", fixed(b"", True))
    yield Broken("empty", "a comment", fixed(b"# nothing\n", True))


def broken_includes(case: dict) -> Iterator[Broken]:
    """Files that a case cannot include."""
    text = to_text({key: value for key, value in case.items() if key != "include"})

    def including(what: str, name: str, make: Callable[[Path], None] | None) -> Broken:
        return Broken("include", what, fixed(f"include = [{value_text(name)}]\n{text}".encode(), True), make)

    def write(name: str, content: str) -> Callable[[Path], None]:
        return lambda folder: (folder / name).write_text(content) and None

    yield including("itself", "case.toml", None)
    yield including("another that includes it", "other.toml", write("other.toml", 'include = ["case.toml"]\n'))
    yield including("a file that is not there", "none.toml", None)
    yield including("a folder", "folder", lambda folder: (folder / "folder").mkdir())
    yield including("a pipe", "pipe.toml", lambda folder: os.mkfifo(folder / "pipe.toml"))
    yield including("a device", "/dev/zero", None)
    yield including("a file of bytes", "bytes.toml", lambda folder: (folder / "bytes.toml").write_bytes(bytes(range(256))) and None)

    def doubling(folder: Path) -> None:
        for level in range(40):
            (folder / f"level{level}.toml").write_text(f'include = ["level{level + 1}.toml", "level{level + 1}.toml"]\n')
        (folder / "level40.toml").write_text("")

    yield including("2^40 files", "level0.toml", doubling)
