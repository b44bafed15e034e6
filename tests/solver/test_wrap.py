"""A bubble that is closed round the neck of another: it lies there, and comes out on the side that is asked."""

from __future__ import annotations

import re

import numpy as np
import pytest

from balloon_usd.operations.moves import Wrap as WrapMove
from balloon_usd.operations.wrap import SWINGING_SPEED, Wrap
from balloon_usd.plan import plan
from balloon_usd.quality.ring_corners import RingCorners
from balloon_usd.quality.solid_angle import solid_angles
from balloon_usd.quality.watch import QualityWatch
from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.solver.kernels.physics.motion import LYING_SPEED
from balloon_usd.solver.latex.motions.wrap import half_angle
from balloon_usd.solver.simulation import simulate_many

FORWARD = Wrap.example
BACK = FORWARD.replace("neck: nose.start}", "neck: nose.start, looks: back}")
STEP = BACK.index("  - wrap:")


class Wrapped:
    """Where the row and the nose are when the muzzle is closed, from it, (3,) m each, and the quality."""

    def __init__(self, text):
        figure = plan(Recipe.parse(text))
        (move,) = (move for move in figure.choreography.moves if isinstance(move, WrapMove))
        simulation = simulate_many([figure], device="cpu")
        (meshes,) = simulation.meshes
        quality = QualityWatch(figure, meshes)
        places = figure.table.guides("muzzle"), move.led[: move.row], move.led[move.row :]
        corners = [[RingCorners.of(figure, meshes, ring) for ring in rings] for rings in places]
        for (frame,) in simulation.frames():
            quality.add(frame)
            if frame.time_code == round(move.end * figure.recipe.fps):
                muzzle, row, nose = (
                    np.mean([ring.places(frame).mean(axis=0) for ring in rings], axis=0) for rings in corners
                )
        self.row, self.nose = row - muzzle, nose - muzzle
        self.quality = quality.data()


@pytest.fixture(
    scope="module", params=[FORWARD, pytest.param(BACK, marks=pytest.mark.long)], ids=["forward", "back"]
)
def wrapped(request):
    return Wrapped(request.param), -1.0 if request.param == FORWARD else 1.0


@pytest.mark.parametrize("row", ["", "  - bubbles: {eye: 5, forehead: 12}\n"], ids=["a tube", "a chain"])
def test_a_long_figure_behind_the_neck_is_swung_round_slowly(row):
    text = FORWARD.replace("length: 8.6", "length: 40")
    if row:
        text = text.replace("  - rest: nose", "  - bubbles: {nose: 5}\n" + row + "  - rest: body")
    figure = plan(Recipe.parse(text))
    (move,) = (move for move in figure.choreography.moves if isinstance(move, WrapMove))
    names = [bubble.name for bubble in figure.bubbles]
    swung = sum(bubble.length for bubble in figure.bubbles[names.index("nose") :])
    assert swung > 0.8
    assert np.pi * swung / move.seconds <= SWINGING_SPEED * (1.0 + 1e-9)


def test_the_neck_stays_in_the_bubble_that_is_closed_round_it(wrapped):
    quality = wrapped[0].quality
    assert quality["passed"]["value"] == 0
    assert quality["passed"]["through"]["nose"] > 0.5
    assert quality["crossings"]["value"] == quality["crossings"]["most"] == 0
    assert quality["creep"]["value"] < 3e-3
    assert quality["speed"]["value"] < 1.1 * LYING_SPEED, "nothing draws at what lies"
    assert quality["joints"]["held"] == quality["joints"]["meant"] == 2


def test_nose_and_row_lie_on_the_sides_that_the_recipe_says(wrapped):
    figure, side = wrapped
    assert side * figure.nose[0] > 0.005
    assert side * figure.row[0] < -0.005


@pytest.mark.parametrize("share", [0.1, 0.3, 0.64, 0.9, 0.999])
def test_an_arc_of_twice_the_half_angle_has_a_chord_of_that_share_of_its_length(share):
    half = half_angle(share)
    assert np.sin(half) / half == pytest.approx(share, abs=1e-6)


def test_the_solid_angle_of_a_flat_ring_is_half_a_sphere_in_its_plane_and_that_of_a_cap_on_its_axis():
    around = np.linspace(0.0, 2.0 * np.pi, 400, endpoint=False)
    ring = np.stack([np.cos(around), np.sin(around), np.zeros(400)], axis=1)
    heights = np.array([1e-6, 0.5, 2.0])
    found = solid_angles(np.stack([0 * heights, 0 * heights, heights], axis=1), ring)
    assert np.abs(found) == pytest.approx(2.0 * np.pi * (1.0 - heights / np.hypot(1.0, heights)), rel=1e-3)


@pytest.mark.parametrize(
    ("step", "told"),
    [
        ("{bubble: muzzle}", "neck: is missing"),
        ("{neck: nose.start}", "bubble: is missing"),
        ("{bubble: muzzle, neck: nose}", '"nose" is no joint'),
        (
            "{bubble: muzzle, neck: nose.end}",
            "nose.end does not hang on muzzle.end by a row of bubbles alone",
        ),
        ("{bubble: muzzle, neck: behind.start}", "behind.start does not hang on muzzle.end"),
        ("{bubble: nose, neck: nose.start}", "nose.start does not hang on nose.end"),
        ("{bubble: muzle, neck: nose.start}", 'unknown bubble "muzle", did you mean "muzzle"'),
        ("{bubble: muzzle, neck: nsoe.start}", 'unknown bubble "nsoe", did you mean "nose"'),
        ("{bubble: muzzle, neck: nose.start, looks: up}", "expected one of forward, back"),
        ("[muzzle]", "does not fit"),
    ],
)
def test_what_cannot_be_wrapped_is_refused_with_the_reason(step, told):
    with pytest.raises(RecipeError) as caught:
        plan(Recipe.parse(f"{BACK[:STEP]}  - wrap: {step}\n"))
    assert re.search(told, str(caught.value))


def test_a_bubble_that_is_closed_already_is_pushed_through():
    text = BACK.replace("bubbles: {muzzle: 9}", "loop: {muzzle: 9}")
    with pytest.raises(RecipeError, match="muzzle is closed already, expected push"):
        Recipe.parse(text)


def test_a_ball_and_a_row_that_does_not_reach_are_refused():
    ball = BACK.replace("muzzle: 9}", "muzzle: 3}")
    with pytest.raises(RecipeError, match="make a ball, wider than long"):
        plan(Recipe.parse(ball))
    short = BACK.replace("behind: 9", "behind: 4")
    with pytest.raises(RecipeError, match="do not reach round into muzzle"):
        plan(Recipe.parse(short))


def test_a_nose_that_may_slip_out_and_haste_are_told():
    small = plan(Recipe.parse(BACK.replace("length: 8.6", "length: 8.4")))
    assert any("nose" in each.what and "may slip out of muzzle" in each.what for each in small.cautions)
    with pytest.raises(RecipeError, match="too short a time to wrap muzzle round"):
        plan(Recipe.parse(BACK + "    seconds: 1\n"))


def test_what_is_wrapped_is_one_limb_with_its_neck():
    piece = Recipe.parse(BACK).piece
    assert piece.limb("muzzle").bubbles == {"muzzle", "behind", "nose"}
    assert piece.limb("nose").bubbles == {"nose"}
    assert not piece.free_joints()
    assert any(contact.text == "wraps muzzle round the neck of nose" for contact in piece.contacts)
