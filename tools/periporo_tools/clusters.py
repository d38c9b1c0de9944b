# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Which points hang together: connected components of a cloud."""
from __future__ import annotations

import numpy as np

# Half of the 26 cells around a cell, so that each pair of cells is visited once.
_HALF_SHELL = [
    (i, j, k) for i in (-1, 0, 1) for j in (-1, 0, 1) for k in (-1, 0, 1) if (i, j, k) > (0, 0, 0)
]


def close_pairs(position: np.ndarray, distance: float) -> tuple[np.ndarray, np.ndarray]:
    """All pairs of points no farther apart than `distance`, each once, as two index arrays."""
    cell = np.floor((position - position.min(axis=0)) / distance).astype(np.int64) + 1
    stride = cell.max(axis=0) + 2
    key = (cell[:, 0] * stride[1] + cell[:, 1]) * stride[2] + cell[:, 2]
    order = np.argsort(key, kind="stable")
    sorted_key = key[order]

    firsts, seconds = [], []
    for shift in [(0, 0, 0)] + _HALF_SHELL:
        target = sorted_key + (shift[0] * stride[1] + shift[1]) * stride[2] + shift[2]
        begin = np.searchsorted(sorted_key, target, side="left")
        end = np.searchsorted(sorted_key, target, side="right")
        if shift == (0, 0, 0):
            begin = np.arange(len(order)) + 1
        count = np.maximum(end - begin, 0)
        first = np.repeat(np.arange(len(order)), count)
        within = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count)
        first, second = order[first], order[np.repeat(begin, count) + within]
        apart = position[first] - position[second]
        near = np.einsum("ij,ij->i", apart, apart) <= distance**2
        firsts.append(first[near])
        seconds.append(second[near])
    return np.concatenate(firsts), np.concatenate(seconds)


def components(count: int, first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """The component of each of `count` points linked by pairs, named by its smallest index."""
    label = np.arange(count)
    while True:
        joined = np.minimum(label[first], label[second])
        new = label.copy()
        np.minimum.at(new, label[first], joined)
        np.minimum.at(new, label[second], joined)
        # Follow the chain of names to its end.
        while True:
            jumped = new[new]
            if (jumped == new).all():
                break
            new = jumped
        if (new == label).all():
            return label
        label = new


def heaviest_component(position: np.ndarray, mass: np.ndarray, distance: float) -> np.ndarray:
    """True for the points of the connected component that holds the most mass."""
    label = components(len(position), *close_pairs(position, distance))
    weight = np.bincount(label, weights=mass, minlength=len(position))
    return label == int(np.argmax(weight))
