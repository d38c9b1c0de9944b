# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Puts tables into the marked regions of a page and the figures that it shows into pictures/ beside it."""
from __future__ import annotations

import io
import os
import re
from dataclasses import dataclass, field
from pathlib import Path

from PIL import Image

from periporo_tools.reproduction.plan import write_whole
from periporo_tools.reproduction.sweeps import SweepError

_BEGIN = re.compile(r"<!-- table: (\S+) -->")
_END = "<!-- end -->"
_PICTURE = re.compile(r"!\[[^\]]*\]\(pictures/([^)\s]+\.png)\)|<img[^>]*src=\"pictures/([^\"]+\.png)\"")
_SMALL = "small_"  # before the names of tables and pictures of the small variant, so that a page can show both
_COLOURS = 128
_LARGEST = 300_000  # bytes of a picture in the repository


@dataclass
class Changes:
    tables: list[str] = field(default_factory=list)
    pictures: list[Path] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)  # pictures that the page shows and nothing draws


def with_tables(text: str, tables: dict[str, str], known: list[str], page: Path) -> tuple[str, list[str]]:
    """The text with its regions replaced, and the names of those. Regions of tables that are known but not given stay.

    @throws SweepError for a region without end or of an unknown table, with its line
    """
    result, names, at = [], [], 0
    while begin := _BEGIN.search(text, at):
        line = text.count("\n", 0, begin.start()) + 1
        end, following = text.find(_END, begin.end()), _BEGIN.search(text, begin.end())
        if end < 0 or (following and following.start() < end):
            raise SweepError(f"{page}, line {line}: the table {begin[1]} has no end; write {_END} below it")
        if begin[1] not in known:
            raise SweepError(f"{page}, line {line}: there is no table {begin[1]}; there are {', '.join(known)}")
        result.append(text[at : begin.end()])
        if begin[1] in tables:
            names.append(begin[1])
            result.append(f"\n{tables[begin[1]]}\n")
        else:
            result.append(text[begin.end() : end])
        at = end
    return "".join([*result, text[at:]]), names


def small_png(source: Path, target: Path) -> None:
    """Writes a palette PNG of 128 colours under 300 kB, scaled down as far as that takes."""
    with Image.open(source) as opened:
        picture = opened.convert("RGB")
    scale = 1.0
    while True:
        size = (round(picture.width * scale), round(picture.height * scale))
        scaled = picture if scale == 1.0 else picture.resize(size, Image.Resampling.LANCZOS)
        content = io.BytesIO()
        # Colours far apart first, then moved to the middle of what they stand for: a colour bar keeps its steps.
        scaled.quantize(_COLOURS, Image.Quantize.MAXCOVERAGE, kmeans=1).save(content, "PNG", optimize=True)
        if content.tell() < _LARGEST:
            break
        scale *= 0.9
    target.parent.mkdir(parents=True, exist_ok=True)
    aside = target.with_name(target.name + ".part")
    aside.write_bytes(content.getvalue())
    os.replace(aside, target)


def update(page: Path, tables: dict[str, str], known: list[str], pictures: list[Path], small: bool = False) -> Changes:
    """Writes tables and pictures into the page.

    @param known names of all tables there are, those that are not given included
    @param pictures those that can be shown
    @param small whether tables and pictures are those of the small variant
    @throws SweepError when the page is not there or has a mistake; then nothing is changed
    """
    try:
        text = page.read_text()
    except OSError as error:
        raise SweepError(f"{page}: the page cannot be read ({error.strerror}); it marks its tables with"
                         f" <!-- table: NAME --> ... {_END}") from error
    variant = _SMALL if small else ""
    given = {variant + name: table for name, table in tables.items()}
    changed, names = with_tables(text, given, [*known, *(_SMALL + name for name in known)], page)
    changes = Changes(names)
    drawn = {variant + picture.name: picture for picture in pictures}
    for found in _PICTURE.finditer(changed):
        name = found[1] or found[2]
        target = page.parent / "pictures" / name
        if name in drawn:
            small_png(drawn[name], target)
            changes.pictures.append(target)
        elif not target.is_file():
            changes.missing.append(name)
    if changed != text:
        write_whole(page, changed)
    return changes
