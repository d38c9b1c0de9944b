# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Data files with one mistake each: meshes, grids, tables, points, checkpoints and plugins."""
from __future__ import annotations

import os
import random
import re
import struct
from collections.abc import Callable, Iterator
from pathlib import Path

from broken_cases import Broken, fixed

_BODY = """title = "A small body"
[discretization]
spacing = "10 mm"
[material.a]
model = "linear_elastic"
grain_density = "2600 kg/m3"
bulk_modulus = "10 MPa"
shear_modulus = "5 MPa"
porosity = 0.4
{retention}
[body.b]
geometry = {{ {geometry} }}
material = "a"
{water}
[[boundary]]
type = "fixed"
plane = "z = 10 mm"
[[stage]]
name = "go"
type = "dynamic"
duration = "3 ms"
[[output]]
writer = "csv"
every = "1 ms"
"""
_BOX = 'generator = "box", size = ["40 mm", "40 mm", "40 mm"]'
_CORNERS = [(x, y, z) for x in (0, 40) for y in (0, 40) for z in (0, 40)]
_FACES = [(0, 1, 3), (0, 3, 2), (4, 6, 7), (4, 7, 5), (0, 4, 5), (0, 5, 1), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
          (1, 5, 7), (1, 7, 3)]


def _case(geometry: str = _BOX, retention: str = "", water: str = "") -> bytes:
    return _BODY.format(geometry=geometry, retention=retention, water=water).encode()


def _stl_text() -> bytes:
    lines = ["solid box"]
    for face in _FACES:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += [f"vertex {x} {y} {z}" for x, y, z in (_CORNERS[corner] for corner in face)]
        lines += ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid box", ""]).encode()


def _stl_binary() -> bytes:
    data = b" " * 80 + struct.pack("<I", len(_FACES))
    for face in _FACES:
        data += struct.pack("<12fH", 0, 0, 0, *(value for corner in face for value in _CORNERS[corner]), 0)
    return data


def _corner_lines(prefix: str = "") -> str:
    return "".join(f"{prefix}{x} {y} {z}\n" for x, y, z in _CORNERS)


def _meshes() -> dict[str, bytes]:
    faces = "".join("3 {} {} {}\n".format(*face) for face in _FACES)
    ply = (f"ply\nformat ascii 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
           f"element face {len(_FACES)}\nproperty list uchar int vertex_indices\nend_header\n")
    return {"text.stl": _stl_text(), "binary.stl": _stl_binary(),
            "mesh.off": f"OFF\n8 {len(_FACES)} 0\n{_corner_lines()}{faces}".encode(),
            "mesh.obj": (_corner_lines("v ") + "".join("f {} {} {}\n".format(*(c + 1 for c in face)) for face in _FACES)).encode(),
            "mesh.ply": f"{ply}{_corner_lines()}{faces}".encode()}


def _grid() -> bytes:
    rows = "\n".join(" ".join(f"{0.04 + 0.002 * ((i * j) % 5):.4f}" for i in range(6)) for j in range(6))
    return f"ncols 6\nnrows 6\nxllcenter 0.0\nyllcenter 0.0\ncellsize 0.01\nNODATA_value -9999\n{rows}\n".encode()


def _points() -> bytes:
    rows = "".join(f"{0.005 + 0.01 * i},{0.005 + 0.01 * j},{0.005 + 0.01 * k},1e-6\n"
                   for i in range(4) for j in range(4) for k in range(4))
    return ("x [m],y [m],z [m],volume [m3]\n" + rows).encode()


def _suctions() -> bytes:
    return b"x [m],y [m],z [m],suction [Pa]\n0,0,0,1000\n0.04,0,0,2000\n0,0.04,0.04,500\n"


def _retention() -> bytes:
    return b"suction [kPa],saturation [-]\n0,1\n1,0.8\n10,0.4\n100,0.1\n"


def sound_files() -> dict[str, tuple[bytes, bytes]]:
    """Returns a case and the content of its data file, by the name of the file."""
    files = {name: (_case(f'generator = "surface_mesh", file = "{name}", scale = "1 mm"'), data)
             for name, data in _meshes().items()}
    files["grid.asc"] = (_case('generator = "heightfield", file = "grid.asc", base = "0 mm"'), _grid())
    files["points.csv"] = (_case('generator = "points", file = "points.csv"'), _points())
    curve = '[material.a.retention]\ncurve = "table"\nfile = "curve.csv"'
    files["curve.csv"] = (_case(retention=curve, water='water = { type = "uniform", suction = "1 kPa" }'), _retention())
    files["field.csv"] = (_case(retention=curve.replace("curve.csv", "field_curve.csv"),
                                water='water = { type = "field", file = "field.csv" }'), _suctions())
    return files


_NUMBER = re.compile(rb"(?<![\w.])[-+]?\d+(?:\.\d*)?(?:[eE][-+]?\d+)?(?![\w.])")


def _is_text(data: bytes) -> bool:
    return b"\0" not in data


def _damages(data: bytes, dice: random.Random) -> Iterator[tuple[str, str, bytes, bool]]:
    """Yields kind, words, content, and whether nobody can mean it."""
    text = _is_text(data)
    yield "empty", "nothing", b"", True
    yield "encoding", "UTF-16", data.decode("latin-1").encode("utf-16"), text
    yield "noise", "random bytes", dice.randbytes(5000), True
    yield "long line", "ten million characters", b"1" * 10_000_000, True
    if text:
        yield "ends of lines", "of Windows", data.replace(b"\n", b"\r\n"), False
        numbers = list(_NUMBER.finditer(data))
        for value in (b"nan", b"inf", b"1e300", b"-1", b"abc", b"", b"99999999999999999999", b"2147483648", b"0"):
            for number in dice.sample(numbers, min(12, len(numbers))):
                normal = data.rfind(b"facet normal", 0, number.start()) > data.rfind(b"\n", 0, number.start())  # not read
                content = data[:number.start()] + value + data[number.end():]
                yield "number replaced", f"{number[0].decode()} at {number.start()} by {value.decode()!r}", content, not normal and value in (b"nan", b"inf", b"abc")
    for _ in range(12):
        at = dice.randrange(1, len(data))
        yield "truncated", f"at {at}", data[:at], False
        flipped = bytearray(data)
        for _ in range(dice.choice((1, 1, 3))):
            flipped[dice.randrange(len(data))] ^= 1 << dice.randrange(8)
        yield "bits flipped", "", bytes(flipped), False
        lines = data.split(b"\n")
        del lines[dice.randrange(len(lines))]
        yield "line removed", "", b"\n".join(lines), False
    if not text:
        for count in (0, 11, 13, 2**31, 2**32 - 1):
            yield "count", str(count), data[:80] + struct.pack("<I", count) + data[84:], count != 11


def broken_files(dice: random.Random) -> Iterator[Broken]:
    """Every data file damaged, and replaced by what is no file."""
    for name, (case, data) in sound_files().items():
        def put(content: bytes, name: str = name) -> Callable[[Path], None]:
            def make(folder: Path) -> None:
                (folder / name).write_bytes(content)
                if name == "field.csv":
                    (folder / "field_curve.csv").write_bytes(_retention())
            return make

        for kind, words, content, must_refuse in _damages(data, dice):
            yield Broken(f"file: {kind}", f"{name}: {words}", fixed(case, must_refuse), put(content),
                         named=rf"{name}|case\.toml:\d+:\d+")
        for what, make in (("a folder", lambda folder, name=name: (folder / name).mkdir()),
                           ("a pipe", lambda folder, name=name: os.mkfifo(folder / name)),
                           ("a link to /dev/zero", lambda folder, name=name: (folder / name).symlink_to("/dev/zero")),
                           ("not there", lambda folder: None)):
            yield Broken("file: no file", f"{name}: {what}", fixed(case, True), make, named=name)


def broken_checkpoints(dice: random.Random, stopped: dict[str, bytes]) -> Iterator[Broken]:
    """A stopped run whose two checkpoints are damaged. `stopped` holds the files of its folder by name."""
    sound = stopped["checkpoint.bin"]

    def put(content: bytes) -> Callable[[Path], None]:
        def make(folder: Path) -> None:
            for name, data in stopped.items():
                file = folder / "out" / name
                file.parent.mkdir(parents=True, exist_ok=True)
                file.write_bytes(content if name.startswith("checkpoint") else data)
        return make

    def broken(kind: str, words: str, content: bytes) -> Broken:
        return Broken(f"checkpoint: {kind}", words, fixed(_case(), True), put(content), named="checkpoint",
                      arguments=["run", "case.toml", "--out", "out", "--resume", "--quiet"])

    yield broken("empty", "nothing", b"")
    yield broken("noise", "random bytes", dice.randbytes(5000))
    yield broken("longer", "bytes added", sound + b"\0" * 100)
    for _ in range(60):
        yield broken("truncated", "", sound[:dice.randrange(1, len(sound))])
        flipped = bytearray(sound)
        flipped[dice.randrange(len(sound))] ^= 1 << dice.randrange(8)
        yield broken("bits flipped", "", bytes(flipped))


def broken_plugins(dice: random.Random, library: Path) -> Iterator[Broken]:
    """A library in the folder of plugins that is none. A folder of plugins may hold others' files: only a case that
    names the plugin must be refused, and it does."""
    sound = library.read_bytes()
    case = _case().replace(b'model = "linear_elastic"', b'model = "missing_law"')

    def broken(kind: str, words: str, make: Callable[[Path], None]) -> Broken:
        return Broken(f"plugin: {kind}", words, fixed(case, True), make, named="missing_law",
                      arguments=["check", "case.toml", "--plugin-path", "."])

    def put(content: bytes) -> Callable[[Path], None]:
        return lambda folder: (folder / "missing_law.so").write_bytes(content) and None

    yield broken("empty", "nothing", lambda folder: (folder / "missing_law.so").touch())
    yield broken("noise", "random bytes", put(dice.randbytes(5000)))
    yield broken("text", "a script", put(b"#!/bin/sh\n"))
    yield broken("no file", "a folder", lambda folder: (folder / "missing_law.so").mkdir())
    yield broken("no file", "a pipe", lambda folder: os.mkfifo(folder / "missing_law.so"))
    for _ in range(40):
        yield broken("truncated", "", put(sound[:dice.randrange(1, len(sound))]))
    header = len(sound) // 200  # beyond it a flipped bit is code, which no loader can check
    for _ in range(40):
        flipped = bytearray(sound)
        flipped[dice.randrange(min(64, header))] ^= 1 << dice.randrange(8)
        yield broken("bits flipped", "in the header", put(bytes(flipped)))
