"""Plans of balloons from mesh files: how far they are blown up, and what no run could do."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from balloon_usd.balloon.detail import DETAILS, detail_named
from balloon_usd.operations.moves import Inflate, LetGo
from balloon_usd.plan import plan, plan_json, plan_svg, plan_text
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.staging import describe_stage
from tests.mesh_file.shapes import ball, cube, ring, write_obj
from tests.plan.test_drawing import shapes

HEART = Path(__file__).parents[2] / "recipes" / "meshes" / "heart.yaml"


@pytest.fixture(scope="module")
def heart():
    return plan(Recipe.load(HEART))


@pytest.fixture
def shape(tmp_path):
    """Plan a recipe in whose folder a cube of 2 and a ball of 0.1 lie."""
    write_obj(tmp_path / "cube.obj", *cube())
    write_obj(tmp_path / "ball.obj", ball(0.1, 4).points, ball(0.1, 4).quads.tolist())

    def make(entry: str, head: str = "units: cm\n"):
        text = f"format: 1\nname: shape\n{head}balloons: {entry}\nsteps: [wait: 1]\n"
        return plan(Recipe.parse(text, file=str(tmp_path / "shape.yaml")))

    return make


def refused(make, entry: str, head: str = "units: cm\n") -> str:
    with pytest.raises(RecipeError) as caught:
        make(entry, head)
    (problem,) = caught.value.problems
    return str(problem)


def test_it_is_one_bubble_with_the_name_of_its_balloon(heart):
    (bubble,) = heart.bubbles
    assert (bubble.name, bubble.balloon, bubble.kind) == ("heart", "heart", "shape")
    assert heart.table.rings == ()
    assert heart.budgets == {}
    assert heart.cautions == ()


def test_swell_is_the_size_of_a_ball_of_the_same_wall(shape):
    strip = shape("{it: {mesh: ball.obj, unit: m, swell: 2}}").strips["it"]
    assert strip.shape.volume == pytest.approx(8.0 * strip.shape.surface.volume, rel=0.05)
    assert strip.shape.volume == pytest.approx(8.0 * strip.shape.surface.ball_volume)


def test_bare_numbers_of_a_mesh_are_in_the_units_of_the_recipe_or_its_own(shape):
    in_recipe = shape("{it: {mesh: cube.obj}}").strips["it"].shape.surface
    assert max(in_recipe.size) == pytest.approx(0.02)
    own = shape("{it: {mesh: cube.obj, unit: in}}").strips["it"].shape.surface
    assert max(own.size) == pytest.approx(0.0508)


def test_it_lies_where_the_file_and_the_recipe_say(shape):
    points = shape("{it: {mesh: cube.obj, at: [10, -5, 0]}}").strips["it"].shape.surface.points
    assert points.mean(axis=0) == pytest.approx([0.1, -0.05, 0.0])


def test_hands_only_blow_it_up(heart):
    moves = heart.choreography.moves
    assert [move.text for move in moves if move.seconds > 0.0] == [
        "inflate: heart",
        "inflated",
        "wait",
        "hold",
    ]
    assert isinstance(moves[0], Inflate)
    assert any(isinstance(move, LetGo) and move.for_good for move in moves)


@pytest.mark.parametrize("detail", DETAILS)
def test_details_split_its_faces(heart, detail):
    strip, level = heart.strips["heart"], detail_named(detail)
    mesh = mesh_of(strip, level)
    assert level.shape_quads / 4 < len(mesh.quads) <= level.shape_quads
    assert mesh.st.min() >= 0.0
    assert mesh.st.max() <= 1.0
    assert not mesh.quad_bubble.any()
    area = np.cross(
        mesh.points[mesh.quads[:, 2]] - mesh.points[mesh.quads[:, 0]],
        mesh.points[mesh.quads[:, 3]] - mesh.points[mesh.quads[:, 1]],
    )
    assert 0.5 * np.linalg.norm(area, axis=1).sum() == pytest.approx(strip.shape.surface.area, rel=1e-4)


def test_its_stage_names_the_file_by_its_hash(heart):
    described = describe_stage(heart, [mesh_of(heart.strips["heart"], detail_named("draft"))])
    assert described.provenance["mesh_sha256"] == heart.strips["heart"].shape.file_sha256
    assert described.bubble_names == ("heart",)


def test_the_plan_is_told_drawn_and_given_as_data(heart):
    text = plan_text(heart)
    assert "balloon heart: mesh of 1368 quads, 30.0 x 0.0 x 27.6 cm flat" in text
    assert "(swell 1.2): a ball would be 22 cm wide" in text
    assert "joint" not in text
    assert len(shapes(plan_svg(heart), "path", "flat")) == 1
    assert not shapes(plan_svg(heart), "circle", "joint")
    balloon = json.loads(json.dumps(plan_json(heart)))["balloons"][0]
    assert balloon["shape"]["swell"] == 1.2
    assert balloon["budget"] is None


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        (
            "{it: {mesh: no.obj}}",
            "balloons.it.mesh: {folder}/no.obj: cannot be read (No such file or directory)",
        ),
        (
            "{it: {mesh: cube.obj, unit: mm}}",
            "balloons.it.mesh: {folder}/cube.obj: 0.2 cm long in mm, expected 2 cm to 3 m: is its unit m?",
        ),
        (
            "{it: {mesh: ball.obj, unit: cm}}",
            "balloons.it.mesh: {folder}/ball.obj: 0.2 cm long in cm, expected 2 cm to 3 m: is its unit m?",
        ),
        (
            "{it: {mesh: cube.obj, swell: 0.6}}",
            "balloons.it.swell: 0.6 is less than it holds before it is blown up, expected at least 0.92",
        ),
        (
            "{it: {mesh: cube.obj, thickness: 1 mm}}",
            "balloons.it.thickness: a wall of 1 mm is no thin skin of a balloon of 2 cm, expected at most 0.69 mm",
        ),
        (
            "{a: {mesh: cube.obj}, b: {mesh: cube.obj, at: [1, 0, 0]}}",
            "balloons.b: lies where a is, expected its box beside that, such as at: [4 cm, 0 cm, 0 cm]",
        ),
    ],
)
def test_what_no_run_could_do_is_refused(entry, message, shape, tmp_path):
    assert refused(shape, entry).endswith(message.format(folder=tmp_path))


def test_a_mesh_without_a_unit_is_refused(shape):
    line = refused(shape, "{it: {mesh: cube.obj}}", head="")
    assert line.endswith(
        "balloons.it.mesh: has no unit, expected unit: m beside it, or units: cm at the top of the recipe"
    )


def test_a_ring_that_is_blown_up_so_far_that_it_bulges_is_cautioned_with_what_does_not(tmp_path):
    points, faces = ring()
    write_obj(tmp_path / "ring.obj", points, faces)

    def cautions(swell: float) -> tuple[str, ...]:
        text = f"format: 1\nname: ring\nunits: cm\nballoons: {{it: {{mesh: ring.obj, swell: {swell}}}}}\nsteps: [wait: 1]\n"
        found = plan(Recipe.parse(text, file=str(tmp_path / "ring.yaml"))).cautions
        return tuple(f"{caution.what}: {caution.remedy}" for caution in found)

    assert cautions(1.2) == ("it may bulge at one place: swell: 1.02",)
    assert cautions(1.02) == ()


def test_a_cube_bulges_nowhere_however_far_it_is_blown_up(tmp_path):
    write_obj(tmp_path / "cube.obj", *cube())
    text = "format: 1\nname: cube\nunits: cm\nballoons: {it: {mesh: cube.obj, unit: m, swell: 1.5}}\nsteps: [wait: 1]\n"
    assert plan(Recipe.parse(text, file=str(tmp_path / "cube.yaml"))).cautions == ()
