"""What is in the way of tubes that are led into a net: how far they would lie in others."""

from __future__ import annotations

from typing import NamedTuple, Self

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

ALONG_SIDE = np.linspace(0.0, 1.0, 7)
"""Places along a bubble that are looked at, as shares."""
REST_LENGTH = 0.25
"""How much of what is left of a balloon is looked at, m."""
ALONG_REST = np.linspace(0.1, 1.0, 9)
"""Places along that, as shares."""
ONE_CORNER = 1e-6
"""Distance of places in a net below which joints are one, m."""


class Tubes(NamedTuple):
    """Bubbles of a net, of which some are led into it past the others."""

    moving: Ints
    """Joints at the ends of those that are led, (M, 2)."""
    still: Ints
    """The same of the others, (S, 2)."""
    beside: NDArray[np.bool_]
    """Whether a led one and another have no joint in common, (M, S)."""
    beside_rest: NDArray[np.bool_]
    """Whether one of the others does not end where the rest of a balloon begins, (S,)."""

    @classmethod
    def of(cls, places: Floats, pairs: Ints, moved: NDArray[np.bool_]) -> Self:
        """Return the tubes of a net.

        Args:
            places: where its joints lie in it, (N, 3), m; the rest of a balloon begins at the last one.
            pairs: joints at the ends of its bubbles, (P, 2).
            moved: joints that are led into it, (N,).
        """
        one = np.linalg.norm(places[:, None] - places, axis=2) < ONE_CORNER
        led = moved[pairs].any(axis=1)
        moving, still = pairs[led], pairs[~led]
        touching = one[moving[:, :, None, None], still[None, None]].any(axis=(1, 3))
        return cls(moving, still, ~touching, ~one[still, len(places) - 1].any(axis=1))

    def overlap(self, poses: Floats, width: float, rest: Floats | None) -> float:
        """Return how far tubes of a width (m) would lie in each other, in widths, summed over poses of the
        joints, (W, N, 3), m.

        `rest`: unit direction of the rest of a balloon, (3,); None where there is none.
        """
        others = _points(poses, self.still)
        total = _overlap(_points(poses, self.moving), others, self.beside, width)
        if rest is not None:
            points = poses[:, -1:, None] + REST_LENGTH * ALONG_REST[:, None] * rest
            total += _overlap(points, others, self.beside_rest[None], width)
        return total


def blocked(ways: Floats, places: Floats, pairs: Ints, width: float) -> Floats:
    """Return how far the rest of a balloon would lie in bubbles of a net, in widths, for some directions of
    it, (D, 3) unit: (D,), from 0 to 1.

    `places`: of the joints, (N, 3), m, the one where it begins, the last, at the origin.
    """
    ends = (np.linalg.norm(places[pairs], axis=2) < ONE_CORNER).any(axis=1)
    others = _points(places[None], pairs[~ends])[0].reshape(-1, 3)
    if not len(others):
        return np.zeros(len(ways))
    points = REST_LENGTH * ways[:, None] * ALONG_REST[:, None]
    far = np.linalg.norm(points[:, :, None] - others, axis=3).min(axis=(1, 2))
    return np.asarray(np.maximum(1.0 - far / width, 0.0))


def _points(poses: Floats, pairs: Ints) -> Floats:
    """Return points along the bubbles between pairs of joints, (W, pairs, points, 3), m."""
    first, second = poses[:, pairs[:, 0], None], poses[:, pairs[:, 1], None]
    return np.asarray(first + ALONG_SIDE[:, None] * (second - first))


def _overlap(points: Floats, others: Floats, counts: NDArray[np.bool_], width: float) -> float:
    """Return the overlap of all tubes with all others, where a pair counts."""
    total = 0.0
    for one in range(points.shape[1]):
        chosen = others[:, counts[one]]
        if chosen.shape[1]:
            apart = points[:, one, None, :, None] - chosen[:, :, None]
            far = np.linalg.norm(apart, axis=4).min(axis=(2, 3))
            total += float(np.maximum(1.0 - far / width, 0.0).sum())
    return total
