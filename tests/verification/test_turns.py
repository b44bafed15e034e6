"""V35: turns beyond those that pack a neck draw rubber in, and so each twist fills more of the flat tail."""

from __future__ import annotations

from functools import cache
from typing import Any, NamedTuple

import numpy as np
import pytest

from balloon_usd.balloon.bubble_shape import (
    tail_volume_per_rest_length,
    tube_volume_per_rest_length,
    twist_cost,
)
from balloon_usd.balloon.wound_neck import drawn_rubber
from balloon_usd.operations.moves import Pinch
from balloon_usd.plan import plan
from balloon_usd.plan.open_tube import softened
from balloon_usd.recipe import Recipe
from balloon_usd.solver.flat_tails import FlatTails
from balloon_usd.solver.simulation import simulate_many

ROW = """
format: 1
name: row
units: cm
fps: 12
balloons:
  main: {size: 260, length: LENGTH, tail: TAIL}
steps:
  - bubbles: {BUBBLES}
    turns: TURNS
  - wait: 0.5
physics: {hold: 0.1}
"""


class Row(NamedTuple):
    """A row of bubbles that were twisted off."""

    planned: Any
    tails: list[float]
    """Flat tail before every pinch, and when all are made, m."""
    rubber: list[float]
    """Rubber in the mesh before the first pinch, and when all are made, m3."""


@cache
def twisted(turns: float, bubbles: int, detail: str) -> Row:
    """Twist bubbles of 10 cm off with so many turns each."""
    text = ROW.replace("BUBBLES", ", ".join(f"b{k}: 10" for k in range(bubbles))).replace("TURNS", str(turns))
    text = text.replace("LENGTH", str(16 + 4 * bubbles)).replace("TAIL", str(4 + 1.6 * bubbles))
    planned = plan(Recipe.parse(text))
    simulation = simulate_many([planned], detail=detail, device="cpu")
    flat, left, rubber = FlatTails(planned, simulation.meshes[0]), [], []
    for (frame,) in simulation.frames():
        if frame.doing.startswith("loosen"):
            break
        left += flat.left(frame)
        rubber.append(float(simulation.model.scene.rubber_volume.numpy().sum(dtype=np.float64)))
    pinches = [move.start for move in planned.choreography.moves if isinstance(move, Pinch)]
    before = [round(start * planned.recipe.fps) for start in pinches]
    return Row(planned, [left[k] for k in (*before, -1)], [rubber[before[0]], rubber[-1]])


def tail_of_a_twist(planned: Any, turns: float) -> float:
    """Flat tail that a twist of so many turns fills, m."""
    strip = planned.strips["main"]
    size, rubber = strip.size, softened(strip.rubber)
    bulged, thin = tube_volume_per_rest_length(size, rubber), tail_volume_per_rest_length(size, rubber)
    return twist_cost(size, rubber) + drawn_rubber(size, rubber, turns) * bulged / (bulged - thin)


@pytest.mark.parametrize("turns", [1, 3, pytest.param(8, marks=pytest.mark.long)])
def test_six_twists_fill_as_much_tail_as_their_turns_ask_the_first_like_the_last(verify, turns):
    row = twisted(turns, 6, "draft")
    used = [before - after for before, after in zip(row.tails, row.tails[1:], strict=False)]
    theory = tail_of_a_twist(row.planned, turns)
    for name, measured in (("first", used[0]), ("sixth", used[-1]), ("mean", sum(used) / 6.0)):
        verify("V35", f"twists of {turns} turns, tail of the {name}, mm", 1e3 * measured, 1e3 * theory, 5e-2)


@pytest.mark.long
def test_turns_fill_as_much_tail_in_a_finer_mesh(verify):
    row = twisted(8, 2, "preview")
    used, theory = 0.5 * (row.tails[0] - row.tails[-1]), tail_of_a_twist(row.planned, 8)
    verify("V35", "twists of 8 turns, tail of a twist in preview, mm", 1e3 * used, 1e3 * theory, 5e-2)


def test_what_turns_draw_in_is_what_the_mesh_loses(verify):
    packed, wound = twisted(3, 6, "draft"), twisted(8, 6, "draft")
    lost = (wound.rubber[0] - wound.rubber[1]) - (packed.rubber[0] - packed.rubber[1])
    strip = wound.planned.strips["main"]
    around = 12
    section = 2.0 * strip.size.radius * strip.size.thickness * around * np.tan(np.pi / around)
    theory = 6.0 * drawn_rubber(strip.size, softened(strip.rubber), 8) * section
    verify("V35", "twists of 8 turns, rubber drawn in, mm3", 1e9 * lost, 1e9 * theory, 1e-2)
