"""Synthetic sculptures: sausages along curves, welded at thin necks."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

NECK = 0.0025
"""Radius of a joint (m)."""


@dataclass(frozen=True)
class Sausage:
    start: tuple[float, float, float]
    end: tuple[float, float, float]
    radius: float = 0.025
    bow: tuple[float, float, float] = (0.0, 0.0, 0.0)
    rings: int = 18


def _centre_line(sausage: Sausage, t: np.ndarray) -> np.ndarray:
    start, end, bow = (np.asarray(v, dtype=float) for v in (sausage.start, sausage.end, sausage.bow))
    return (1 - t) * start + t * end + 4 * t * (1 - t) * bow


def _radius(sausage: Sausage, t: np.ndarray, length: float) -> np.ndarray:
    cap = min(1.15 * sausage.radius, length / 2)
    along = np.minimum(t, 1 - t) * length
    x = np.clip(1 - along / cap, 0, 1)
    return np.maximum(sausage.radius * (1 - x**2.4) ** (1 / 1.9), NECK)


def tube(sausages: list[Sausage], around: int = 12) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Points (V, 3), quads (Q, 4) and the sausage of each quad (Q,) of one closed balloon."""
    centres, radii, owner = [], [], []
    for number, sausage in enumerate(sausages):
        t = 0.5 - 0.5 * np.cos(np.linspace(0, np.pi, sausage.rings))[:, None]
        line = _centre_line(sausage, t)
        length = float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum())
        skip = 0 if number == 0 else 1
        centres.append(line[skip:])
        radii.append(_radius(sausage, t[:, 0], length)[skip:])
        owner += [number] * (sausage.rings - skip)
    line, radius = np.concatenate(centres), np.concatenate(radii)
    return (*_sweep(line, radius, around), _quad_owner(owner, around))


def _sweep(line: np.ndarray, radius: np.ndarray, around: int) -> tuple[np.ndarray, np.ndarray]:
    tangent = np.gradient(line, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    normal = np.cross(tangent[0], [0.0, 0.3, 1.0])
    rings = []
    angle = 2 * np.pi * np.arange(around) / around
    for centre, direction, size in zip(line, tangent, radius, strict=True):
        normal = normal - direction * (normal @ direction)
        normal = normal / np.linalg.norm(normal)
        side = np.cross(direction, normal)
        rings.append(centre + size * (np.cos(angle)[:, None] * normal + np.sin(angle)[:, None] * side))
    points = np.concatenate([*rings, line[:1], line[-1:]]).astype(np.float32)
    return points, _tube_quads(len(line), around)


def _tube_quads(rings: int, around: int) -> np.ndarray:
    i, j = np.meshgrid(np.arange(rings - 1), np.arange(around), indexing="ij")
    a, b = i * around + j, i * around + (j + 1) % around
    side = np.stack([a, b, b + around, a + around], axis=-1).reshape(-1, 4)
    j = np.arange(around)
    following, first, last = (j + 1) % around, rings * around, rings * around + 1
    low = np.stack([np.full(around, first), following, j, j], axis=1)
    base = (rings - 1) * around
    high = np.stack([np.full(around, last), base + j, base + following, base + following], axis=1)
    return np.concatenate([side, low, high]).astype(np.int32)


def _quad_owner(owner: list[int], around: int) -> np.ndarray:
    side = np.repeat(np.asarray(owner[1:]), around)
    return np.concatenate([side, np.full(around, owner[0]), np.full(around, owner[-1])]).astype(np.int32)


def chain() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Five sausages in a row with a flat tail."""
    ends = [0.0, 0.06, 0.15, 0.21, 0.34]
    row = [Sausage((a, 0, 0), (b, 0, 0)) for a, b in pairwise(ends)]
    return tube([*row, Sausage((0.34, 0, 0), (0.42, 0, 0.01), radius=0.0045)])


def dog() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The classic dog, posed by hand."""
    head, crown = (0.085, 0.0, 0.205), (0.10, 0.0, 0.295)
    chest, hip = (0.135, 0.0, 0.145), (0.285, 0.0, 0.145)
    fore, hind = (0.128, 0.0, 0.025), (0.288, 0.0, 0.025)
    return tube(
        [
            Sausage((0.0, 0.0, 0.195), head, 0.023),
            Sausage(head, crown, 0.024, (0, 0.020, 0)),
            Sausage(crown, head, 0.024, (0, -0.020, 0)),
            Sausage(head, chest, 0.0235),
            Sausage(chest, fore, 0.025, (0, 0.021, 0)),
            Sausage(fore, chest, 0.025, (0, -0.021, 0)),
            Sausage(chest, hip, 0.026, (0, 0, 0.004)),
            Sausage(hip, hind, 0.025, (0, 0.021, 0)),
            Sausage(hind, hip, 0.025, (0, -0.021, 0)),
            Sausage(hip, (0.375, 0.0, 0.245), 0.024, (0.012, 0, -0.012)),
            Sausage((0.375, 0.0, 0.245), (0.40, 0.0, 0.275), 0.0045),
        ]
    )
