"""Capsules: closed balloons that start blown up, of whose wall every neck takes some."""

from __future__ import annotations

import math
import re
from itertools import pairwise

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from balloon_usd.balloon.detail import DETAILS, detail_named
from balloon_usd.plan import plan, plan_json, plan_svg, plan_text
from balloon_usd.plan.drawing import MARGIN, SCALE
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.plan.necks import wall_length
from balloon_usd.recipe import Recipe, RecipeError
from tests.plan.test_drawing import shapes

CM = 0.01
HEAD = "format: 1\nname: figure\nunits: cm\n"
BODY = """
balloons: {{main: {{size: 260, capsule: {}}}}}
steps: [{{bubbles: {{a: 5, b: 3, c: 9}}}}]
physics: {{model: kosaka}}
"""


@pytest.fixture(scope="module")
def capsule(planned):
    return planned(BODY.format(28))


@pytest.fixture(scope="module")
def untwisted(planned):
    return planned("""
        balloons: {main: {size: 260, capsule: 20}}
        steps: [{wait: 1}]
        physics: {model: kosaka}
        """)


def problem_of(planned, body: str) -> str:
    with pytest.raises(RecipeError) as caught:
        planned(body)
    return str(caught.value)


def test_bubbles_lie_end_to_end_from_pole_to_pole(capsule):
    bubbles = capsule.strips["main"].bubbles
    assert (bubbles[0].start, bubbles[0].rest_start, bubbles[-1].name) == (0.0, 0.0, "main_rest")
    assert bubbles[-1].rest_end == capsule.strips["main"].capsule_length == pytest.approx(28 * CM)
    for before, after in pairwise(bubbles):
        assert (after.start, after.rest_start) == (before.end, before.rest_end)
    assert [bubble.end - bubble.start for bubble in bubbles] == pytest.approx([b.length for b in bubbles])


def test_bubbles_are_as_long_as_written_and_take_more_wall_than_that(capsule):
    strip = capsule.strips["main"]
    assert [bubble.length for bubble in strip.bubbles[:-1]] == [5 * CM, 3 * CM, 9 * CM]
    assert [bubble.rest_length for bubble in strip.bubbles] == pytest.approx(
        [
            wall_length(bubble.length, strip.inflated_radius, necks)
            for bubble, necks in zip(strip.bubbles, (1, 2, 2, 1), strict=True)
        ]
    )
    assert strip.bubbles[-1].end < strip.capsule_length


def test_a_capsule_that_is_not_twisted_is_one_bubble_of_its_own_length(untwisted):
    (bubble,) = untwisted.strips["main"].bubbles
    assert (bubble.name, bubble.kind) == ("main_rest", "rest")
    assert (bubble.start, bubble.rest_start) == (0.0, 0.0)
    assert (bubble.end, bubble.rest_end) == pytest.approx((20 * CM, 20 * CM))


def test_the_air_of_all_bubbles_is_that_of_the_capsule(capsule):
    strip = capsule.strips["main"]
    radius = strip.inflated_radius
    whole = math.pi * radius**2 * (28 * CM - 2.0 * radius + 4.0 / 3.0 * radius)
    assert sum(bubble.volume for bubble in strip.bubbles) == pytest.approx(whole)
    assert strip.bubbles[1].volume == pytest.approx(math.pi * radius**2 * strip.bubbles[1].rest_length)


@pytest.mark.parametrize(("detail", "faces"), [("draft", 1600), ("preview", 3600), ("full", 6400)])
def test_a_260_of_20_cm_is_meshed_as_in_the_thesis_or_finer(planned, detail, faces):
    figure = planned(BODY.format(20).replace("c: 9", "c: 4"))
    mesh = mesh_of(figure.strips["main"], detail_named(detail))
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


def test_the_text_tells_the_capsule_and_how_long_it_becomes_and_of_no_tail_or_flat_tube(capsule):
    text = plan_text(capsule)
    bubbles = capsule.strips["main"].bubbles
    end = round(bubbles[-1].end / CM, 1)
    assert "model kosaka: springs and air particles" in text
    assert "balloon main: capsule of a 260, 28 cm long, 5.1 cm wide" in text
    assert f"its necks take {28 - end:.1f} cm: twisted it is {end:g} cm long" in text
    assert f"  c          bubble  9.0 cm     8.0    17.0  {bubbles[2].rest_start / CM:5.1f} to" in text
    assert "starts blown up: 0.54 L" in text
    for word in ("tail", "flat", "kPa", "mol"):
        assert word not in text


def test_the_text_of_a_capsule_that_is_not_twisted_speaks_of_no_necks(untwisted):
    text = plan_text(untwisted)
    assert "capsule of a 260, 20 cm long" in text
    assert "neck" not in text


def test_the_data_have_no_budget_and_the_length_before_twisting(capsule):
    data = plan_json(capsule)
    (balloon,) = data["balloons"]
    assert data["model"] == "kosaka"
    assert (balloon["capsule"], balloon["budget"]) == (True, None)
    assert balloon["inflated_length"] == pytest.approx(28 * CM)
    assert balloon["bubbles"][-1]["end"] == capsule.strips["main"].bubbles[-1].end
    assert not any(joint["springs_back"] for joint in data["graph"]["joints"])


def test_the_drawing_shows_the_capsule_to_scale_with_its_marks_and_no_flat_tube(capsule):
    drawing = plan_svg(capsule)
    bubbles = capsule.strips["main"].bubbles
    (whole,) = shapes(drawing, "rect", "capsule")
    assert "capsule of 28 cm" in drawing
    assert float(whole.get("width")) / SCALE == pytest.approx(28 * CM, abs=1e-4)
    top = float(whole.get("y"))
    marks = [line for line in shapes(drawing, "line", "mark") if float(line.get("y2")) > top]
    assert [(float(line.get("x1")) - MARGIN) / SCALE for line in marks] == pytest.approx(
        [bubble.rest_end for bubble in bubbles[:-1]], abs=1e-4
    )
    assert [
        float(shape.get("width")) / SCALE for shape in shapes(drawing, "rect", "bubble")
    ] == pytest.approx([bubble.length for bubble in bubbles], abs=1e-4)
    assert not shapes(drawing, "rect", "flat")
    assert not shapes(drawing, "rect", "empty")


def test_bubbles_that_leave_no_rest_are_refused_with_what_they_take_and_what_is_left(planned):
    text = problem_of(planned, BODY.format(17))
    assert "steps[0].bubbles.c" in text
    assert re.search(
        r'"c" of 9 cm does not fit: with its necks it takes [\d.]+ cm, [\d.]+ cm of main is left and what follows '
        r"needs [\d.]+ cm, expected at most [\d.]+ cm, or a capsule of at least [\d.]+ cm$",
        text,
    )


def test_the_first_bubble_has_one_neck(planned):
    text = problem_of(planned, BODY.format(8).replace("a: 5", "a: 8"))
    assert '"a" of 8 cm does not fit: with its neck it takes' in text


def test_bubbles_that_are_too_many_to_fit_are_to_be_shorter_in_all(planned):
    text = problem_of(planned, BODY.format(10))
    assert re.search(r"bubbles.b: .*, expected bubbles shorter by [\d.]+ cm in all, or a capsule of", text)


def test_no_capsule_longer_than_a_full_balloon_is_proposed(planned):
    text = problem_of(planned, BODY.format(150).replace("c: 9", "c: 160"))
    assert "expected at most" in text
    assert "or a capsule" not in text


def outcome(lengths: list[int], capsule: int) -> str:
    """What is said about bubbles of some lengths in a capsule, all in mm, if it is refused; else nothing."""
    bubbles = ", ".join(f"b{k}: {length / 10}" for k, length in enumerate(lengths))
    body = (
        f"balloons: {{main: {{size: 260, capsule: {capsule / 10}}}}}\nsteps: [{{bubbles: {{{bubbles}}}}}]\n"
    )
    try:
        plan(Recipe.parse(f"{HEAD}{body}physics: {{model: kosaka}}\n"))
    except RecipeError as refused:
        return str(refused)
    return ""


def millimetres(said: str, words: str) -> int | None:
    found = re.search(rf"{words} ([\d.]+) cm", said)
    return None if found is None else round(10 * float(found[1]))


@settings(max_examples=60, deadline=None)
@given(lengths=st.lists(st.integers(15, 200), min_size=1, max_size=6), capsule=st.integers(52, 700))
def test_the_capsule_and_the_bubble_that_are_said_to_do_just_do(lengths, capsule):
    said = outcome(lengths, capsule)
    assume(said)
    longer = millimetres(said, "a capsule of at least")
    if longer is not None:
        assert outcome(lengths, longer) == ""
        assert outcome(lengths, longer - 1) != ""
    misfit = int(re.search(r'"b(\d)" of', said)[1])
    shorter = millimetres(said, "expected at most")
    if shorter is not None:
        before, after = lengths[:misfit], lengths[misfit + 1 :]
        assert outcome([*before, shorter, *after], capsule) == ""
        assert outcome([*before, shorter + 1, *after], capsule) != ""


def test_bubbles_that_are_shorter_in_all_by_what_is_said_fit():
    less = millimetres(outcome([80, 80, 80], 160), "shorter by")
    assert outcome([80, 80 - less // 2, 80 - (less + 1) // 2], 160) == ""


def test_a_bubble_of_a_few_rows_of_faces_is_refused(planned):
    text = problem_of(planned, BODY.format(28).replace("b: 3", "b: 1"))
    assert "steps[0].bubbles.b: 1 cm is too short for a bubble of a 260 capsule" in text
    assert "expected at least 1.5 cm" in text


def test_a_bubble_that_is_too_short_and_one_that_does_not_fit_are_told_together(planned):
    text = problem_of(planned, BODY.format(15).replace("b: 3", "b: 1"))
    assert [line.partition(": ")[2].partition(":")[0] for line in text.splitlines()] == [
        "steps[0].bubbles.b",
        "steps[0].bubbles.c",
    ]


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
    wide = planned(BODY.format(28).replace("size: 260", "size: 260, radius: 5 mm")).strips["main"]
    assert wide.inflated_radius == pytest.approx(
        planned(BODY.format(28)).strips["main"].inflated_radius * 5.0 / 4.5
    )
