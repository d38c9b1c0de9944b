# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Published laws (laws.json) and what they say for one column."""
from __future__ import annotations

import json
from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Piece:
    """One range of a law: lower <= a < upper, value = coefficient (factor a)^exponent + offset."""

    lower: float
    upper: float
    coefficient: float
    factor: float
    exponent: float
    offset: float

    def holds(self, aspect_ratio: float) -> bool:
        return self.lower <= aspect_ratio < self.upper

    def value(self, aspect_ratio: float) -> float:
        return self.coefficient * (self.factor * aspect_ratio) ** self.exponent + self.offset


@dataclass(frozen=True)
class Edge:
    """The end of a range next to an aspect ratio that no range covers."""

    aspect_ratio: float
    value: float


@dataclass(frozen=True)
class Prediction:
    """What a law says: a value, or the neighbouring ends of its ranges where it says nothing."""

    quantity: str  # "run_out" and "height" in units of r0, "end_of_motion" in units of (h0/g)^(1/2)
    source: str
    formula: str
    value: float | None
    neighbours: tuple[Edge, ...] = ()


@dataclass(frozen=True)
class Law:
    law: str
    quantity: str
    source: str
    formula: str
    pieces: tuple[Piece, ...]

    def predict(self, aspect_ratio: float) -> Prediction:
        for piece in self.pieces:
            if piece.holds(aspect_ratio):
                return Prediction(self.quantity, self.source, self.formula, piece.value(aspect_ratio))
        below = [piece for piece in self.pieces if piece.upper <= aspect_ratio]
        above = [piece for piece in self.pieces if piece.lower > aspect_ratio]
        edges = [Edge(piece.upper, piece.value(piece.upper)) for piece in below[-1:]]
        edges += [Edge(piece.lower, piece.value(piece.lower)) for piece in above[:1]]
        return Prediction(self.quantity, self.source, self.formula, None, tuple(edges))


def _piece(row: dict) -> Piece:
    upper = float("inf") if row["upper"] is None else float(row["upper"])
    return Piece(
        float(row["lower"]), upper, row["coefficient"], row["factor"], row["exponent"], row["offset"]
    )


def read_laws(path: Path = Path(__file__).with_name("laws.json")) -> list[Law]:
    rows = json.loads(path.read_text())["laws"]
    return [
        Law(row["law"], row["quantity"], row["source"], row["formula"], tuple(_piece(piece) for piece in row["pieces"]))
        for row in rows
    ]


def predictions(law: str, aspect_ratio: float) -> list[Prediction]:
    """What every published law of this name says, in the order of laws.json.

    @throws KeyError when there is no law of this name, naming those there are.
    """
    laws = read_laws()
    chosen = [row for row in laws if row.law == law]
    if not chosen:
        known = ", ".join(sorted({row.law for row in laws}))
        raise KeyError(f'no law is called "{law}"; there are {known}')
    return [row.predict(aspect_ratio) for row in chosen]
