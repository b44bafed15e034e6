"""An end of a balloon that is cut off: a lid on its neck is left, which weighs nothing and crosses nothing."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
import pytest

from balloon_usd.balloon.detail import DETAILS
from balloon_usd.operations import moves
from balloon_usd.operations.cut import Cut
from balloon_usd.operations.moves import Pop
from balloon_usd.plan import plan
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.quality.watch import QualityWatch
from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.solver.latex.motions.table import LATEX_MOTIONS
from balloon_usd.solver.simulation import NOMINAL_RATE, model_named, simulate_many

BOTH = """
format: 1
name: bow
units: cm
balloons:
  main: {size: 260, length: 17, tail: 9}
steps:
  - bubbles: {knob: 3}
  - ear: {first: 3}
  - bubbles: {left: 8, right: 8}
  - lock: [left, right]
  - rest: spare
"""


PAIR = """
format: 1
name: pair
units: cm
balloons:
  red: {size: 260, inflated: 14, length: 12}
  white: {size: 260, inflated: 14, length: 12}
steps:
  - bubbles: {red_end: 4}
    balloon: red
  - bubbles: {white_end: 4}
    balloon: white
  - lock: {joints: [red_end.end, white_end.end]}
  - {rest: over, balloon: white}
  - cut: over
"""


class Lid(NamedTuple):
    """What is left of what was cut off."""

    middle: tuple[float, float]
    """Where it lies across its neck."""
    put_middle: np.ndarray
    """Where it lies, (3,), m."""


class CutOff:
    """A figure, the last frame of one of its balloons, its mesh, the weight of all vertices, and the quality."""

    def __init__(self, recipe, balloon="main"):
        self.plan = plan(Recipe.parse(recipe))
        simulation = simulate_many([self.plan], device="cpu")
        (meshes,) = simulation.meshes
        at = list(self.plan.strips).index(balloon)
        self.mesh = meshes[at]
        quality = QualityWatch(self.plan, meshes)
        for (frame,) in simulation.frames():
            quality.add(frame)
        self.points = frame.points[at].astype(float)
        self.weight = simulation.model.scene.true_mass.numpy()
        self.quality = quality.data()

    def side(self, ring, side):
        """Vertices on a side of a ring of the plan, and the corners of its neck."""
        along = self.plan.table.rings[ring].along
        beyond = side * (self.mesh.along - along)
        first = self.mesh.ring_start[self.mesh.ring_at(along)]
        neck = np.arange(first, first + self.mesh.around)
        return np.setdiff1d(np.flatnonzero(beyond > 0.0), neck), neck


@pytest.fixture(scope="module")
def bow():
    return CutOff(BOTH + "  - cut: spare\n  - cut: knob\n")


@pytest.fixture(params=[("spare", 0, 1), ("knob", 1, -1)], ids=["tail", "knot"])
def end(bow, request):
    """Where the vertices of an end that was cut off are, its neck, and what they weigh."""
    name, at, side = request.param
    own, neck = bow.side(bow.plan.table.ends(name)[at], side)
    return bow.points[own], bow.points[neck], bow.weight[own]


def test_what_is_left_is_no_wider_than_the_neck_and_flat(end):
    points, neck, _ = end
    middle = neck.mean(axis=0)
    radius = np.linalg.norm(neck - middle, axis=1).max()
    assert np.linalg.norm(points - middle, axis=1).max() < 1.05 * radius
    axis = np.linalg.svd(neck - middle)[2][2]
    assert np.abs((points - middle) @ axis).max() < 0.2 * radius


def test_no_two_places_of_it_are_one_and_no_face_is_without_area(bow):
    corners = bow.points[bow.mesh.quads]
    area = np.linalg.norm(np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1]), axis=1)
    assert area.min() > 1e-12
    assert len(np.unique(bow.points.astype(np.float32), axis=0)) == len(bow.points)


def test_it_weighs_nothing(bow, end):
    assert not end[2].any()
    assert bow.weight.sum() > 0.0


def test_no_wall_goes_through_another_and_the_figure_holds(bow):
    assert bow.quality["crossings"]["most"] == 0
    assert bow.quality["joints"]["held"] == bow.quality["joints"]["meant"]


def test_a_balloon_that_lay_aside_is_cut_off_as_well():
    pair = CutOff(PAIR, "white")
    own, neck = pair.side(pair.plan.table.ends("over")[0], 1)
    radius = np.linalg.norm(pair.points[neck] - pair.points[neck].mean(axis=0), axis=1).max()
    assert np.linalg.norm(pair.points[own] - pair.points[neck].mean(axis=0), axis=1).max() < 1.05 * radius
    assert pair.quality["crossings"]["most"] == 0


def test_what_was_popped_is_not_pricked_again():
    twice = plan(Recipe.parse(BOTH + "  - pop: spare\n  - cut: spare\n"))
    once = plan(Recipe.parse(BOTH + "  - cut: spare\n"))
    for figure in (twice, once):
        assert len([move for move in figure.choreography.moves if isinstance(move, Pop)]) == 1
        assert figure.recipe.piece.popped == {"spare"}


@pytest.mark.parametrize(
    ("steps", "told"),
    [
        ("cut: first", 'both ends of "first" hang on something|is held only'),
        ("cut: spair", "unknown bubble"),
        ("cut: [spare]", "cut"),
        ("cut: spare\n  - cut: spare", "was cut off at"),
        ("cut: spare\n  - lock: [right, spare]", "was cut off at"),
        ("cut: knob\n  - lock: {joints: [knob.start, right.end]}", "was cut off at"),
    ],
)
def test_what_cannot_be_cut_is_refused(steps, told):
    with pytest.raises(RecipeError, match=told):
        Recipe.parse(f"{BOTH}  - {steps}\n")


def test_a_twist_that_only_the_bubble_holds_is_not_cut_open():
    text = Cut.example.replace("  - loop: {right_leaf: 25}\n    point: right\n", "  - bubbles: {stem: 8}\n")
    with pytest.raises(RecipeError, match="would let the gas of both out"):
        Recipe.parse(text)


def test_where_a_lid_lies_does_not_depend_on_other_figures_of_a_batch():
    cut = plan(Recipe.parse(BOTH + "  - cut: spare\n"))
    meshes = [mesh_of(strip, DETAILS["draft"]) for strip in cut.strips.values()]
    lids = []
    for figures in (1, 2):
        model = model_named("latex")([cut] * figures, [meshes] * figures, NOMINAL_RATE, 12, "cpu")
        sculpture, other = model.performers[0].sculpture, model.performers[-1].sculpture
        if figures == 2:
            # All figures of a batch lie in the same space.
            model.hands.places[other.vertices] = lids[0].put_middle
        LATEX_MOTIONS[moves.Cut](moves.Cut(0.0, 0.0, 5, "cut", bubble="spare"), sculpture)
        lid = sculpture.severed["spare"].stub
        walls = sculpture.walls()
        lid.put(walls)
        lids.append(Lid(lid.middle, walls[lid.vertices].mean(axis=0)))
    assert lids[1].middle == lids[0].middle
