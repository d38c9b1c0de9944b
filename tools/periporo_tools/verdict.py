# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""A run held against the published laws: numbers, a table and one line."""
from __future__ import annotations

import numpy as np

from periporo_tools import laws, measures
from periporo_tools.results import Comparison, Results

_GRAVITY = 9.81

# The measure that a law's quantity is held against.
_COMPARED = {"run_out": "front_mean", "height": "height", "end_of_motion": "rest_time"}
_NAMES = {"run_out": "run-out", "height": "height", "end_of_motion": "end of motion"}


def compare(results: Results) -> dict:
    """What goes into summary.json under "comparison": SI units, plain numbers."""
    asked = results.comparison
    spacing = results.spacing
    initial = measures.main_body(results.snapshot(results.release))
    planar = bool(asked and asked.law.startswith("planar")) or measures.is_planar(initial, spacing)
    final = measures.main_body(results.snapshot(-1))
    before = measures.shape(initial, spacing, results.symmetry, planar)
    after = measures.shape(final, spacing, results.symmetry, planar)
    motion = measures.motion(results.history, float(initial.mass.sum()), before.height, _GRAVITY)

    record = {
        "title": results.title,
        "complete": results.complete,
        "time": final.time,
        "points": len(final.position),
        "spacing": spacing,
        "planar": planar,
        "measured": {
            "front_mean": after.front_mean,
            "front_largest": after.front_largest,
            "front_axes": after.front_axes,
            "radius_99": after.radius_99,
            "height": after.height,
            "initial_front_mean": before.front_mean,
            "initial_height": before.height,
            "escaped_points": after.escaped,
            "escaped_mass": after.escaped_mass,
            "not_finite_points": final.not_finite,
            "rest_time": motion and motion.rest_time,
            "potential_energy_released": motion and motion.released,
            "energy_error_final": motion and motion.error_final,
            "energy_error_largest": motion and motion.error_largest,
        },
        "meaning": {
            "planar": "distances are taken along x alone, and the directions are the two sides of x = 0",
            "front_mean": "farthest point in contact with the deposit, mean over directions [m]; held against the law",
            "front_largest": "farthest point in contact with the deposit, any direction [m]",
            "front_axes": "farthest point in contact with the deposit, mean of the directions x and y [m]",
            "radius_99": "radius that holds 99 per cent of the mass [m]",
            "height": "highest point in contact with the deposit [m]",
            "in_contact": f"linked by a chain of points closer than {measures.LINK:g} spacings to most of the mass",
            "lengths": "to the edge of a point's cell, half a spacing beyond its centre; radius_99 to its centre",
            "rest_time": f"root-mean-square speed below {measures.REST:g} (g h0)^(1/2) from then on [s]",
            "energy_error": "energy ledger error over the potential energy released [-]",
        },
    }
    if asked:
        record.update(_against_laws(asked, record["measured"]))
    record["verdict"] = verdict_line(record)
    return record


def _against_laws(asked: Comparison, measured: dict) -> dict:
    try:
        predictions = laws.predictions(asked.law, asked.aspect_ratio)
    except KeyError as error:
        return {"law": asked.law, "law_error": error.args[0]}
    normalised = {
        "run_out": measured["front_mean"] / asked.radius - 1.0,
        "height": measured["height"] / asked.radius,
        "end_of_motion": None
        if measured["rest_time"] is None
        else measured["rest_time"] / float(np.sqrt(asked.height / _GRAVITY)),
    }
    rows = []
    for prediction in predictions:
        value = normalised[prediction.quantity]
        row = {
            "quantity": prediction.quantity,
            "compared": _COMPARED[prediction.quantity],
            "unit": "(h0/g)^(1/2)" if prediction.quantity == "end_of_motion" else "r0",
            "measured": value,
            "law": prediction.value,
            "source": prediction.source,
            "formula": prediction.formula,
            "difference": None,
        }
        if prediction.value is None:
            row["gap_between"] = [
                {"aspect_ratio": edge.aspect_ratio, "value": edge.value} for edge in prediction.neighbours
            ]
        elif value is not None:
            row["difference"] = value / prediction.value - 1.0
        rows.append(row)
    return {
        "law": asked.law,
        "radius": asked.radius,
        "height": asked.height,
        "aspect_ratio": asked.aspect_ratio,
        "run_out": normalised["run_out"],
        "run_out_99": measured["radius_99"] / asked.radius - 1.0,
        "run_out_largest": measured["front_largest"] / asked.radius - 1.0,
        "laws": rows,
    }


def _law_text(row: dict) -> str:
    """\"1.49 (Lube et al. 2004): -12 %\", or the neighbouring values where the law has a gap."""
    if row["law"] is not None:
        difference = "" if row["difference"] is None else f": {100 * row['difference']:+.0f} %"
        return f"{row['law']:.2f} ({row['source']}){difference}"
    if not row["gap_between"]:
        return f"no value ({row['source']})"
    edges = " and ".join(f"{edge['value']:.2f} at a = {edge['aspect_ratio']:g}" for edge in row["gap_between"])
    if len(row["gap_between"]) == 1:
        return f"none here, {edges} ({row['source']})"
    return f"none here, between {edges} ({row['source']})"


def verdict_line(record: dict) -> str:
    """One line: how the run stands to the first law of each quantity that has a value here."""
    measured = record["measured"]
    parts = []
    if record.get("laws"):
        for quantity in ("run_out", "height"):
            rows = [row for row in record["laws"] if row["quantity"] == quantity]
            held_against = next((row for row in rows if row["law"] is not None), rows[0])
            parts.append(f"{_NAMES[quantity]} {rows[0]['measured']:.2f} r0, law {_law_text(held_against)}")
    else:
        parts.append(f"front {1e3 * measured['front_mean']:.0f} mm, height {1e3 * measured['height']:.0f} mm")
    if measured["potential_energy_released"] is None:
        parts.append("no history")
    else:
        rest = measured["rest_time"]
        parts.append("still moving at the end" if rest is None else f"at rest after {rest:.2f} s")
        parts.append(f"energy closed to {100 * measured['energy_error_largest']:.2g} %")
    escaped = measured["escaped_points"]
    parts.append("no point escaped" if escaped == 0 else f"{escaped} of {record['points']} points escaped")
    if measured["not_finite_points"]:
        parts.append(f"{measured['not_finite_points']} POINTS NOT FINITE")
    if not record["complete"]:
        parts.append("RUN NOT COMPLETE")
    return "; ".join(parts)


def table(record: dict) -> str:
    """The numbers of one run, aligned for a terminal."""
    measured = record["measured"]
    rows = [("", "measured", "law", "difference", "source")]

    def line(name: str, text: str) -> None:
        rows.append((name, text, "", "", ""))

    if record.get("laws"):
        seen = set()
        for row in record["laws"]:
            quantity = row["quantity"]
            name = "" if quantity in seen else f"{_NAMES[quantity]} [{row['unit']}]"
            value = "" if quantity in seen else ("-" if row["measured"] is None else f"{row['measured']:.3f}")
            seen.add(quantity)
            law = "gap" if row["law"] is None else f"{row['law']:.3f}"
            if row.get("gap_between"):
                law = " .. ".join(f"{edge['value']:.2f}" for edge in row["gap_between"])
            difference = "-" if row["difference"] is None else f"{100 * row['difference']:+.1f} %"
            source = row["source"] + (" (gap between its ranges)" if row["law"] is None else "")
            rows.append((name, value, law, difference, source))
        line("run-out, farthest direction [r0]", f"{record['run_out_largest']:.3f}")
        line("run-out, 99 % of the mass [r0]", f"{record['run_out_99']:.3f}")
    if record["planar"]:
        line("front, mean over sides", f"{1e3 * measured['front_mean']:.1f} mm")
    else:
        line("front, mean over directions", f"{1e3 * measured['front_mean']:.1f} mm")
        line("front, along x and y", f"{1e3 * measured['front_axes']:.1f} mm")
    line("height", f"{1e3 * measured['height']:.1f} mm")
    line("escaped points", f"{measured['escaped_points']} of {record['points']}")
    if measured["potential_energy_released"] is not None:
        rest = measured["rest_time"]
        line("at rest after", "not at rest" if rest is None else f"{rest:.3f} s")
        line("energy error over energy released", f"{100 * measured['energy_error_largest']:.2g} %")
    widths = [max(len(row[column]) for row in rows) for column in range(5)]
    return "\n".join("  " + "  ".join(f"{cell:<{width}}" for cell, width in zip(row, widths)).rstrip() for row in rows)


def law_cells(record: dict, quantity: str) -> tuple[str, str, str]:
    """Value, law and difference for a table; several laws stand in the order of laws.json."""
    rows = [row for row in record.get("laws", []) if row["quantity"] == quantity]
    if not rows or rows[0]["measured"] is None:
        return "-", "-", "-"
    value = f"{rows[0]['measured']:.2f}"
    law, difference = [], []
    for row in rows:
        if row["law"] is None:
            edges = [f"{edge['value']:.2f}" for edge in row["gap_between"]]
            law.append(f"gap {edges[0]} .. {edges[1]}" if len(edges) == 2 else "-")  # "-": it says nothing there
            difference.append("-")
        else:
            law.append(f"{row['law']:.2f}")
            difference.append("-" if row["difference"] is None else f"{100 * row['difference']:+.0f} %")
    return value, "; ".join(law), "; ".join(difference)


def markdown(records: list[dict]) -> str:
    """A table of several runs; where two laws are held against a number, they stand in the order of laws.json."""
    head = (
        "| run | a | points | run-out [r0] | law | difference | 99 % of mass [r0] | height [r0] | law | difference"
        " | rest [s] | law [s] | escaped | energy error |"
    )
    lines = [head, "|" + "---|" * (head.count("|") - 1)]
    for record in records:
        measured = record["measured"]
        rest_law = law_of_rest(record)
        cells = [
            record["title"] + ("" if record["complete"] else " (not complete)"),
            f"{record['aspect_ratio']:g}" if "aspect_ratio" in record else "-",
            f"{record['points']:,}",
            *law_cells(record, "run_out"),
            f"{record['run_out_99']:.2f}" if "run_out_99" in record else "-",
            *law_cells(record, "height"),
            "-" if measured["rest_time"] is None else f"{measured['rest_time']:.2f}",
            "-" if rest_law is None else f"{rest_law:.2f}",
            str(measured["escaped_points"]),
            "-"
            if measured["energy_error_largest"] is None
            else f"{100 * measured['energy_error_largest']:.2g} %",
        ]
        lines.append("| " + " | ".join(cells) + " |")
    if sources := sources_line(records):
        lines += ["", sources]
    return "\n".join(lines)


def law_of_rest(record: dict) -> float | None:
    """When the law says that the column is at rest [s]; the first law where there are several."""
    laws_of_rest = [row["law"] for row in record.get("laws", []) if row["quantity"] == "end_of_motion"]
    return float(laws_of_rest[0] * np.sqrt(record["height"] / _GRAVITY)) if laws_of_rest else None


def sources_line(records: list[dict]) -> str:
    """Whose laws the numbers of `law_cells` are, in their order; empty without any."""
    sources = []
    for quantity, name in _NAMES.items():
        named = []
        for record in records:
            for row in record.get("laws", []):
                if row["quantity"] == quantity and row["source"] not in named:
                    named.append(row["source"])
        if named:
            sources.append(f"{name}: {'; '.join(named)}")
    return f"Laws, in this order: {', '.join(sources)}." if sources else ""
