# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""What all pictures share: sizes, colours, and the scale of the fields."""
from __future__ import annotations

import matplotlib

matplotlib.use("Agg")

import matplotlib.pyplot as plt  # noqa: E402  the backend must be chosen before
import numpy as np  # noqa: E402
from matplotlib.cm import ScalarMappable  # noqa: E402
from matplotlib.colors import Normalize  # noqa: E402

from periporo_tools.results import DISPLACEMENT, STRAIN, Field  # noqa: E402

COLOUR_MAP = "viridis"  # even in lightness, and read alike by all eyes
# Okabe and Ito's colours, told apart by all eyes.
BLUE, ORANGE, GREEN, RED, PURPLE, SKY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9"
INK, PALE = "#333333", "#bbbbbb"
MILLI = 1e3

plt.rcParams.update(
    {
        "figure.dpi": 130,
        "font.size": 10,
        "axes.titlesize": 11,
        "axes.titlelocation": "left",
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.edgecolor": INK,
        "legend.frameon": False,
        "legend.fontsize": 9,
        "lines.linewidth": 1.8,
    }
)


def scale_of(field: Field, colour_max: float | None, colour_min: float | None = None) -> ScalarMappable:
    """The colours of a field. Plastic shear strain runs from 0 to 2 and displacement from 0 unless told, so that pictures
    can be compared; others from their least to their largest value."""
    if field.name not in ("", STRAIN, DISPLACEMENT):
        least = float(field.values.min()) if colour_min is None else colour_min
        largest = float(field.values.max()) if colour_max is None else colour_max
        return ScalarMappable(Normalize(least, max(largest, np.nextafter(least, np.inf))), COLOUR_MAP)
    if colour_max is None:
        strain = field.name == STRAIN
        colour_max = 2.0 if strain else float(np.ceil(field.values.max(initial=1.0) / 10.0) * 10.0)
    return ScalarMappable(Normalize(0.0, colour_max), COLOUR_MAP)


def colour_bar(figure, mappable: ScalarMappable, field: Field, axes, **options):
    """A colour bar with name and unit."""
    bar = figure.colorbar(mappable, ax=axes, extend="max", **options)
    bar.set_label(f"{field.name} [{field.unit}]")
    bar.outline.set_visible(False)
    return bar
