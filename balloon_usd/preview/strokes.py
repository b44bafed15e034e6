"""What a picture of wire and air is drawn with: lines and balls, paler the farther away they are."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    import numpy.typing as npt

    from balloon_usd.preview.cage import Cage
    from balloon_usd.preview.lens import Lens
    from balloon_usd.preview.particles import Particles
    from balloon_usd.preview.subdivide import Points

    Numbers32 = npt.NDArray[np.float32]

LINE = 1.15
"""Width of the nearest line in a picture of the usual height (pixels)."""
USUAL_HEIGHT = 320.0
"""Height of a picture in which lines are that wide (pixels); they grow with it."""
FAR_LINE = 0.72
"""Width of the farthest line, as a share of the nearest."""
FAR_OPACITY = 0.65
"""Opacity of the farthest line, as a share of the nearest."""
BEHIND_OPACITY = 0.40
"""Opacity of a line on the far side of its balloon, as a share of the near side."""
TURN = 0.3
"""Cosine to the eye within which a line passes from the near side to the far side."""
HAZE = 0.25
"""Share of paper in the colour of the farthest ball."""
NO_DEPTH = 1.0e-9
"""Depth of a sculpture that has none (m)."""
PAPER = (0.86, 0.87, 0.885)
"""Linear rgb of the backdrop's middle."""


@dataclass(frozen=True)
class Strokes:
    """Lines and balls on a picture (pixels, y down)."""

    ends: Numbers32
    """(S, 4) both ends; a ball has its middle twice."""
    reach: Numbers32
    """(S,) half the width of a line, radius of a ball."""
    paint: Numbers32
    """(S, 4) linear rgb and opacity."""
    is_ball: npt.NDArray[np.int32]
    """(S,) 1 for a ball."""
    depth: Numbers32
    """(S,) m."""

    @classmethod
    def by_depth(cls, parts: Sequence[Strokes]) -> Strokes:
        """Return the strokes of all parts, nearest first."""
        columns = [np.concatenate(rows) for rows in zip(*map(_columns, parts), strict=True)]
        order = np.argsort(columns[-1], kind="stable")
        return cls(*(column[order] for column in columns))

    @property
    def boxes(self) -> tuple[Points, Points]:
        """Opposite corners (S, 2) of the pixels that each stroke may touch."""
        both = self.ends.reshape(-1, 2, 2)
        reach = self.reach[:, None] + 1.0
        return both.min(axis=1) - reach, both.max(axis=1) + reach


def wire_strokes(
    lens: Lens, cage: Cage, used: Points, colors: Numbers32, depths: tuple[float, float]
) -> Strokes:
    """Return a line for each edge of a cage.

    Args:
        lens: through which it is seen.
        cage: the edges.
        used: (U, 3) points of the cage that its faces name (m, z up).
        colors: (E, 3) linear rgb of each edge.
        depths: of the nearest and the farthest point of the sculpture (m).
    """
    both = lens.places(used[cage.edges].reshape(-1, 3)).reshape(-1, 2, 3)
    depth = both[..., 2].mean(axis=1)
    far = _farness(depth, depths)
    middles = used[cage.edges].mean(axis=1)
    facing = np.sum(cage.edge_normals(used) * lens.towards(middles), axis=1)
    near_side = _smooth_step(-TURN, TURN, facing)
    opacity = _between(BEHIND_OPACITY, 1.0, near_side) * _between(1.0, FAR_OPACITY, far)
    half = 0.5 * LINE * lens.size[1] / USUAL_HEIGHT * _between(1.0, FAR_LINE, far)
    return Strokes(
        ends=both[..., :2].reshape(-1, 4),
        reach=half.astype(np.float32),
        paint=np.column_stack([colors, opacity]).astype(np.float32),
        is_ball=np.zeros(len(depth), dtype=np.int32),
        depth=depth,
    )


def ball_strokes(lens: Lens, balls: Particles, depths: tuple[float, float]) -> Strokes:
    """Return a ball for each particle; see `wire_strokes`."""
    places = lens.places(balls.centres)
    depth = places[:, 2]
    haze = HAZE * _farness(depth, depths)[:, None]
    colors = (1.0 - haze) * balls.colors + haze * np.array(PAPER)
    return Strokes(
        ends=np.tile(places[:, :2], 2),
        reach=lens.pixels(balls.radii, depth),
        paint=np.column_stack([colors, np.ones(len(depth))]).astype(np.float32),
        is_ball=np.ones(len(depth), dtype=np.int32),
        depth=depth,
    )


def _columns(strokes: Strokes) -> tuple[npt.NDArray[np.float32 | np.int32], ...]:
    return strokes.ends, strokes.reach, strokes.paint, strokes.is_ball, strokes.depth


def _farness(depth: Numbers32, depths: tuple[float, float]) -> Numbers32:
    """Return 0 at the nearest depth and 1 at the farthest."""
    near, far = depths
    return np.asarray(np.clip((depth - near) / max(far - near, NO_DEPTH), 0.0, 1.0), dtype=np.float32)


def _between(zero: float, one: float, share: Numbers32) -> Numbers32:
    return zero + (one - zero) * share


def _smooth_step(low: float, high: float, values: Numbers32) -> Numbers32:
    t = np.clip((values - low) / (high - low), 0.0, 1.0)
    return np.asarray(t * t * (3.0 - 2.0 * t))
