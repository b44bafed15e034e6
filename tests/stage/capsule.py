"""A closed capsule of quads that breathes, with particles of air in it that part half-way into two clusters."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.stage import AirDescription, MeshDescription, StageDescription

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

RADIUS = 0.025
LENGTH = 0.2
"""From pole to pole [m]."""
WIDTH = 0.003
"""Diameter of a particle [m]."""
BUBBLES = ("nose", "tail")


@dataclass(frozen=True)
class AirFrame:
    time_code: int
    points: tuple[NDArray[np.float32], ...]
    stretch: tuple[NDArray[np.float32], ...]
    pressure: NDArray[np.float32]
    volume: NDArray[np.float32]
    air: tuple[NDArray[np.float32], ...]
    cluster: tuple[NDArray[np.int32], ...]


@dataclass(frozen=True)
class Capsule:
    """A cube-sphere stretched along x: caps of n x n quads, 4n x `along` quads between them."""

    n: int = 2
    along: int = 4
    grid: tuple[int, int, int] = (6, 2, 2)
    """Particles along x, y and z."""

    @property
    def lattice(self) -> NDArray[np.int64]:
        """Points of the cube's surface on an n x n x along lattice (V, 3)."""
        sides = self.along + 1, self.n + 1, self.n + 1
        places = np.stack(np.meshgrid(*map(np.arange, sides), indexing="ij"), axis=-1).reshape(-1, 3)
        return places[((places == 0) | (places == np.array(sides) - 1)).any(axis=1)]

    @property
    def quads(self) -> NDArray[np.int32]:
        """Outward quads (Q, 4)."""
        number = {tuple(place): index for index, place in enumerate(self.lattice.tolist())}
        ends = np.array([self.along, self.n, self.n])
        quads = []
        for axis in range(3):
            u, v = (np.eye(3, dtype=int)[(axis + k) % 3] for k in (1, 2))
            for i, j in np.ndindex(int(ends @ u), int(ends @ v)):
                corners = [i * u + j * v, (i + 1) * u + j * v, (i + 1) * u + (j + 1) * v, i * u + (j + 1) * v]
                far = ends * np.eye(3, dtype=int)[axis]
                quads.append([number[tuple((corner + far).tolist())] for corner in corners])
                quads.append([number[tuple(corner.tolist())] for corner in reversed(corners)])
        return np.array(quads, dtype=np.int32)

    def points(self, radius: float = RADIUS, waist: float = 0.0) -> NDArray[np.float32]:
        """Vertices (V, 3), round the x axis, with a waist in the middle, its depth as a share of the radius."""
        cap = min(1.0, 0.7 * self.n / self.along)
        cube = 2.0 * self.lattice / np.array([self.along, self.n, self.n]) - 1.0
        middle = np.clip(cube[:, 0], cap - 1.0, 1.0 - cap)
        cube[:, 0] = (cube[:, 0] - middle) / cap
        # Everitt's map of the cube to the sphere keeps the quads even.
        square = cube**2
        mixed = square[:, [1, 2, 0]], square[:, [2, 0, 1]]
        ball = cube * np.sqrt(1.0 - mixed[0] / 2.0 - mixed[1] / 2.0 + mixed[0] * mixed[1] / 3.0)
        side = np.abs(cube[:, 0]) == 0.0
        ball[side, 1:] /= np.linalg.norm(ball[side, 1:], axis=1, keepdims=True)
        x = radius * ball[:, 0] + middle / (1.0 - cap or 1.0) * (0.5 * LENGTH - radius)
        thin = 1.0 - waist * np.exp(-((x / radius) ** 2))
        return np.stack([x, *(radius * thin * ball[:, k] for k in (1, 2))], axis=1).astype(np.float32)

    def particles(self, radius: float = RADIUS) -> NDArray[np.float32]:
        """Particles (P, 3) on a lattice inside."""
        share = [(np.arange(k) + 0.5) / k - 0.5 for k in self.grid]
        places = np.stack(np.meshgrid(*share, indexing="ij"), axis=-1).reshape(-1, 3)
        return (places * [LENGTH - radius, 1.2 * radius, 1.2 * radius]).astype(np.float32)

    def describe(self, **changes: object) -> StageDescription:
        """One balloon of two bubbles and its air."""
        quads = self.quads
        middle = self.points()[quads].mean(axis=1)[:, 0]
        st = np.tile(np.array([[0, 0], [1, 0], [1, 1], [0, 1]], dtype=np.float32), (len(quads), 1, 1))
        bubble = (middle > 0.0).astype(np.int32)
        mesh = MeshDescription("main", quads, st, bubble, BUBBLES, (0.8, 0.05, 0.08), "latex_red")
        given: dict[str, object] = {
            "name": "capsule",
            "title": "A capsule of springs",
            "fps": 24.0,
            "meshes": (mesh,),
            "bubble_names": BUBBLES,
            "provenance": {"recipe": "capsule.yaml", "recipe_sha256": "0" * 64, "solver": "kosaka 1"},
            "twists": ((1, "swell"), (4, "bubble: nose")),
            "airs": (AirDescription("main_air", int(np.prod(self.grid)), WIDTH),),
        }
        return StageDescription(**{**given, **changes})  # type: ignore[arg-type]

    def frames(self, count: int) -> Iterator[AirFrame]:
        """Breathe over `count` time codes; from the one after the middle on there are two clusters."""
        for time_code in range(1, count + 1):
            radius = RADIUS * (1.0 + 0.04 * np.sin(0.4 * time_code))
            points = self.points(radius, waist=0.5 * time_code / count)
            air = self.particles(radius)
            cluster = ((air[:, 0] > 0.0) & (time_code > count // 2)).astype(np.int32)
            stretch = np.full(len(points), radius / RADIUS, dtype=np.float32)
            bubbles = np.full(2, 2000.0, dtype=np.float32)
            yield AirFrame(
                time_code, (points,), (stretch,), bubbles, bubbles * np.float32(1e-8), (air,), (cluster,)
            )


THESIS = Capsule(n=8, along=46, grid=(40, 4, 5))
"""As many vertices, faces and particles as in Kosaka 2008, chapter 4: 1602, 1600 and 800."""
