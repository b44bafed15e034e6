"""Two stages at one time code, seen from one place, and the second again in the colours of the distance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.diff.error import DiffError
from balloon_usd.diff.nearest import surface_distances
from balloon_usd.diff.opening import reading
from balloon_usd.diff.ramp import linear, ramp
from balloon_usd.preview import PreviewError, Raycaster, read_stage
from balloon_usd.preview.camera import Axes, frame_points
from balloon_usd.preview.lens import Lens
from balloon_usd.preview.scenery import require_within_reach
from balloon_usd.preview.surface import SmoothSurface

if TYPE_CHECKING:
    from pathlib import Path

    from numpy.typing import NDArray

    from balloon_usd.preview import View
    from balloon_usd.preview.camera import Framing
    from balloon_usd.preview.shot import Picture

    Floats = NDArray[np.float64]

VIEW: View = "three-quarter"
NO_DISTANCE = (0.10, 0.16, 0.24)
"""Linear rgb of a mesh that the first stage has not."""
MATT = (0.0, 1.0, 0.0)
"""Metallic, opacity and shine of the distance: a gloss would look like another colour."""


@dataclass(frozen=True)
class Trio:
    """Three pictures of one time code."""

    time_code: float
    pictures: tuple[Picture, Picture, Picture]
    """The first stage, the second, and the distance."""
    worst: tuple[float, float] | None
    """Where the point that moved farthest is on the last picture (pixels); None if none moved."""
    distance: float
    """How far that one moved (m)."""
    lone: bool
    """Whether a mesh has no counterpart in the first stage."""


class SideBySide:
    """Draws two stages; prepared once and then used for every time code."""

    def __init__(self, files: tuple[Path, Path], size: tuple[int, int], device: str) -> None:
        """Read both stages.

        Raises:
            DiffError: one of them shows no mesh.
        """
        try:
            with reading():
                self._scenes = tuple(read_stage(file) for file in files)
        except PreviewError as error:
            raise DiffError(f"{error}: there is nothing to draw") from error
        self._size, self._device = size, device
        self._surfaces = [[SmoothSurface(m.face_counts, m.corners) for m in s.meshes] for s in self._scenes]
        self._painters = [
            Raycaster(
                surfaces, [m.colors for m in scene.meshes], [m.finishes for m in scene.meshes], device=device
            )
            for surfaces, scene in zip(self._surfaces, self._scenes, strict=True)
        ]
        bare, matt = ([value for _ in self._surfaces[1]] for value in (NO_DISTANCE, MATT))
        self._ramped = Raycaster(self._surfaces[1], bare, matt, device=device)

    @property
    def range(self) -> tuple[float, float]:
        """First and last time code of both."""
        return min(scene.start for scene in self._scenes), max(scene.end for scene in self._scenes)

    def distances(self, time_code: float) -> list[Floats | None]:
        """Return how far the points of each mesh of the second stage are from where they were (V,) (m).

        Where a mesh has other vertices it is how far they are from its surface, and None for a new mesh.

        Raises:
            DiffError: points are not finite, or out of all reach.
        """
        try:
            points = [scene.points(time_code) for scene in self._scenes]
            require_within_reach(np.concatenate([part for side in points for part in side]))
        except PreviewError as error:
            raise DiffError(f"time code {time_code:g} cannot be drawn: {error}") from error
        places = {mesh.path: number for number, mesh in enumerate(self._scenes[0].meshes)}
        found: list[Floats | None] = []
        for number, mesh in enumerate(self._scenes[1].meshes):
            new, there = points[1][number], places.get(mesh.path)
            old = None if there is None else points[0][there]
            if there is None or old is None:
                found.append(None)
            elif len(old) == len(new):
                found.append(np.linalg.norm(new.astype(np.float64) - old, axis=1))
            else:
                before, after = self._surfaces[0][there], self._surfaces[1][number]
                rows = np.zeros(len(new))
                rows[np.unique(mesh.corners)] = surface_distances(before, old, after, new, self._device)
                found.append(rows)
        return found

    def draw(self, time_code: float, scale: float) -> Trio:
        """Draw one time code.

        Args:
            time_code: of both stages.
            scale: distance of the last colour (m).

        Raises:
            DiffError: points are not finite, or out of all reach.
        """
        try:
            return self._draw(time_code, scale)
        except PreviewError as error:
            raise DiffError(f"time code {time_code:g} cannot be drawn: {error}") from error

    def _draw(self, time_code: float, scale: float) -> Trio:
        points = [scene.points(time_code) for scene in self._scenes]
        axes = Axes.of(VIEW)
        everything = np.concatenate([part for side in points for part in side])
        framing = frame_points(everything, axes, self._size[0] / self._size[1])
        seen = []
        for painter, side, scene in zip(self._painters, points, self._scenes, strict=True):
            painter.paint(scene.vertex_colors(time_code))
            seen.append(painter.shoot(side, VIEW, self._size, scene.particles(time_code), framing).picture)
        apart = self.distances(time_code)
        colors = [None if rows is None else linear(ramp(rows / scale)) for rows in apart]
        self._ramped.paint(colors)
        seen.append(self._ramped.shoot(points[1], VIEW, self._size, framing=framing).picture)
        place, distance = self._farthest(framing, points[1], apart)
        lone = any(rows is None for rows in apart)
        return Trio(time_code, (seen[0], seen[1], seen[2]), place, distance, lone)

    def _farthest(
        self, framing: Framing, points: list[NDArray[np.float32]], apart: list[Floats | None]
    ) -> tuple[tuple[float, float] | None, float]:
        """Return where on the picture the point is that moved farthest, and how far that was (m)."""
        known = [(rows.max(), number) for number, rows in enumerate(apart) if rows is not None]
        distance, number = max(known, default=(0.0, 0))
        rows = apart[number]
        if distance <= 0.0 or rows is None:
            return None, 0.0
        row = int(rows.argmax())
        place = points[number][row : row + 1]
        named = np.unique(self._scenes[1].meshes[number].corners)
        # A coarse cage lies off the smooth surface that is drawn.
        if row in named:
            smooth = self._surfaces[1][number].refine(points[number])
            place = smooth[np.searchsorted(named, [row])]
        x, y, _ = Lens(Axes.of(VIEW), framing, self._size).places(place)[0]
        return (float(x), float(y)), float(distance)
