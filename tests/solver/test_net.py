"""The net of springs: who is tied to whom, and that it rests under the pressure it was made for."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from balloon_usd.balloon.capsule_mesh import capsule_mesh
from balloon_usd.balloon.tube_mesh import BalloonMesh
from balloon_usd.solver.kosaka.net import SLOTS, Net, edges_of, net_of, tension_of
from tests.solver import kosaka_reference as thesis

RADIUS = 0.0255
KS = 700.0
CAPSULES = {"experiment": (0.20, 32), "small": (0.08, 12)}
"""Length (m) and vertices round it."""


@dataclass(frozen=True)
class Taut:
    """A capsule whose net carries the pressure that it was made for, swollen as far as wanted."""

    mesh: BalloonMesh
    pressure: float
    pull: np.ndarray
    """Of the springs alone, by vertex, (V, 3)."""
    push: np.ndarray
    """Pressure times the area of every vertex before swelling, (V, 3)."""

    @property
    def rings(self) -> np.ndarray:
        """Vertices of the rings of the cylinder, (R, around)."""
        rings = self.mesh.ring_start[:, None] + np.arange(self.mesh.around)
        along = self.mesh.points[rings[:, 0], 0]
        return rings[(along > RADIUS + 1e-6) & (along < self.mesh.points[:, 0].max() - RADIUS - 1e-6)]


def capsule(name: str) -> BalloonMesh:
    length, around = CAPSULES[name]
    return capsule_mesh(length, RADIUS, around, (length,))


def taut(name: str, natural: float, swell: float) -> Taut:
    mesh = capsule(name)
    x = mesh.points.astype(float)
    tension = tension_of(mesh, x)
    pressure = tension.pressure_for(natural, swell, KS)
    lengths = tension.natural_lengths(pressure, swell, KS)
    still, alike = np.zeros_like(x), np.ones(len(lengths))
    pull = thesis.spring_sum(tension.edges, lengths, (1.0 + swell) * x, still, KS * alike, 0.0 * alike)
    return Taut(mesh, pressure, pull, pressure * areas(mesh, x))


def areas(mesh: BalloonMesh, x: np.ndarray) -> np.ndarray:
    """Vector area of every vertex: a third of its triangles', (V, 3) m2."""
    triangles = thesis.triangles_of(mesh.quads)
    a, b, c = np.moveaxis(x[triangles], 1, 0)
    total = np.zeros_like(x)
    np.add.at(total, triangles, (np.cross(b - a, c - a) / 6.0)[:, None])
    return total


def slots_of(net: Net, p: int) -> dict[int, float]:
    """Other ends of the springs at a vertex, and their natural lengths."""
    return {int(q): float(size) for q, size in zip(net.ends[p], net.natural[p], strict=True) if q >= 0}


@pytest.mark.parametrize("name", CAPSULES)
def test_every_edge_of_a_capsule_is_there_once(name):
    mesh = capsule(name)
    edges = edges_of(mesh.quads)
    # A closed surface of quads has twice as many edges as faces.
    assert len(edges) == 2 * len(mesh.quads)
    assert len({frozenset(edge) for edge in edges.tolist()}) == len(edges)
    wanted = {frozenset((int(q[k]), int(q[k - 1]))) for q in mesh.quads for k in range(4)}
    assert {frozenset(edge) for edge in edges.tolist()} == wanted


@pytest.mark.parametrize("name", CAPSULES)
def test_a_spring_is_listed_alike_at_both_of_its_ends(name):
    mesh = capsule(name)
    edges = edges_of(mesh.quads)
    natural = np.random.default_rng(61).uniform(0.5, 2.0, len(edges))
    net = net_of(edges, natural, len(mesh.points))
    found = {(p, q): size for p in range(len(mesh.points)) for q, size in slots_of(net, p).items()}
    wanted = {(int(p), int(q)): size for (p, q), size in zip(edges, natural, strict=True)}
    wanted |= {(q, p): size for (p, q), size in wanted.items()}
    assert found == wanted


def test_slots_without_a_spring_come_last_and_have_some_length():
    net = net_of(np.array([[0, 1], [1, 2]], dtype=np.int32), np.array([0.5, 0.25]), 4)
    assert net.ends.tolist() == [[1, -1, -1, -1], [0, 2, -1, -1], [1, -1, -1, -1], [-1, -1, -1, -1]]
    assert (net.natural > 0.0).all()


def test_more_springs_at_a_vertex_than_there_are_slots_are_refused():
    edges = np.array([[0, k] for k in range(1, SLOTS + 2)], dtype=np.int32)
    with pytest.raises(ValueError, match="at most 4"):
        net_of(edges, np.ones(len(edges)), SLOTS + 2)


@pytest.mark.parametrize("swell", [0.0, 0.03, 0.1])
@pytest.mark.parametrize("name", CAPSULES)
def test_every_ring_of_the_cylinder_rests_under_the_pressure(name, swell):
    t = taut(name, natural=0.5, swell=swell)
    out = t.mesh.points * [0.0, 1.0, 1.0] / RADIUS
    assert len(t.rings) > 2
    for ring in t.rings:
        outward = thesis.dot(t.push[ring], out[ring]).sum()
        assert thesis.dot(t.pull[ring], out[ring]).sum() == pytest.approx(-outward, rel=0.05)
        assert abs(t.pull[ring, 0].sum()) < 0.05 * outward


def test_the_cylinder_far_from_its_ends_rests_to_within_a_percent():
    t = taut("experiment", natural=0.5, swell=0.03)
    for ring in t.rings[4:-4]:
        assert (
            np.linalg.norm((t.pull + t.push)[ring], axis=1).max()
            < 0.01 * np.linalg.norm(t.push[ring], axis=1).min()
        )


@pytest.mark.parametrize("name", CAPSULES)
def test_what_the_springs_along_the_tube_carry_is_the_pressure_on_its_ends(name):
    mesh = capsule(name)
    tension = tension_of(mesh, mesh.points.astype(float))
    middle = 0.5 * mesh.points[:, 0].max()
    first, second = (mesh.points[tension.edges[:, k], 0] for k in range(2))
    cut = (np.minimum(first, second) < middle) & (np.maximum(first, second) >= middle)
    assert tension.load[cut].sum() == pytest.approx(np.pi * RADIUS**2, rel=0.05)


@pytest.mark.parametrize("name", CAPSULES)
def test_springs_round_the_tube_are_naturally_as_short_as_asked_for(name):
    mesh = capsule(name)
    tension = tension_of(mesh, mesh.points.astype(float))
    lengths = tension.natural_lengths(tension.pressure_for(0.5, 0.03, KS), 0.03, KS)
    around = tension.wide & tension.around
    assert np.median(lengths[around] / tension.length[around]) == pytest.approx(0.5)
    assert (lengths > 0.0).all()


def test_a_stiffer_net_is_made_for_more_pressure():
    mesh = capsule("small")
    tension = tension_of(mesh, mesh.points.astype(float))
    assert tension.pressure_for(0.5, 0.03, 2.0 * KS) == pytest.approx(
        2.0 * tension.pressure_for(0.5, 0.03, KS)
    )
    assert tension.pressure_for(0.5, 0.1, KS) > tension.pressure_for(0.5, 0.03, KS)
