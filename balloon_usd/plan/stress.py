"""Stress of places: how far their distances are from those that are wanted (de Leeuw 1977)."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def majorize(places: Floats, wanted: Floats, weights: Floats, rounds: int) -> Floats:
    """Return places of less stress, (N, 3): each round is the minimum of a bound (Guttman's transform).

    Args:
        places: to begin with, (N, 3), m.
        wanted: their distances, (N, N), m.
        weights: what each distance counts, (N, N), 0 on the diagonal.
        rounds: how often.
    """
    inverse = np.linalg.pinv(_laplacian(weights))
    for _ in range(rounds):
        places = inverse @ _laplacian(weights * wanted / np.maximum(distances(places), 1e-9)) @ places
    return places


def distances(places: Floats) -> Floats:
    """Return how far places (N, 3) lie from each other, (N, N), m."""
    return np.asarray(np.linalg.norm(places[:, None] - places, axis=2))


def _laplacian(weights: Floats) -> Floats:
    return np.asarray(np.diag(weights.sum(axis=1)) - weights)
