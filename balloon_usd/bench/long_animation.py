"""A long animation of a fine mesh, made up: what writing, checking and comparing stages is measured with."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.capsule_mesh import capsule_mesh
from balloon_usd.stage import MeshDescription, StageDescription

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh

NAME = "long"
AROUND, LENGTH, RADIUS = 72, 1.1, 0.028
"""Vertices round a blown-up 260, its length and radius [m]: about 40 000 vertices."""
BUBBLES = tuple(f"bubble_{number}" for number in range(11))
SWAY, WAVE = 0.01, 9.0
"""How far the balloon sways [m], in a wave of so many radians a metre."""
MOVED = np.float32(2.5e-3)
"""How far the first vertex of an animation that is to differ is moved in its middle [m]."""


@dataclass(frozen=True)
class LongFrame:
    """One moment; see `StageFrame`."""

    time_code: int
    points: tuple[NDArray[np.float32], ...]
    stretch: tuple[NDArray[np.float32], ...]
    pressure: NDArray[np.float32]
    volume: NDArray[np.float32]
    air: tuple[NDArray[np.float32], ...] = ()
    cluster: tuple[NDArray[np.int32], ...] = ()


def long_mesh() -> BalloonMesh:
    """Return the mesh that moves."""
    ends = np.linspace(0.0, LENGTH, len(BUBBLES) + 1)[1:]
    return capsule_mesh(LENGTH, RADIUS, AROUND, ends.tolist())


def long_description(mesh: BalloonMesh) -> StageDescription:
    """Describe the stage of the animation."""
    shown = MeshDescription("main", mesh.quads, mesh.st, mesh.quad_bubble, BUBBLES, (0.8, 0.1, 0.1), "latex")
    origin = {"recipe": f"{NAME}.yaml", "recipe_sha256": "0" * 64, "solver": "none"}
    return StageDescription(NAME, "A long animation", 24.0, (shown,), BUBBLES, origin)


def long_frames(mesh: BalloonMesh, count: int, *, moved: bool = False) -> Iterator[LongFrame]:
    """Yield so many frames, in which every value changes; `moved`: one vertex is elsewhere in one of them."""
    # No two vertices are alike, as in life: USD packs arrays of few values, and takes its time for that.
    along = mesh.points @ np.array([1.0, 0.37, 0.61], dtype=np.float32)
    of_bubbles = np.arange(len(BUBBLES), dtype=np.float32)
    for time_code in range(1, count + 1):
        phase = np.float32(0.02 * time_code)
        wave = np.sin(np.float32(WAVE) * along + phase)
        points = mesh.points.copy()
        points[:, 2] += np.float32(SWAY) * wave
        if moved and time_code == (count + 1) // 2:
            points[0, 2] += MOVED
        stretch = np.float32(4.0) + wave
        pressure = 100.0 * of_bubbles + 7000.0 + phase
        yield LongFrame(time_code, (points,), (stretch,), pressure, np.float32(1e-8) * pressure)
