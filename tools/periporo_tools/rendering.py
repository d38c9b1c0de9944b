# Copyright 2026 The periporo authors
# SPDX-License-Identifier: BSD-3-Clause
#
"""Shaded perspective images of a cloud of points: spheres in a depth buffer, numpy alone."""
from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np


@dataclass(frozen=True)
class Camera:
    """A pinhole camera that looks at `target` from `distance` [m], image axes right and down [pixels]."""

    target: np.ndarray
    distance: float
    azimuth: float  # [rad] about the vertical, from the x axis
    elevation: float  # [rad] above the horizontal
    focal: float  # [pixels]
    width: int
    height: int

    def axes(self) -> np.ndarray:
        """Rows: right, up, and away from the target."""
        sin_a, cos_a = np.sin(self.azimuth), np.cos(self.azimuth)
        sin_e, cos_e = np.sin(self.elevation), np.cos(self.elevation)
        return np.array(
            [[-sin_a, cos_a, 0.0], [-sin_e * cos_a, -sin_e * sin_a, cos_e], [cos_e * cos_a, cos_e * sin_a, sin_e]]
        )

    def project(self, position: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Column, row and depth [m] of points."""
        seen = (np.asarray(position, dtype=float) - self.target) @ self.axes().T
        depth = self.distance - seen[..., 2]
        scale = self.focal / depth
        return self.width / 2 + seen[..., 0] * scale, self.height / 2 - seen[..., 1] * scale, depth


def aimed_at(lower: np.ndarray, upper: np.ndarray, width: int) -> Camera:
    """A camera that sees a box, which fills the image; the image is as high as the box needs."""
    target = np.array([0.5 * (lower[0] + upper[0]), 0.5 * (lower[1] + upper[1]), lower[2]])
    size = float(np.linalg.norm(upper - lower))
    corners = np.array(
        [[x, y, z] for x in (lower[0], upper[0]) for y in (lower[1], upper[1]) for z in (lower[2], upper[2])]
    )
    # A camera at a target moved by a little sees nearly the same, moved by as much: two rounds centre the box.
    camera = Camera(target, 3.0 * size, np.radians(-62.0), np.radians(20.0), 1.0, 0, 0)
    for _ in range(2):
        column, row, _ = camera.project(corners)
        middle = 0.5 * np.array([column.max() + column.min(), -(row.max() + row.min())])
        target = target + camera.distance * middle @ camera.axes()[:2]
        camera = replace(camera, target=target)
    column, row, _ = camera.project(corners)
    focal = 0.5 * width / np.abs(column).max()
    return replace(camera, focal=focal, width=width, height=int(np.ceil(2.0 * focal * np.abs(row).max())))


def _front_layer(column: np.ndarray, row: np.ndarray, depth: np.ndarray, pixels: float, thickness: float) -> np.ndarray:
    """Indices of the points that can be seen at all, nearest last: the rest lies well behind others."""
    cell = np.floor(column / pixels).astype(np.int64) * 100_003 + np.floor(row / pixels).astype(np.int64)
    _, group = np.unique(cell, return_inverse=True)
    nearest = np.full(group.max() + 1, np.inf)
    np.minimum.at(nearest, group, depth)
    seen = np.flatnonzero(depth < nearest[group] + thickness)
    return seen[np.argsort(-depth[seen], kind="stable")]


def _blurred(values: np.ndarray, mask: np.ndarray, radius: int) -> np.ndarray:
    """Mean over a square window of the pixels in the mask, three times over: close to a Gaussian."""

    def box(image: np.ndarray) -> np.ndarray:
        for axis in (0, 1):
            padding = [(0, 0), (0, 0)]
            padding[axis] = (radius + 1, radius)
            sums = np.cumsum(np.pad(image, padding), axis=axis)
            window = 2 * radius + 1
            upper = np.take(sums, np.arange(window, sums.shape[axis]), axis=axis)
            lower = np.take(sums, np.arange(0, sums.shape[axis] - window), axis=axis)
            image = upper - lower
        return image

    weight, total = mask.astype(float), np.where(mask, values, 0.0)
    for _ in range(3):
        weight, total = box(weight), box(total)
    return np.where(mask, total / np.maximum(weight, 1e-12), 0.0)


def render(position: np.ndarray, colour: np.ndarray, ball: float, camera: Camera) -> np.ndarray:
    """Draws points as shaded balls.

    @param colour N x 3, 0..1
    @param ball radius of a ball [m]
    @return height x width x 4, transparent where nothing is
    """
    shape = (camera.height, camera.width)
    nearest = np.full(camera.width * camera.height, np.inf)
    owner = np.full(camera.width * camera.height, -1, dtype=np.int64)
    facing = np.zeros(camera.width * camera.height)  # how much the ball's surface faces the camera

    column, row, depth = camera.project(position)
    pixels = float(ball * camera.focal / np.median(depth))
    seen = _front_layer(column, row, depth, max(1.0, pixels), 4.0 * ball)
    column, row, depth = column[seen], row[seen], depth[seen]
    own_pixels = ball * camera.focal / depth
    column_base, row_base = np.round(column).astype(int), np.round(row).astype(int)
    reach = int(np.ceil(own_pixels.max()))
    for down in range(-reach, reach + 1):
        for right in range(-reach, reach + 1):
            off = ((column_base + right - column) ** 2 + (row_base + down - row) ** 2) / own_pixels**2
            at_column, at_row = column_base + right, row_base + down
            hit = (off <= 1.0) & (at_column >= 0) & (at_column < shape[1]) & (at_row >= 0) & (at_row < shape[0])
            towards = np.sqrt(1.0 - off[hit])
            surface = depth[hit] - ball * towards
            pixel = at_row[hit] * shape[1] + at_column[hit]
            closer = surface < nearest[pixel]
            pixel, surface = pixel[closer], surface[closer]
            # Balls come farthest first, but their surfaces need not: let the nearest write last.
            order = np.argsort(-surface, kind="stable")
            pixel = pixel[order]
            nearest[pixel] = surface[order]
            owner[pixel] = np.flatnonzero(hit)[closer][order]
            facing[pixel] = towards[closer][order]

    mask = (owner >= 0).reshape(shape)
    if not mask.any():
        return np.zeros(shape + (4,))
    depth_image = np.where(mask, nearest.reshape(shape), 0.0)
    smooth = _blurred(depth_image, mask, max(1, int(1.2 * pixels)))
    metres = camera.distance / camera.focal
    slope_row, slope_column = np.gradient(np.where(mask, smooth, np.nan), metres)
    slope_row, slope_column = np.nan_to_num(slope_row), np.nan_to_num(slope_column)
    normal = np.stack([slope_column, -slope_row, np.ones(shape)], axis=-1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    light = np.array([-0.45, 0.65, 0.61])
    light /= np.linalg.norm(light)
    lit = np.clip(normal @ light, 0.0, 1.0)
    hollow = np.clip((depth_image - smooth) / (2.0 * ball), 0.0, 1.0)
    shade = (0.58 + 0.52 * lit) * (0.86 + 0.14 * facing.reshape(shape)) * (1.0 - 0.35 * hollow)

    image = np.zeros(shape + (4,))
    image[..., :3] = np.clip(colour[seen][owner.reshape(shape)] * shade[..., None], 0.0, 1.0)
    image[..., 3] = mask
    image[~mask] = 0.0
    return image


def smaller(image: np.ndarray, factor: int) -> np.ndarray:
    """Averages squares of pixels, edges softened by their cover."""
    height, width = image.shape[0] // factor * factor, image.shape[1] // factor * factor
    blocks = image[:height, :width].reshape(height // factor, factor, width // factor, factor, 4)
    cover = blocks[..., 3].mean(axis=(1, 3))
    colour = (blocks[..., :3] * blocks[..., 3:]).mean(axis=(1, 3)) / np.maximum(cover, 1e-9)[..., None]
    return np.concatenate([colour, cover[..., None]], axis=-1)
