"""Capsules: closed balloons that start blown up, so that flat places are the inflated ones."""

from __future__ import annotations

import math
from itertools import pairwise

import pytest

from balloon_usd.balloon.detail import DETAILS, detail_named
from balloon_usd.plan import plan_json, plan_svg, plan_text
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.recipe import RecipeError

CM = 0.01
BODY = """
balloons: {{main: {{size: 260, capsule: {}}}}}
steps: [{{bubbles: {{a: 5, b: 3, c: 9}}}}]
physics: {{model: kosaka}}
"""


@pytest.fixture(scope="module")
def capsule(planned):
    return planned(BODY.format(20))


def problem_of(planned, body: str) -> str:
    with pytest.raises(RecipeError) as caught:
        planned(body)
    return str(caught.value)


def test_bubbles_lie_end_to_end_from_pole_to_pole(capsule):
    bubbles = capsule.strips["main"].bubbles
    assert (bubbles[0].start, bubbles[-1].name) == (0.0, "main_rest")
    assert bubbles[-1].end == pytest.approx(20 * CM)
    for before, after in pairwise(bubbles):
        assert (after.start, after.rest_start) == (before.end, before.rest_end)
    for bubble in bubbles:
        assert (bubble.rest_start, bubble.rest_end) == (bubble.start, bubble.end)


def test_the_air_of_all_bubbles_is_that_of_the_capsule(capsule):
    strip = capsule.strips["main"]
    radius = strip.inflated_radius
    whole = math.pi * radius**2 * (20 * CM - 2.0 * radius + 4.0 / 3.0 * radius)
    assert sum(bubble.volume for bubble in strip.bubbles) == pytest.approx(whole)
    assert strip.bubbles[1].volume == pytest.approx(math.pi * radius**2 * 3 * CM)


@pytest.mark.parametrize(("detail", "faces"), [("draft", 1600), ("preview", 3600), ("full", 6400)])
def test_a_260_of_20_cm_is_meshed_as_in_the_thesis_or_finer(capsule, detail, faces):
    mesh = mesh_of(capsule.strips["main"], detail_named(detail))
    assert len(mesh.quads) == faces
    assert len(mesh.points) == faces + 2
    assert set(mesh.quad_bubble) == {0, 1, 2, 3}


@pytest.mark.parametrize("detail", DETAILS)
def test_every_planned_ring_has_a_mesh_ring_of_its_own_near_by(capsule, detail):
    mesh = mesh_of(capsule.strips["main"], detail_named(detail))
    joints = [ring for ring in capsule.table.rings if ring.joint]
    found = [mesh.ring_at(ring.along) for ring in joints]
    assert found[0] == 0
    assert len(set(found)) == len(found)
    spacing = mesh.ring_along[len(mesh.ring_along) // 2 + 1] - mesh.ring_along[len(mesh.ring_along) // 2]
    assert [mesh.ring_along[at] for at in found[1:]] == pytest.approx(
        [ring.along for ring in joints[1:]], abs=0.51 * spacing
    )


def test_a_capsule_has_no_budget_and_no_cautions(capsule):
    assert capsule.budgets == {}
    assert capsule.cautions == ()


def test_the_text_speaks_of_no_tail_and_no_flat_tube(capsule):
    text = plan_text(capsule)
    assert "model kosaka: springs and air particles" in text
    assert "balloon main: capsule of a 260, 20 cm long, 5.1 cm wide" in text
    assert "starts blown up: 0.37 L" in text
    for word in ("tail", "flat", "kPa", "mol"):
        assert word not in text


def test_the_data_have_no_budget(capsule):
    data = plan_json(capsule)
    (balloon,) = data["balloons"]
    assert data["model"] == "kosaka"
    assert (balloon["capsule"], balloon["budget"]) == (True, None)
    assert balloon["inflated_length"] == pytest.approx(20 * CM)
    assert not any(joint["springs_back"] for joint in data["graph"]["joints"])


def test_the_drawing_shows_no_flat_tube(capsule):
    drawing = plan_svg(capsule)
    assert "capsule of 20 cm" in drawing
    assert 'class="flat"' not in drawing
    assert 'class="empty"' not in drawing


def test_bubbles_that_leave_no_rest_are_refused_with_what_is_left(planned):
    text = problem_of(planned, BODY.format(18))
    assert "steps[0].bubbles.c" in text
    assert '"c" of 9 cm does not fit: 10 cm of main is left, of which its rest needs 1.5 cm' in text
    assert "expected at most 8.5 cm, or a capsule of at least 18.5 cm" in text


def test_the_capsule_that_would_do_does(planned):
    assert planned(BODY.format(18.5)).strips["main"].bubbles[-1].length == pytest.approx(1.5 * CM)


def test_a_bubble_of_a_few_rows_of_faces_is_refused(planned):
    text = problem_of(planned, BODY.format(20).replace("b: 3", "b: 1"))
    assert "steps[0].bubbles.b: 1 cm is too short for a bubble of a 260 capsule" in text
    assert "expected at least 1.5 cm" in text


@pytest.mark.parametrize(
    ("length", "said"),
    [
        (4, "4 cm is shorter than a 260 is wide, expected at least 5.1 cm"),
        (200, "200 cm is more than a full 260, expected at most 152.1 cm"),
    ],
)
def test_a_capsule_that_is_no_balloon_of_its_size_is_refused(planned, length, said):
    assert f"balloons.main.capsule: {said}" in problem_of(planned, BODY.format(length))


def test_a_capsule_is_as_wide_as_its_size_and_rubber_are_blown_up(planned):
    wide = planned(BODY.format(20).replace("size: 260", "size: 260, radius: 5 mm")).strips["main"]
    assert wide.inflated_radius == pytest.approx(
        planned(BODY.format(20)).strips["main"].inflated_radius * 5.0 / 4.5
    )
