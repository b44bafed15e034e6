"""`tulip_link`: the end of a balloon in the tulip of another, whose gas presses on it from all sides."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.operations.tulip_link import TulipLink
from balloon_usd.plan import plan
from balloon_usd.quality.crossing_counter import CrossingCounter
from balloon_usd.quality.ring_corners import RingCorners
from balloon_usd.quality.wall_rings import WallRings
from balloon_usd.quality.walls import walls_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.simulation import simulate_many

EVERY = 4
"""Frames from one count of crossings to the next."""
HELD = "physics: {hold: 2}\n"
CANDLE = TulipLink.example.replace(
    "  - rest: flame", "  - bubbles: {root: 3}\n    balloon: fire\n  - rest: flame"
)
CANDLE = CANDLE.replace("over: flame", "over: root")
FIRE = "  fire: {size: 160, color: orange, length: 7, tail: 2.5}\n"


class Linked:
    """A link that is run: the last frame, and crossings of some frames."""

    def __init__(self, text):
        self.plan = plan(Recipe.parse(text))
        simulation = simulate_many([self.plan], device="cpu")
        (meshes,) = simulation.meshes
        self._meshes = meshes
        counter = CrossingCounter(walls_of(self.plan, meshes), 100)
        self.crossings = 0
        for (frame,) in simulation.frames():
            if frame.time_code % EVERY == 0:
                self.crossings += counter.count(frame.points).count
        self._frame = frame
        names = [bubble.name for bubble in self.plan.bubbles]
        self.pressure = dict(zip(names, frame.pressure.astype(float), strict=True))
        gas = (ATMOSPHERE + frame.pressure.astype(float)) * frame.volume
        self.gas = dict(zip(names, gas, strict=True))

    def walls(self, bubble):
        """Vertices of the rings between the ends of a bubble, (N, 3), m."""
        one = next(each for each in self.plan.bubbles if each.name == bubble)
        return WallRings.of(self.plan, self._meshes, one).corners(self._frame).reshape(-1, 3)

    def middle(self, bubble):
        return self.walls(bubble).mean(axis=0)

    def joint(self, ring):
        """Middle of a ring of the plan, by its name, (3,), m."""
        at = next(k for k, each in enumerate(self.plan.table.rings) if each.name == ring)
        return RingCorners.of(self.plan, self._meshes, at).places(self._frame).mean(axis=0)

    @property
    def onward(self):
        """Unit direction from the stick of the candle to its flame."""
        way = self.joint("socket.end") - self.middle("wax")
        return way / np.linalg.norm(way)

    @property
    def inside(self):
        """Share of the length of the root that lies behind the rim of its socket."""
        rim = (self.walls("socket") @ self.onward).max()
        start, end = (self.joint(ring) @ self.onward for ring in ("fire.knot", "root.end"))
        return float((rim - start) / (end - start))


@pytest.fixture(scope="module")
def candle():
    return Linked(CANDLE + HELD)


def test_both_knots_lie_at_the_neck_behind_the_tulip(candle):
    neck = candle.joint("socket.end")
    assert np.linalg.norm(candle.joint("main.knot") - neck) < 0.006
    assert np.linalg.norm(candle.joint("fire.knot") - neck) < 0.006


def test_the_root_sits_in_its_socket_and_the_flame_stands_on_it_in_one_line_with_the_candle(candle):
    assert 0.6 < candle.inside < 1.0
    flame = candle.middle("flame") - candle.joint("socket.end")
    assert flame @ candle.onward > 0.99 * np.linalg.norm(flame)
    around = candle.walls("socket") - candle.joint("socket.end")
    across = around - np.outer(around @ candle.onward, candle.onward)
    assert 0.05 < 2.0 * np.linalg.norm(across, axis=1).max() < 0.07


def test_no_wall_goes_through_another_on_the_way_in_or_afterwards(candle):
    assert candle.crossings == 0


def test_the_tulip_keeps_its_gas_and_is_harder_than_its_tube(candle):
    planned = {bubble.name: bubble for bubble in candle.plan.bubbles}
    gas = (ATMOSPHERE + planned["socket"].pressure) * planned["socket"].volume
    assert candle.gas["socket"] == pytest.approx(gas, rel=0.03)
    tube = planned["wax"].pressure
    assert tube + 2000.0 < candle.pressure["socket"] < tube + 5000.0


def test_the_twist_behind_the_root_unwinds_outside(candle):
    assert candle.pressure["root"] == pytest.approx(candle.pressure["flame"], rel=1e-3)


def test_the_candle_is_pressed_over_the_flame_where_that_is_the_figure():
    fire, rest = FIRE, CANDLE.replace(FIRE, "")
    swapped = Linked(rest.replace("balloons:\n", f"balloons:\n{fire}") + HELD)
    assert swapped.crossings == 0
    assert swapped.inside > 0.6
    assert np.linalg.norm(swapped.joint("fire.knot") - swapped.joint("socket.end")) < 0.006


def test_with_one_turn_the_gas_pushes_the_root_out():
    loose = CANDLE.replace("over: root}\n    balloon: main", "over: root}\n    balloon: main\n    turns: 1")
    slipped = Linked(loose)
    assert slipped.inside < 0.1
    assert np.linalg.norm(slipped.joint("fire.knot") - slipped.joint("socket.end")) > 0.03
    assert slipped.crossings == 0
