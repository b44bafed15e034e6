"""Equations 3.1 to 3.23 of Kosaka 2008 in plain NumPy float64, written from the formulas of the thesis.

Every equation is one function over arrays whose last axis is space; sums over neighbours, triangles and springs
try all pairs there are. What the model adds to the thesis stands at the end.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Ints = NDArray[np.int32]
Bools = NDArray[np.bool_]


def dot(a: Floats, b: Floats) -> Floats:
    return np.einsum("...i,...i->...", a, b)


def length(a: Floats) -> Floats:
    return np.sqrt(dot(a, a))


# Rubber on rubber: springs.


def spring_force(x1, x2, v1, v2, natural, ks, kd) -> Floats:
    """Eq. 3.1: the force of a spring on its second end."""
    n = spring_direction(x1, x2)
    size = ks * (length(x1 - x2) - natural) + kd * dot(v1 - v2, n)
    return size[..., None] * n


def spring_direction(x1, x2) -> Floats:
    """Eq. 3.2."""
    return (x1 - x2) / length(x1 - x2)[..., None]


def spring_sum(edges, natural, x, v, ks, kd) -> Floats:
    """Eq. 3.19: H_p of every vertex, (V, 3); `natural`, `ks` and `kd` by edge, (E,)."""
    total = np.zeros_like(x)
    for q, p in (edges.T, edges.T[::-1]):
        np.add.at(total, p, spring_force(x[q], x[p], v[q], v[p], natural, ks, kd))
    return total


# Air on air: repulsion.


def weight(r, re) -> Floats:
    """Eq. 3.3."""
    return np.where(r <= re, re / r - 1.0, 0.0)


def repulsion(ri, rj, alpha, re) -> Floats:
    """Eq. 3.4: the force of particle j on particle i."""
    return -alpha * (rj - ri) * weight(length(rj - ri), re)[..., None]


def repulsion_sum(a: int, air, others, alpha, re) -> Floats:
    """Eq. 3.16: C_a of one particle among some others, (3,)."""
    return repulsion(air[a], air[others], alpha, re).sum(axis=0)


# Air and rubber: planes, shares, forces.


def plane_point(u, v, w, a, b, c) -> Floats:
    """Eq. 3.5: the point of a triangle's plane with these shares."""
    return u[..., None] * a + v[..., None] * b + w[..., None] * c


def plane_normal(a, b, c) -> Floats:
    """Eq. 3.6."""
    n = np.cross(b - a, c - a)
    return n / length(n)[..., None]


def plane_distance(v, a, normal) -> Floats:
    """Eq. 3.7: positive in front, outside."""
    return dot(v - a, normal)


def projection(v, a, normal) -> Floats:
    """Eq. 3.8: V' on the plane."""
    return v - dot(normal, v - a)[..., None] * normal


def shares(on_plane, a, b, c) -> Floats:
    """Eq. 3.9 solved for u, v, w: a linear system in the two sides and the normal."""
    sides = np.stack([b - a, c - a, plane_normal(a, b, c)], axis=-1)
    at_b, at_c, _ = np.moveaxis(np.linalg.solve(sides, (on_plane - a)[..., None])[..., 0], -1, 0)
    return np.stack([1.0 - at_b - at_c, at_b, at_c], axis=-1)


def vertex_forces(uvw, normal) -> Floats:
    """Eq. 3.10: T_A, T_B, T_C, (..., 3, 3)."""
    return uvw[..., :, None] * normal[..., None, :]


def angle_weighted_mean(angles, forces) -> Floats:
    """Eq. 3.11: R_p of one vertex from what its triangles push it with, (N,) and (N, 3)."""
    return (angles[:, None] * forces).sum(axis=0) / angles.sum()


def wall_force(beta, normal) -> Floats:
    """Eq. 3.12: the force on a particle in a triangle's offset region."""
    return -beta * normal


def wall_force_sum(beta, normals) -> Floats:
    """Eq. 3.17: D_a of one particle from all triangles in whose regions it is."""
    return wall_force(beta, normals).sum(axis=0)


def moved_back(v, gamma, normal) -> Floats:
    """Eq. 3.13."""
    return v - gamma * normal


def leak_checked(r, gamma, normal, outside) -> Floats:
    """Eq. 3.18: every particle where it is, or moved back if it is outside."""
    return np.where(outside[..., None], moved_back(r, gamma, normal), r)


# Rubber contact.


def onto_wall(r, a, normal) -> Floats:
    """Eq. 3.14."""
    return r - dot(normal, r - a)[..., None] * normal


def wall_checked(x, a, normal, inside) -> Floats:
    """Eq. 3.15: every vertex where it is, or on the wall if it is inside."""
    return np.where(inside[..., None], onto_wall(x, a, normal), x)


# Motion.


def next_air_speed(u, c, d, dt) -> Floats:
    """Eq. 3.20."""
    return u + (c + d) * dt


def next_air(r, u_next, dt) -> Floats:
    """Eq. 3.21."""
    return r + u_next * dt


def next_rubber_speed(v, f, r, h, dt) -> Floats:
    """Eq. 3.22: f is what the user does, r the air's push, h the springs' pull."""
    return v + (f + r + h) * dt


def next_rubber(x, v_next, dt) -> Floats:
    """Eq. 3.23."""
    return x + v_next * dt


# What the equations are summed over.


def triangles_of(quads: Ints) -> Ints:
    """Every quad split by a diagonal: (2 Q, 3)."""
    return quads[:, [[0, 1, 2], [0, 2, 3]]].reshape(-1, 3)


def angles_of(triangles: Ints, x: Floats) -> Floats:
    """The angles of every triangle at its corners, (T, 3) radians."""
    p = x[triangles]
    d, e = np.roll(p, -1, axis=1) - p, np.roll(p, 1, axis=1) - p
    return np.arccos(dot(d, e) / (length(d) * length(e)))


def regions(triangles: Ints, x: Floats, points: Floats) -> tuple[Floats, Floats, Floats]:
    """Normal of every triangle (T, 3), and of every point over every triangle its distance from the plane (T, N)
    and its shares (T, N, 3): eqs. 3.6 to 3.9.
    """
    a, b, c = np.moveaxis(x[triangles], 1, 0)[:, :, None]
    normal = plane_normal(a, b, c)
    d = plane_distance(points[None], a, normal)
    return normal[:, 0], d, shares(projection(points[None], a, normal), a, b, c)


def pushes(triangles: Ints, angles: Floats, normal: Floats, push: Floats, uvw: Floats) -> Floats:
    """Eqs. 3.10 and 3.11: R_p of every vertex, (V, 3); `push` (T, N) is how hard each particle pushes on each
    triangle, nothing where it is not in its region.
    """
    forces = (push[..., None, None] * vertex_forces(uvw, normal[:, None])).sum(axis=1)
    corners = [np.nonzero(triangles == p) for p in range(triangles.max() + 1)]
    return np.array([angle_weighted_mean(angles[at], forces[at]) for at in corners])


def leaked(d: Floats, within: Bools) -> tuple[Ints, Bools]:
    """The nearest triangle of every point among those in whose regions it is, and whether the point is in front
    of it; (T, N) -> (N,) each.
    """
    nearest = np.where(within, np.abs(d), np.inf).argmin(axis=0)
    here = np.arange(d.shape[1])
    return nearest, within[nearest, here] & (d[nearest, here] > 0.0)


# Drawing a ring together (3.6): the thesis says only that the force pulls to the mean and is limited.


def pinch_force(x, v, mean, radius, others, limit, dt) -> Floats:
    """The force f_p on the vertices of a ring that brings them to a radius about their mean within one step,
    against all other forces, or as much of it as is allowed.
    """
    d = mean - x
    far = length(d)[..., None]
    speed = np.maximum(far - radius, 0.0) / far * d / dt
    force = (speed - v) / dt - others
    return force * np.minimum(1.0, limit / length(force)[..., None])


# What the model adds to the thesis.


def grading(depth, beside, wider, share) -> Floats:
    """How much of its push a particle keeps in an offset region: all of it if `share` is 0.

    `depth`: 0 at the wall, 1 at the region's end. `beside`: smallest of u, v, w, down to -`wider`.
    """
    across = np.clip(0.5 + 0.5 * beside / wider, 0.0, 1.0)
    return 1.0 - share * (1.0 - lacking(depth) * across)


def lacking(depth) -> Floats:
    """What a particle lacks of its neighbours' repulsion behind a plane wall, as a share of what it lacks at it."""
    return (1.0 - depth) ** 3 * (1.0 + 3.0 * depth)


def drift(x, start, end, start_speed, end_speed) -> Floats:
    """How places of a bubble drift: as its ends do, and evenly from one to the other between them."""
    axis = end - start
    along = np.clip(dot(x - start, axis) / dot(axis, axis), 0.0, 1.0)[..., None]
    return (1.0 - along) * start_speed + along * end_speed


def stopped(v, normal, inside) -> Floats:
    """The speed of every vertex, without what would carry it further into the wall that it was put onto."""
    inward = np.minimum(dot(v, normal), 0.0)[..., None] * normal
    return np.where(inside[..., None], v - inward, v)


def calming_sum(edges, x, v, calming) -> Floats:
    """Damping of what the ends of springs move across them, (V, 3)."""
    total = np.zeros_like(x)
    for q, p in (edges.T, edges.T[::-1]):
        n = spring_direction(x[q], x[p])
        apart = v[q] - v[p]
        np.add.at(total, p, calming[:, None] * (apart - dot(apart, n)[:, None] * n))
    return total


def shortening(edges, x, longest, share, held) -> Floats:
    """How far vertices move when the ends of springs that are too long each take back a share of the excess, (V, 3).

    What a hand holds does not move, `held` (V,) bool: then the other end takes all of it.
    """
    total = np.zeros_like(x)
    for q, p in (edges.T, edges.T[::-1]):
        d = x[q] - x[p]
        size = length(d)
        excess = np.maximum(size - longest, 0.0)
        np.add.at(total, p, (np.where(held[q], 1.0, share) * excess / size)[:, None] * d)
    total[held] = 0.0
    return total
