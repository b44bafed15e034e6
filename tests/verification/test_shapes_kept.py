"""V28: folds, loops and ears stay what they are when the hands let go, and come to rest."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

ONE = """
format: 1
name: one
units: cm
balloons:
  main: {size: 260, length: LONG, tail: 6}
steps:
  - bubbles: {before: 9}
  - KIND: {it: LENGTH}
    point: up
  - rest: beyond
physics: {hold: 2}
"""
CALM = 2.0e-3
"""Largest speed in the last half second, m/s."""


class Shown:
    """A finished figure of one bubble of a kind between two others, in the frames after the hands let go."""

    def __init__(self, kind, length):
        text = ONE.replace("KIND", kind).replace("LENGTH", str(length)).replace("LONG", str(22 + length))
        self.plan = plan(Recipe.parse(text))
        simulation = simulate_many([self.plan], detail="draft", device="cpu")
        self.mesh, self.fps = simulation.meshes[0][0], simulation.fps
        frames = [frame for (frame,) in simulation.frames()]
        self.points = np.array([f.points[0] for f in frames if f.doing == "hold"], dtype=float)
        self.width = 2.0 * self.plan.strips["main"].inflated_radius

    def place(self, bubble, share):
        """Middle of the ring at a share of a bubble's length in the last frame, m."""
        return self.ring(bubble, share).mean(axis=0)

    def ring(self, bubble, share):
        """Vertices of that ring, (around, 3) m."""
        planned = next(b for b in self.plan.bubbles if b.name == bubble)
        along = planned.rest_start + share * planned.rest_length
        first = self.mesh.ring_start[int(np.abs(self.mesh.ring_along - along).argmin())]
        return self.points[-1, first : first + self.mesh.around]

    @property
    def apart(self):
        """Distance between the middles of both halves, in widths of the tube."""
        return float(np.linalg.norm(self.place("it", 0.25) - self.place("it", 0.75))) / self.width

    @property
    def out(self):
        """How far the bubble stands out, to the side that it points to, in widths of the tube."""
        return float((self.place("it", 0.5) - self.ends)[2]) / self.width

    @property
    def aside(self):
        """How far its middle is to the side of where it points to, across the balloon, in widths of the tube."""
        return abs(float((self.place("it", 0.5) - self.ends)[1])) / self.width

    @property
    def ends(self):
        """Where the bubble's two ends meet, m."""
        return 0.5 * (self.place("it", 0.0) + self.place("it", 1.0))

    @property
    def height(self):
        """How far the bubble reaches out of where its ends meet, in how wide it is along the balloon, cut there."""
        planned = next(b for b in self.plan.bubbles if b.name == "it")
        inside = (self.mesh.along > planned.rest_start) & (self.mesh.along < planned.rest_end)
        points = self.points[-1, inside] - self.ends
        along = self.place("before", 0.5) - self.place("beyond", 0.5)
        along /= np.linalg.norm(along)
        out = self.ring("it", 0.5).mean(axis=0) - self.ends
        out -= (out @ along) * along
        out /= np.linalg.norm(out)
        cut = points[np.abs(points @ np.cross(along, out)) < 0.15 * self.width]
        return float((cut @ out).max() / np.ptp(cut @ along))

    @property
    def corner(self):
        """Angle between the bubbles before and beyond, degrees."""
        before = self.place("before", 0.0) - self.place("it", 0.0)
        beyond = self.place("beyond", 0.5) - self.place("it", 1.0)
        cosine = before @ beyond / (np.linalg.norm(before) * np.linalg.norm(beyond))
        return float(np.degrees(np.arccos(cosine)))

    @property
    def fastest(self):
        """Largest speed of a vertex in the last half second, m/s."""
        last = self.points[-round(0.5 * self.fps) - 1 :]
        return float(np.linalg.norm(np.diff(last, axis=0), axis=2).max()) * self.fps


@cache
def shown(kind, length):
    return Shown(kind, length)


@pytest.mark.parametrize("length", [20, pytest.param(30, marks=pytest.mark.long)])
def test_the_halves_of_a_fold_lie_side_by_side(verify, length):
    verify("V28", f"fold of {length} cm, halves apart, in widths", shown("fold", length).apart, 1.08, 0.1)


def test_a_loop_as_long_is_an_open_ring():
    assert shown("loop", 30).apart > 1.4


def test_an_ear_is_a_bean_beside_its_balloon_and_no_disc_within_it(verify):
    ear = shown("ear", 5)
    # Its ends meet in a point, its wall is a drop: 1 as a circle, 1.21 with a right angle at the point. What goes
    # through itself or lies within its balloon is not as high.
    verify("V28", "ear of 5 cm, its height in its width", ear.height, 1.1, 0.2)
    assert ear.out > 0.2


def test_a_longer_ear_stands_out_farther_and_straight():
    ears = [shown("ear", length) for length in (5, 5.5, 6)]
    outs = [ear.out for ear in ears]
    assert outs == sorted(outs)
    # In preview 0.20, 0.20 and 0.37.
    assert outs[0] > 0.18
    assert outs[2] > 0.35
    assert all(ear.aside < 0.1 for ear in ears)


def test_the_neighbours_of_an_ear_bend_towards_each_other():
    assert shown("ear", 5).corner < 170.0
    assert shown("loop", 30).corner > 150.0


@pytest.mark.parametrize(("kind", "length"), [("fold", 20), ("fold", 30), ("loop", 30), ("ear", 5)])
def test_it_is_at_rest_in_the_end(kind, length):
    fastest = shown(kind, length).fastest
    assert fastest < CALM, f"{fastest * 1e3:.1f} mm/s"
