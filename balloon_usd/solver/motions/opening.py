"""How a net opens: the way of its joints from where they are to their places, as hands turn it and shape it.

The middle of its joints stays where it is. The net is turned as a whole, along the shortest way; while it is,
every joint goes straight to its place in it, and its sides keep their lengths. Where that leads bubbles
through each other, as in a chain that has curled up, hands unfold it instead.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from balloon_usd.solver.motions.unfolding import ONE_JOINT, along_sides, clearance, unfolded
from balloon_usd.solver.rotations import rotation, rotation_onto

if TYPE_CHECKING:
    from collections.abc import Sequence

Floats = NDArray[np.float64]

WAYPOINTS = 13
"""Poses from the first to the last; hands go straight from one to the next."""
CORRECTIONS = 30
"""Corrections of the lengths of the sides at each of them."""
NARROW = 0.5
"""Widths of a bubble that the middles of two may come near to each other on a straight way."""
FITS = 30
"""Steps in which the net is laid over what there is of it."""
NEAR = 0.01
"""Distance below which a joint is where it belongs, m."""
DIRECTIONS = 400
"""Directions tried for what is left of the balloon."""
ONWARD = 0.6
"""Weight of the way on beside that of the gap, as cosines."""
UNTURNED = 0.4
"""Weight of the way along which nothing need be turned, as cosines."""
BLOCKED = 2.0
"""Weight of bubbles in the way of what is left of the balloon, in widths of it."""
REST = np.linspace(0.025, 0.25, 9)
"""Distances at which that is looked at, m."""
MIRRORED = np.array([1.0, 1.0, -1.0])


def opening_path(
    began: Floats, places: Floats, sides: Sequence[tuple[int, int]], onward: Floats | None, width: float
) -> Floats:
    """Return the way of the joints, (WAYPOINTS, N, 3), m.

    Args:
        began: where they are, (N, 3), m.
        places: where they lie in the net, (N, 3), m, turned or mirrored in any way.
        sides: pairs of joints that keep their distance.
        onward: where the joint that follows the last one will lie in the net, (3,), m; the net is turned so
            that what is left of the balloon, along x, leaves it through a wide gap not far from there. None
            where nothing is left.
        width: of its bubbles, m.
    """
    here, shape = began - began[-1], places - places[-1]
    ahead = np.zeros(3) if onward is None else onward - places[-1]
    # Neither a net nor its mirror image is the right one before it is rigid.
    fits = [(mirror, *fit(shape * mirror, here)) for mirror in (np.ones(3), MIRRORED)]
    mirror, turned, _ = min(fits, key=lambda each: each[2])
    shape, ahead = shape * mirror @ turned.T, ahead * mirror @ turned.T
    pairs = np.array(sides, dtype=np.int64).reshape(-1, 2)
    turn = np.zeros(3) if onward is None else half_turn_vector(_aim(shape, ahead, here, pairs, width))
    way = _way(here, shape, pairs, width)
    shares = np.linspace(0.0, 1.0, WAYPOINTS)
    poses = np.array([pose @ rotation(share * turn).T for pose, share in zip(way, shares, strict=True)])
    return np.asarray(began.mean(axis=0) + poses - poses.mean(axis=1, keepdims=True))


def _way(here: Floats, shape: Floats, pairs: NDArray[np.int64], width: float) -> Floats:
    """Return poses of the joints, the last one at the origin, (WAYPOINTS, N, 3), m: straight, or where that
    is narrow and there is a wider way, unfolded.
    """
    straight = _straight_way(here, shape, pairs)
    room = clearance(straight, shape, pairs)
    if room >= NARROW * width:
        return straight
    unfolding = _evenly(_along_sides(unfolded(here, shape, width, WAYPOINTS), shape, pairs))
    return unfolding if clearance(unfolding, shape, pairs) > room else straight


def _straight_way(here: Floats, shape: Floats, pairs: NDArray[np.int64]) -> Floats:
    """Return poses between which every joint goes straight to its place, (WAYPOINTS, N, 3), m."""
    shares = np.linspace(0.0, 1.0, WAYPOINTS)[:, None, None]
    return _along_sides(here + shares * (shape - here), shape, pairs)


def _along_sides(poses: Floats, shape: Floats, pairs: NDArray[np.int64]) -> Floats:
    """Return poses near these in which sides change their lengths evenly from those of the first to those of
    a shape, (WAYPOINTS, N, 3), m.
    """
    before, after = _lengths(poses[0], pairs), _lengths(shape, pairs)
    shares = np.linspace(0.0, 1.0, len(poses))[1:]
    lengths = [before + share * (after - before) for share in shares]
    found = [_with_sides(pose, pairs, each) for pose, each in zip(poses[1:], lengths, strict=True)]
    return np.array([poses[0], *found])


def _evenly(poses: Floats) -> Floats:
    """Return as many poses on the same way, between which the joint that goes farthest goes equally far."""
    ways = np.linalg.norm(np.diff(poses, axis=0), axis=2).max(axis=1)
    gone = np.concatenate([[0.0], np.cumsum(ways)])
    at = np.interp(np.linspace(0.0, gone[-1], len(poses)), gone, np.arange(len(poses)))
    k = np.minimum(at.astype(np.int64), len(poses) - 2)
    return np.asarray(poses[k] + (at - k)[:, None, None] * (poses[k + 1] - poses[k]))


def fit(shape: Floats, here: Floats) -> tuple[Floats, float]:
    """Return the rotation that brings most of some places near to others, (3, 3), and the sum of the
    distances that stay, m: new joints, far off the net, must not turn it.

    Rotations of weighted places (Kabsch 1976), the weights falling with the distance (Weiszfeld 1937).
    """
    weight, turned, far = np.ones(len(shape)), np.eye(3), np.zeros(len(shape))
    for _ in range(FITS):
        one, other = (places - np.average(places, axis=0, weights=weight) for places in (shape, here))
        turned = rotation_onto(weight[:, None] * other, one)
        far = np.linalg.norm(one @ turned.T - other, axis=1)
        weight = 1.0 / np.maximum(far, NEAR)
    return turned, float(far.sum())


def _aim(shape: Floats, ahead: Floats, here: Floats, pairs: NDArray[np.int64], width: float) -> Floats:
    """Return the rotation after which the x axis leaves the last joint through a wide gap of the net, and not
    against where it goes on.
    """
    k = np.arange(DIRECTIONS)
    height = 1.0 - (2.0 * k + 1.0) / DIRECTIONS
    turned, level = math.pi * (3.0 - math.sqrt(5.0)) * k, np.sqrt(1.0 - height**2)
    ways = np.stack([level * np.cos(turned), level * np.sin(turned), height], axis=1)
    net = np.concatenate([shape, 0.5 * (shape[pairs[:, 0]] + shape[pairs[:, 1]])])
    far = np.linalg.norm(net, axis=1)
    others = net[far > ONE_JOINT] / far[far > ONE_JOINT, None]
    onward = ONWARD * (ways @ ahead) / max(float(np.linalg.norm(ahead)), 1e-9)
    # What is more than a quarter of a turn off is out of the way.
    near = (ways @ others.T).max(axis=1, initial=0.0) + BLOCKED * _blocked(ways, shape, pairs, width)
    way = ways[np.argmin(near - onward - UNTURNED * ways[:, 0])]
    forward = _turning(way, np.array([1.0, 0.0, 0.0]))
    _, y, z = (shape @ forward.T).T
    spin = math.atan2(float(y @ here[:, 2] - z @ here[:, 1]), float(y @ here[:, 1] + z @ here[:, 2]))
    return rotation(np.array([spin, 0.0, 0.0])) @ forward


def _blocked(ways: Floats, shape: Floats, pairs: NDArray[np.int64], width: float) -> Floats:
    """Return how far what is left of the balloon would lie in bubbles that do not end at its joint, in
    widths, for some directions of it (D, 3): (D,), from 0 to 1.
    """
    beside = pairs[(np.linalg.norm(shape[pairs], axis=2) > ONE_JOINT).all(axis=1)]
    bubbles = along_sides(shape, beside).reshape(-1, 3)
    rest = ways[:, None] * REST[:, None]
    far = np.linalg.norm(rest[:, :, None] - bubbles, axis=3).min(axis=(1, 2), initial=width)
    return np.asarray(1.0 - far / width)


def _turning(one: Floats, other: Floats) -> Floats:
    """Return the smallest rotation of one unit vector to another, (3, 3)."""
    axis = np.cross(one, other)
    sine = float(np.linalg.norm(axis))
    if sine < 1e-9:
        axis, sine = np.array([0.0, 0.0, 1.0]), 1.0 if one @ other < 0.0 else 0.0
        return rotation(math.pi * sine * axis)
    return rotation(axis * (math.atan2(sine, float(one @ other)) / sine))


def half_turn_vector(matrix: Floats) -> Floats:
    """Return the vector of a rotation by up to half a turn, (3,), rad."""
    angle = math.acos(min(max(0.5 * (float(np.trace(matrix)) - 1.0), -1.0), 1.0))
    axis = np.linalg.svd(matrix - np.eye(3))[2][-1]
    twice = np.array([matrix[2, 1] - matrix[1, 2], matrix[0, 2] - matrix[2, 0], matrix[1, 0] - matrix[0, 1]])
    return np.asarray(axis * (angle if float(twice @ axis) >= 0.0 else -angle))


def _lengths(places: Floats, pairs: NDArray[np.int64]) -> Floats:
    return np.asarray(np.linalg.norm(places[pairs[:, 0]] - places[pairs[:, 1]], axis=1))


def _with_sides(places: Floats, pairs: NDArray[np.int64], lengths: Floats) -> Floats:
    """Return places near these whose pairs have about these distances, the last one at the origin."""
    count = len(places)
    ends = np.eye(count)[pairs[:, 0]] - np.eye(count)[pairs[:, 1]]
    shares = ends.T / np.maximum(np.abs(ends).sum(axis=0), 1.0)[:, None]
    found = places
    for _ in range(CORRECTIONS):
        apart = ends @ found
        far = np.sqrt((apart * apart).sum(axis=1))
        found = found + shares @ ((0.5 * (lengths / np.maximum(far, 1e-9) - 1.0))[:, None] * apart)
    return np.asarray(found - found[-1])
