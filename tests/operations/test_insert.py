"""Balloons that are put into others: what the recipe may say of them."""

from __future__ import annotations

import pytest

from balloon_usd.operations.insert import Insert
from balloon_usd.recipe import Recipe, RecipeBuilder, RecipeError

TEXT = """\
format: 1
name: figure
units: cm
balloons:
  shell: {size: 646, length: 12, tail: 4}
  bug: {size: 160, length: 3, tail: 1}
  egg: {size: 160, length: 3, tail: 1}
steps:
  - insert: {bug: belly}
  - inflate: shell
  - inflate: [bug, egg]
  - bubbles: {belly: 12}
    balloon: shell
"""


def told(text):
    with pytest.raises(RecipeError) as refused:
        Recipe.parse(text, file="figure.yaml")
    return str(refused.value).splitlines()


def test_a_balloon_lies_in_a_bubble_that_a_later_step_makes():
    assert Recipe.parse(TEXT).piece.inside == {"bug": "belly"}


def test_it_may_lie_in_what_is_left_of_a_balloon_that_no_step_names():
    assert Recipe.parse(TEXT.replace("bug: belly", "bug: shell_rest")).piece.inside == {"bug": "shell_rest"}


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        (
            "{bug: belly}",
            "{bog: belly}",
            '9:19: steps[0].insert.bog: unknown balloon "bog", did you mean "bug"?',
        ),
        ("{bug: belly}", "[bug]", "does not fit, expected entries such as {bug: cocoon}"),
        (
            "{bug: belly}",
            "{bug: bely}",
            '9:19: steps[0].insert.bug: unknown bubble "bely", did you mean "belly"?',
        ),
        (
            "{bug: belly}",
            "{shell: belly}",
            "9:21: steps[0].insert.shell: lies in itself, expected a bubble of a ",
        ),
        (
            "{bug: belly}",
            "{bug: belly, egg: bug_rest}",
            "9:31: steps[0].insert.egg: lies in bug, which lies in another, expected a bubble of a balloon that",
        ),
        (
            "  - inflate: shell\n",
            "",
            '9:19: steps[0].insert.bug: balloon "shell" is blown up by then, expected inflate: shell in a step after',
        ),
        (
            "[bug, egg]",
            "egg",
            '9:19: steps[0].insert.bug: balloon "bug" is blown up by then, expected inflate: bug in a step after',
        ),
        (
            "  - insert: {bug: belly}\n  - inflate: shell\n",
            "  - inflate: shell\n  - insert: {bug: belly}\n",
            '10:19: steps[1].insert.bug: balloon "shell" is blown up by then, expected inflate: shell in a step after',
        ),
        (
            "    balloon: shell\n",
            "    balloon: shell\n  - bubbles: {head: 2}\n    balloon: bug\n",
            '9:19: steps[0].insert.bug: hands reach nothing in belly, but twist "bug", expected nothing made of it',
        ),
        (
            "    balloon: shell\n",
            "    balloon: shell\n  - insert: {egg: belly}\n",
            '14:19: steps[4].insert.egg: bubble "belly" was made at steps[3].bubbles.belly, expected this step before',
        ),
        (
            "  - inflate: shell\n",
            "  - insert: {bug: shell_rest}\n  - inflate: shell\n",
            '10:19: steps[1].insert.bug: balloon "bug" was put into belly at steps[0].insert.bug, expected each',
        ),
        (
            "    balloon: shell\n",
            "    balloon: shell\n  - press: {bubble: bug_rest, depth: 0.5}\n",
            '14:5: steps[4]: bubble "bug_rest" lies in belly, where no hand reaches it, expected a bubble of another',
        ),
        (
            "    balloon: shell\n",
            "    balloon: shell\n  - ear: {ear: 5}\n    balloon: shell\n  - lock: {joints: [belly.start, ear.end]}\n"
            "  - pop: belly\n",
            'balloon "bug" lies in "belly", expected a bubble in which nothing lies',
        ),
    ],
)
def test_what_hands_cannot_do_is_told_with_its_place_and_what_they_can(old, new, line):
    assert old in TEXT
    assert any(line in each for each in told(TEXT.replace(old, new, 1)))


def test_what_is_wrong_with_one_balloon_is_not_told_of_another():
    (line,) = told(TEXT.replace("{bug: belly}", "{bug: belly, shell: belly}", 1))
    assert "steps[0].insert.shell: lies in itself" in line


def test_air_particles_have_no_balloons_in_others():
    lines = told(TEXT + "physics: {model: kosaka}\n")
    assert any("steps[0].insert: makes no sense with model kosaka" in each for each in lines)


def test_it_is_written_in_python_as_in_a_file():
    builder = RecipeBuilder("figure", units="cm")
    builder.balloon("shell", size=646, finish="clear", length=0.12, tail=0.04)
    builder.balloon("bug", size=160, length=0.03, tail=0.01)
    builder.insert(bug="belly").inflate("shell").inflate("bug").bubbles(belly=0.12, balloon="shell")
    recipe = builder.build()
    assert recipe.piece.inside == {"bug": "belly"}
    assert recipe.balloons["shell"].finish == "clear"
    assert "finish: clear" in recipe.to_yaml()
    assert Recipe.parse(Insert.example).steps[0].label == "insert: bug into cocoon"
