"""Small closed tubes that bend, pulse and bulge: what the stage room is tested with."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.stage import MeshDescription, StageDescription

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

AROUND = 8
RADIUS = 0.02
LENGTH = 0.3


@dataclass(frozen=True)
class Frame:
    time_code: int
    points: tuple[NDArray[np.float32], ...]
    stretch: tuple[NDArray[np.float32], ...]
    pressure: NDArray[np.float32]
    volume: NDArray[np.float32]


def tube_quads(rings: int) -> NDArray[np.int32]:
    """Side quads ring by ring, then four quads for the cap at each end."""
    ring = np.arange(AROUND)
    following = (ring + 1) % AROUND
    side = [
        np.stack(
            [r * AROUND + ring, r * AROUND + following, (r + 1) * AROUND + following, (r + 1) * AROUND + ring]
        )
        for r in range(rings - 1)
    ]
    quads = [q for block in side for q in block.T]
    last, bottom, top = (rings - 1) * AROUND, rings * AROUND, rings * AROUND + 1
    for i in range(0, AROUND, 2):
        a, b, c = i, i + 1, (i + 2) % AROUND
        quads.append(np.array([bottom, c, b, a]))
        quads.append(np.array([top, last + a, last + b, last + c]))
    return np.array(quads, dtype=np.int32)


def tube_points(rings: int, phase: float) -> NDArray[np.float32]:
    """A tube along x, pulsing with the phase, its middle lifted."""
    angle = np.linspace(0.0, 2.0 * np.pi, AROUND, endpoint=False)
    along = np.linspace(0.0, LENGTH, rings)
    radius = RADIUS * (1.0 + 0.2 * np.sin(phase + 9.0 * along))
    lift = 0.02 * np.sin(phase) * np.sin(np.pi * along / LENGTH)
    x = np.repeat(along, AROUND)
    y = np.outer(radius, np.cos(angle)).ravel()
    z = np.outer(radius, np.sin(angle)).ravel() + np.repeat(lift, AROUND)
    ends = [[-RADIUS, 0.0, 0.0], [LENGTH + RADIUS, 0.0, 0.0]]
    return np.concatenate([np.stack([x, y, z], axis=1), ends]).astype(np.float32)


def tube_mesh(
    name: str, bubbles: tuple[str, ...], rings: int, color: tuple[float, float, float]
) -> MeshDescription:
    quads = tube_quads(rings)
    nearest_ring = np.minimum(quads.min(axis=1) // AROUND, rings - 2)
    bubble = np.minimum(nearest_ring * len(bubbles) // (rings - 1), len(bubbles) - 1).astype(np.int32)
    st = np.tile(np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=np.float32), (len(quads), 1, 1))
    return MeshDescription(name, quads, st, bubble, bubbles, color, f"latex_{name}")


def sculpture(rings: int = 7, fps: float = 24.0, **changes: object) -> StageDescription:
    """Two balloons of two colours: three bubbles and two."""
    bubbles = ("nose", "left_ear", "right_ear"), ("stem", "petal")
    given: dict[str, object] = {
        "name": "dog",
        "title": "Balloon dog of two tubes",
        "fps": fps,
        "meshes": (
            tube_mesh("main", bubbles[0], rings, (0.8, 0.05, 0.08)),
            tube_mesh("second", bubbles[1], rings, (0.1, 0.3, 0.7)),
        ),
        "bubble_names": (*bubbles[0], *bubbles[1]),
        "provenance": {
            "recipe": "dog.yaml",
            "recipe_sha256": "0" * 64,
            "solver": "latex",
            "seed": 7,
            "dt": 0.001,
        },
        "twists": ((1, "bubbles: nose, left_ear"), (5, "lock: left_ear, right_ear")),
    }
    return StageDescription(**{**given, **changes})  # type: ignore[arg-type]


def frames(count: int, rings: int = 7, first: int = 1) -> Iterator[Frame]:
    """The two tubes, one above the other, over `count` time codes."""
    for time_code in range(first, first + count):
        phase = 0.1 * time_code
        one = tube_points(rings, phase)
        other = tube_points(rings, -phase) + np.array([0.0, 0.0, 0.1], np.float32)
        stretch = np.full(len(one), 1.0 + 0.01 * time_code, dtype=np.float32)
        pressure = np.array([2000.0, 2100.0, 2200.0, 2300.0, 2400.0], np.float32) + np.float32(time_code)
        yield Frame(time_code, (one, other), (stretch, stretch * 2), pressure, pressure * np.float32(1e-8))
