"""How a chain or net that is curled up unfolds: a way on which bubbles go past each other, not through.

Every distance between two joints changes evenly from what it is to what it will be, and near ones count most,
so that joints come hardly nearer to each other on the way than they are at one of its ends (elastic network
interpolation; Kim, Jernigan & Chirikjian 2002, Efficient generation of feasible pathways for protein
conformational transitions).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from balloon_usd.plan.stress import distances, majorize
from balloon_usd.solver.rotations import rotation_onto

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

ROUNDS = 60
"""Steps of majorization at each pose: a chain of 36 bubbles ends 27 mm off, with 200 of them 17 mm."""
NEAR_COUNT = 4
"""Power with which the weight of a distance falls with it."""
ONE_JOINT = 1e-6
"""Distance of places in a net below which joints are one, m."""
ALONG_SIDE = np.linspace(0.0, 1.0, 7)
"""Places along a bubble that are looked at, as shares."""


def unfolded(here: Floats, shape: Floats, width: float, count: int) -> Floats:
    """Return poses of joints on the way from where they are to their places, (count, N, 3), m.

    `here`, `shape`: (N, 3), m, the last joint at the origin; `width`: of bubbles, m, nearer than which no two
    joints count more.
    """
    begin, end = distances(here), distances(shape)
    poses = [here]
    for share in np.linspace(0.0, 1.0, count)[1:-1]:
        wanted = begin + share * (end - begin)
        weights = (width / np.maximum(wanted, width)) ** NEAR_COUNT
        np.fill_diagonal(weights, 0.0)
        pose = majorize(poses[-1], wanted, weights, ROUNDS)
        pose = _laid_over(pose, here + share * (shape - here))
        poses.append(pose - pose[-1])
    return np.array([*poses, shape])


def clearance(poses: Floats, shape: Floats, sides: Ints) -> float:
    """Return how near the middles of two bubbles come that share no joint, m; infinite where all do.

    `poses`: of joints, (P, N, 3), m, between which they go straight; `shape`: their places, (N, 3), m;
    `sides`: joints at both ends of every bubble, (sides, 2).
    """
    one_joint = distances(shape) < ONE_JOINT
    first, second = np.triu_indices(len(sides), 1)
    ends = one_joint[sides[first][:, :, None], sides[second][:, None, :]]
    apart = ~ends.any(axis=(1, 2))
    first, second = first[apart], second[apart]
    between = 0.5 * (poses[1:] + poses[:-1])
    nearest = np.inf
    for pose in (*poses, *between):
        along = along_sides(pose, sides)
        far = along[first][:, :, None] - along[second][:, None]
        nearest = min(nearest, float((far * far).sum(axis=3).min(initial=np.inf)))
    return float(np.sqrt(nearest))


def along_sides(places: Floats, sides: Ints) -> Floats:
    """Return places along the middles of bubbles, (sides, ALONG_SIDE, 3), m.

    `places`: of joints, (N, 3), m; `sides`: joints at both ends of every bubble, (sides, 2).
    """
    start, end = places[sides[:, :1]], places[sides[:, 1:]]
    return np.asarray(start + ALONG_SIDE[:, None] * (end - start))


def _laid_over(places: Floats, others: Floats) -> Floats:
    """Return places moved and turned as one so that they lie nearest to others, (N, 3), m."""
    one, other = places - places.mean(axis=0), others - others.mean(axis=0)
    return np.asarray(one @ rotation_onto(other, one).T + others.mean(axis=0))
