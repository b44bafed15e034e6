"""Balloons that are put into others: where they lie, and what does not fit."""

from __future__ import annotations

import re

import pytest

from balloon_usd.operations.insert import Insert
from balloon_usd.plan import plan, plan_json, plan_text
from balloon_usd.plan.nesting import hosts_of, room_left
from balloon_usd.recipe import Recipe, RecipeError
from tests.mesh_file.shapes import ball, write_obj

POD = """
balloons:
  pod: {size: 350, length: 16, tail: 7}
  one: {size: 160, length: 1.9, tail: 0.7}
  two: {size: 160, length: 1.9, tail: 0.7}
steps:
  - insert: {one: a, two: c}
  - inflate: pod
  - inflate: [one, two]
  - bubbles: {a: 9, b: 9, c: 9}
    balloon: pod
"""
BALLS = """
balloons:
  outer: {mesh: outer.obj, unit: m, swell: 2}
  inner: {mesh: inner.obj, unit: m, swell: 1.5}
steps:
  - insert: {inner: outer}
  - inflate: [inner, outer]
"""
HEAD = "format: 1\nname: figure\nunits: cm\n"


def balls(folder, text=BALLS, outer=0.08, inner=0.04):
    for name, radius in (("outer", outer), ("inner", inner)):
        shape = ball(radius, 4)
        write_obj(folder / f"{name}.obj", shape.points, shape.quads.tolist())
    return plan(Recipe.parse(HEAD + text, file=str(folder / "figure.yaml")))


def rod(least, size):
    """Points and faces of a box from its corner with the least places, m."""
    points = [[least[k] + size[k] * (n >> k & 1) for k in range(3)] for n in range(8)]
    return points, [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]


def u_shape(side):
    """The same of a U of cubes, five wide and four high, open above."""
    cubes = {(x, 0, z) for x in range(5) for z in range(4) if z == 0 or x in (0, 4)}
    numbers, faces = {}, []
    for cube in sorted(cubes):
        for face in rod((0, 0, 0), (1, 1, 1))[1]:
            corners = [tuple(cube[k] + (n >> k & 1) for k in range(3)) for n in face]
            middle = [sum(corner[k] for corner in corners) / 4.0 - cube[k] - 0.5 for k in range(3)]
            beside = tuple(cube[k] + round(2.0 * middle[k]) for k in range(3))
            if beside not in cubes:
                faces.append([numbers.setdefault(corner, len(numbers)) for corner in corners])
    return [[side * k for k in corner] for corner in numbers], faces


def test_flat_tubes_lie_behind_each_other_in_the_outer_one_and_go_to_the_middles_of_their_bubbles(planned):
    strips = planned(POD).strips
    hosts = hosts_of(strips)
    assert {name: (host.balloon, host.bubble) for name, host in hosts.items()} == {
        "one": ("pod", 0),
        "two": ("pod", 2),
    }
    assert 0.0 < hosts["one"].along < hosts["two"].along
    assert hosts["two"].along + strips["two"].size.length < strips["pod"].size.length
    assert hosts["two"].goal > hosts["two"].along
    assert hosts["one"].way == 0.0


def test_a_bubble_has_less_gas_by_what_lies_in_it(planned):
    alone = POD.replace("  - insert: {one: a, two: c}\n", "")
    inner = planned(POD).strips["one"].bubbles[0].volume
    left = [bubble.volume for bubble in planned(POD).strips["pod"].bubbles]
    whole = [bubble.volume for bubble in planned(alone).strips["pod"].bubbles]
    taken = [one - other for one, other in zip(whole, left, strict=True)]
    assert taken == pytest.approx([inner, 0.0, inner, 0.0], rel=0.02)
    assert room_left(planned(POD).strips, "pod") == pytest.approx(1.0 - 2.0 * inner / sum(whole), abs=0.01)
    assert room_left(planned(POD).strips, "one") == 1.0


def test_the_plan_tells_what_lies_where_and_asks_for_no_lock(planned):
    made = planned(POD)
    assert "balloon one: 160, 1.9 cm flat, lies in a\n" in plan_text(made)
    assert [balloon["inside"] for balloon in plan_json(made)["balloons"]] == [None, "a", "c"]
    assert not any("joined" in caution.what for caution in made.cautions)


def test_nothing_lies_in_a_tulip_whose_own_wall_takes_the_room():
    head = POD.replace("bubbles: {a: 9, b: 9, c: 9}", "tulip: {a: 9}\n    balloon: pod\n  - bubbles: {c: 9}")
    with pytest.raises(RecipeError, match="lies in a, a tulip, whose own wall leaves no room in it"):
        plan(Recipe.parse(HEAD + head))


def test_the_example_needs_no_caution():
    assert plan(Recipe.parse(Insert.example)).cautions == ()


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        (
            "size: 160, length: 1.9",
            "size: 350, length: 1.9",
            "is 1.3 cm wide while it is flat, and pod 1.3 cm, expected a tube of at most 1 cm",
        ),
        ("one: {size: 160, length: 1.9", "one: {size: 160, length: 3.9", "is 14.4 cm long with its nozzle"),
        ("two: c", "two: a", "a holds two as well, expected a bubble for each"),
        (
            "  - inflate: pod\n  - inflate: [one, two]\n",
            "  - inflate: [pod, one, two]\n",
            "is not blown up after pod, which would drag it along as it grows",
        ),
        (
            "  - inflate: pod\n  - inflate: [one, two]\n",
            "  - inflate: [one, two]\n  - inflate: pod\n",
            "is not blown up after pod, which would drag it along as it grows, expected inflate: pod in a step before",
        ),
    ],
)
def test_tubes_that_do_not_fit_are_refused_with_what_would(planned, old, new, told):
    assert old in POD
    with pytest.raises(RecipeError) as refused:
        planned(POD.replace(old, new))
    assert f"figure.yaml:10:19: steps[0].insert.one: {told}" in str(refused.value)


@pytest.mark.parametrize(
    "given", ["length: 6, inflated: 5", "length: 3.9, tail: 0.7", "inflated: 9", "length: 8, tail: 7"]
)
def test_what_is_advised_to_a_tube_that_is_too_long_fits(planned, given):
    text = POD.replace("one: {size: 160, length: 1.9, tail: 0.7}", f"one: {{size: 160, {given}}}")
    with pytest.raises(RecipeError) as refused:
        planned(text)
    advised = re.search(
        r"expected at most 9 cm in a, such as (inflated: .* cm, length: .* cm)", str(refused.value)
    )
    assert planned(text.replace(given, advised.group(1))).strips["one"].inside == "a"


def test_flat_tubes_that_have_no_room_behind_each_other_are_refused(planned):
    text = POD.replace("length: 16, tail: 7", "length: 8, tail: 2").replace("b: 9, ", "")
    text = text.replace("length: 1.9, tail: 0.7", "length: 3, tail: 1.6")
    told = "has no room in pod, which is 8 cm long while it is flat, expected it, or what lies behind it, shorter by"
    with pytest.raises(RecipeError, match=told):
        planned(text)


def test_more_balloons_in_one_than_hands_bring_to_their_places_are_refused(planned):
    names = [f"it_{k}" for k in range(9)]
    flat = "".join(f"  {name}: {{size: 160, length: 1.2, tail: 0.8}}\n" for name in names)
    put = ", ".join(f"{name}: b_{k}" for k, name in enumerate(names))
    made = ", ".join(f"b_{k}: 9" for k in range(9))
    text = f"balloons:\n  pod: {{size: 350, length: 40, tail: 12}}\n{flat}steps:\n  - insert: {{{put}}}\n"
    text += (
        f"  - inflate: pod\n  - inflate: [{', '.join(names)}]\n  - bubbles: {{{made}}}\n    balloon: pod\n"
    )
    with pytest.raises(RecipeError, match=r"insert\.it_8: is one of 9 balloons in pod, expected at most 8"):
        planned(text)


def test_balls_lie_in_balls_where_their_files_say(tmp_path):
    assert hosts_of(balls(tmp_path).strips)["inner"].balloon == "outer"


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ("unit: m, swell: 1.5", "unit: m, at: [5, 0, 0]", "of its wall, expected at: [0 cm, 0 cm, 0 cm]"),
        (
            "unit: m, swell: 1.5",
            "unit: m, swell: 4",
            "would stretch outer further, expected swell: 2.08 of outer",
        ),
    ],
)
def test_balls_that_do_not_fit_are_refused_with_what_would(tmp_path, old, new, told):
    with pytest.raises(RecipeError) as refused:
        balls(tmp_path, BALLS.replace(old, new))
    assert "steps[0].insert.inner: " in str(refused.value)
    assert told in str(refused.value)


def test_a_ball_as_large_as_the_other_lies_in_no_place_of_it(tmp_path):
    with pytest.raises(RecipeError, match="of its wall, expected all of it inside, such as a smaller one"):
        balls(tmp_path, outer=0.08, inner=0.09)


def test_a_coarse_rod_whose_corners_lie_inside_goes_through_a_dent_of_another_all_the_same(tmp_path):
    write_obj(tmp_path / "outer.obj", *u_shape(0.08))
    write_obj(tmp_path / "inner.obj", *rod((0.02, 0.02, 0.2), (0.36, 0.02, 0.02)))
    text = BALLS.replace("swell: 1.5", "swell: 1.2")
    with pytest.raises(RecipeError, match="of its wall, expected all of it inside"):
        plan(Recipe.parse(HEAD + text, file=str(tmp_path / "figure.yaml")))


def test_two_balls_do_not_lie_in_one_place_of_another(tmp_path):
    text = BALLS.replace("steps:", "  third: {mesh: inner.obj, unit: m, at: [2, 0, 0]}\nsteps:")
    text = text.replace("{inner: outer}", "{inner: outer, third: outer}").replace("[inner,", "[inner, third,")
    with pytest.raises(RecipeError, match="lies where another does in it, expected its box beside that"):
        balls(tmp_path, text)
