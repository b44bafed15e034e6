"""Balloons from mesh files: what goes with them, and what is said where something does not."""

from __future__ import annotations

import pytest

from balloon_usd.recipe import Recipe, RecipeBuilder, RecipeError

HEAD = "format: 1\nname: heart\nunits: cm\nballoons:\n"
HEART = HEAD + "  heart: {mesh: heart.obj}\n"


def told(text: str) -> list[str]:
    with pytest.raises(RecipeError) as caught:
        Recipe.parse(text, file="heart.yaml")
    return [str(problem) for problem in caught.value.problems]


def test_a_mesh_takes_the_place_of_a_size() -> None:
    (balloon,) = Recipe.parse(HEART + "steps: [wait: 1]\n").balloons.values()
    assert (balloon.mesh, balloon.size, balloon.swell, balloon.at) == ("heart.obj", None, None, None)


def test_places_may_lie_on_any_side_and_have_their_own_units() -> None:
    text = HEAD + "  heart: {mesh: heart.obj, at: [0, -3, 4 in]}\nsteps: [wait: 1]\n"
    assert Recipe.parse(text).balloons["heart"].at == (0.0, -0.03, 0.1016)


def test_it_is_written_as_it_was_read() -> None:
    text = (
        HEAD
        + "  heart: {mesh: heart.obj, unit: mm, swell: 1.5, at: [0, -3, 4 in], color: red}\nsteps: [wait: 1]\n"
    )
    recipe = Recipe.parse(text)
    assert Recipe.parse(recipe.to_yaml()) == recipe


def test_the_builder_makes_it_too() -> None:
    built = (
        RecipeBuilder("heart")
        .balloon("heart", mesh="heart.obj", swell=2.0, at=(0.0, 0.0, -0.1))
        .wait(1)
        .build()
    )
    assert built.balloons["heart"].at == (0.0, 0.0, -0.1)
    assert Recipe.parse(built.to_yaml()) == built


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        (
            "{mesh: a.obj, tail: 3}",
            "heart.tail: makes no sense with mesh, expected one of unit, swell, at, color,",
        ),
        (
            "{mesh: a.obj, size: 260}",
            "heart.size: makes no sense with mesh, expected one of unit, swell, at, color,",
        ),
        (
            "{size: 260, tail: 1, swell: 2}",
            "heart.swell: makes no sense without mesh, expected no such entry",
        ),
        ("{mesh: a.obj, swell: 9}", "heart.swell: 9 is out of range, expected 0.5 to 5, the nearest is 5"),
        ("{mesh: 3}", 'heart.mesh: 3 is no text, expected it in quotes: "3"'),
        ("{mesh: a.obj, unit: yd}", 'heart.unit: unknown unit "yd", expected one of mm, cm, m, in, ft'),
    ],
)
def test_entries_that_do_not_go_together_are_told(entry: str, message: str) -> None:
    (line,) = told(HEAD + f"  heart: {entry}\nsteps: [wait: 1]\n")
    assert message in line


@pytest.mark.parametrize(
    ("step", "place"),
    [
        ("bubbles: {nose: 3}", "steps[0].bubbles"),
        ("lock: [a, b]", "steps[0].lock"),
        ("press: {bubble: heart, depth: 1}", "steps[0].press"),
        ("rest: tip", "steps[0].rest"),
        ("note: hm", "steps[0]"),
    ],
)
def test_steps_that_twist_are_refused(step: str, place: str) -> None:
    line = told(HEART + f"steps:\n  - {step}\n")[0]
    assert line.endswith(
        f'{place}: "heart" is a mesh, which is blown up and not twisted, expected one of insert, inflate, wait'
    )


def test_meshes_and_tubes_do_not_go_into_one_recipe() -> None:
    (line,) = told(HEART + "  main: {size: 260, tail: 5}\nsteps: [wait: 1]\n")
    assert 'balloons.main: stands beside "heart", which is a mesh, expected meshes only' in line


@pytest.mark.parametrize(
    ("physics", "message"),
    [
        ("{mass_scaling: none}", "known to work, expected selective"),
        (
            "{model: kosaka}",
            "balloons.heart.mesh: makes no sense with model kosaka, whose balloons are tubes and",
        ),
    ],
)
def test_physics_that_no_mesh_bears_is_refused(physics: str, message: str) -> None:
    (line,) = told(HEART + f"steps: [wait: 1]\nphysics: {physics}\n")
    assert message in line


def test_a_mesh_falls_by_the_gravity_that_its_recipe_says() -> None:
    text = HEART + "steps: [wait: 1]\npose: drop\nphysics: {gravity: 1.62}\n"
    assert Recipe.parse(text).gravity == 1.62
