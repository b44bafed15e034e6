"""Three bubbles that hands plait: each goes over the others in turns, and they stay so."""

from __future__ import annotations

import re
from itertools import pairwise

import numpy as np
import pytest

from balloon_usd.operations.braid import Braid
from balloon_usd.operations.moves import Plait
from balloon_usd.plan import plan
from balloon_usd.quality.ring_corners import RingCorners
from balloon_usd.quality.watch import QualityWatch
from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.solver.latex.motions.plait import Pattern
from balloon_usd.solver.simulation import simulate_many

SHORT = Braid.example.replace("52", "32").replace(": 45", ": 25").replace("crossings: 6", "crossings: 5")
STRANDS = "[red_strand, white_strand, blue_strand]"


@pytest.fixture(scope="module")
def plaited():
    """Middles of the rings of each strand in the last frame, (3, N, 3), m, and the quality."""
    figure = plan(Recipe.parse(SHORT))
    (move,) = (move for move in figure.choreography.moves if isinstance(move, Plait))
    simulation = simulate_many([figure], device="cpu")
    (meshes,) = simulation.meshes
    rings = [[RingCorners.of(figure, meshes, ring) for ring in strand] for strand in move.strands]
    quality = QualityWatch(figure, meshes)
    for (frame,) in simulation.frames():
        quality.add(frame)
    return [np.array([ring.places(frame).mean(axis=0) for ring in row]) for row in rings], quality.data()


def orders(strands):
    """In which order the strands lie aside, at places from one end to the other, without repeats."""
    ends = np.array([row[-1] - row[0] for row in strands]).mean(axis=0)
    along = ends / np.linalg.norm(ends)
    beside = np.concatenate([row - np.outer(row @ along, along) for row in strands])
    aside = np.linalg.svd(beside - beside.mean(axis=0))[2][0]
    found = []
    for at in np.linspace(0.05, 0.95, 200):
        places = [
            np.interp(at * np.linalg.norm(ends), (row - row[0]) @ along, row @ aside) for row in strands
        ]
        order = tuple(np.argsort(places).tolist())
        if not found or found[-1] != order:
            found.append(order)
    return found


@pytest.mark.long
def test_every_crossing_exchanges_an_outer_strand_with_the_middle_one_from_both_sides_in_turns(plaited):
    found = orders(plaited[0])
    swaps = [
        {k for k in range(3) if before[k] != after[k]}
        for before, after in zip(found, found[1:], strict=False)
    ]
    # At the ends, where all come together, one may be told twice or not at all.
    assert 4 <= len(swaps) <= 6
    assert all(swap in ({0, 1}, {1, 2}) for swap in swaps)
    assert all(before != after for before, after in pairwise(swaps))


@pytest.mark.long
def test_a_plait_stays_and_no_wall_goes_through_another(plaited):
    quality = plaited[1]
    assert quality["crossings"]["value"] == quality["crossings"]["most"] == 0
    assert quality["creep"]["verdict"] == quality["gas"]["verdict"] == "good"
    assert quality["joints"]["held"] == quality["joints"]["meant"] == 2


@pytest.mark.parametrize(("front", "closed"), [(0.0, 0.0), (0.3, 0.0), (0.55, 0.0), (1.0, 0.0), (1.0, 1.0)])
def test_strands_keep_their_lengths_and_do_not_meet_on_the_way(front, closed):
    lengths = [np.linspace(0.02, 0.6, 40)] * 3
    width = 0.03
    pattern = Pattern(lengths, width, 9)
    rows = []
    for k in range(3):
        along, beside = pattern.places(k, front, closed)
        rows.append(np.stack([along, beside.real, beside.imag], axis=1))
        steps = np.linalg.norm(np.diff(rows[-1], axis=0), axis=1)
        assert steps == pytest.approx(np.diff(lengths[k]), rel=0.08)
    middle = slice(4, -6 if closed else None)
    for one, other in ((0, 1), (1, 2), (2, 0)):
        apart = np.linalg.norm(rows[one][middle, None] - rows[other][None, middle], axis=2)
        assert apart.min() > 0.93 * width


@pytest.mark.parametrize(
    ("step", "told"),
    [
        ("{bubbles: [red_strand, white_strand], crossings: 3}", "bubbles"),
        ("{bubbles: [red_strand, white_strand, red_strand], crossings: 3}", "names a bubble twice"),
        ("{bubbles: [red_strand, white_strand, bleu_strand], crossings: 3}", "unknown bubble"),
        (f"{{bubbles: {STRANDS}}}", "crossings"),
        (f"{{bubbles: {STRANDS}, crossings: 0}}", "1 to 60"),
        (f"{{bubbles: {STRANDS}, crossings: 2.5}}", "whole number"),
        (
            f"{{bubbles: {STRANDS}, crossings: 8}}",
            "too short for 8 crossings, expected at most 5, or 35.6 cm",
        ),
        (STRANDS, "braid"),
    ],
)
def test_what_cannot_be_plaited_is_refused_with_what_would_go(step, told):
    text = SHORT[: SHORT.index("  - braid:")] + f"  - braid: {step}\n"
    with pytest.raises(RecipeError) as caught:
        plan(Recipe.parse(text))
    assert re.search(told, str(caught.value))


def test_strands_whose_ends_are_joined_already_are_refused():
    lock = "  - lock: {joints: [red_strand.end, blue_strand.end]}\n"
    with pytest.raises(RecipeError, match="the other end of red_strand is not free"):
        Recipe.parse(SHORT.replace("  - braid:", lock + "  - braid:"))


def test_a_strand_that_ends_in_a_tip_is_refused():
    tip = SHORT.replace("bubbles: {blue_strand: 25}", "rest: blue_strand")
    with pytest.raises(RecipeError, match="blue_strand ends in the tip of its balloon"):
        plan(Recipe.parse(tip))


def test_ends_that_are_plaited_are_one_joint():
    piece = Recipe.parse(SHORT).piece
    assert any(
        {str(end) for end in joint} >= {f"{color}_strand.end" for color in ("red", "white", "blue")}
        for joint in piece.joints
    )
