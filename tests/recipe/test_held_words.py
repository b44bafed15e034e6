"""Which joints must hold: what a recipe may say, and what is refused."""

from __future__ import annotations

import pytest

from balloon_usd.language.joint import Joint
from balloon_usd.recipe import Recipe, RecipeError

HEAD = """\
format: 1
name: head
units: cm
balloons: {main: {size: 260, tail: 10}}
steps:
  - bubbles: {nose: 8, left_ear: 6, right_ear: 6}
  - lock: [left_ear, right_ear]
"""


@pytest.mark.parametrize(
    ("written", "meant"),
    [
        ("all", "all"),
        ("none", "none"),
        ("planned", "planned"),
        ("[nose.end, left_ear.end]", (Joint("nose", "end"), Joint("left_ear", "end"))),
    ],
)
def test_all_none_or_some_joints_must_hold(written, meant):
    recipe = Recipe.parse(f"{HEAD}must_hold: {written}\n")
    assert recipe.must_hold == meant
    assert Recipe.parse(recipe.to_yaml()) == recipe
    assert Recipe.parse(HEAD).must_hold == "all"


@pytest.mark.parametrize(
    ("written", "told"),
    [
        ("most", '"most" does not fit, expected all, planned, none, or joints such as [nose.end]'),
        ("nose.end", '"nose.end" does not fit, expected all, planned, none, or joints such as [nose.end]'),
        ("true", "true does not fit, expected all, planned, none, or joints such as [nose.end]"),
        ("{joints: [nose.end]}", "does not fit, expected all, planned, none, or joints such as [nose.end]"),
        ("[]", "must_hold: is empty, expected at least one entry"),
        ("[nose]", '"nose" is no joint, expected a bubble and its end'),
        ("[noes.end]", 'must_hold[0]: unknown bubble "noes", did you mean "nose"?'),
        ("[nose.end, main_rest.end]", "must_hold[1]: main_rest.end is an end of its balloon"),
        (
            "[nose.start]",
            "must_hold[0]: nose.start is an end of its balloon, expected a joint at which bubbles meet",
        ),
        ("3", "must_hold: "),
    ],
)
def test_what_is_no_joint_cannot_hold(written, told):
    with pytest.raises(RecipeError) as caught:
        Recipe.parse(f"{HEAD}must_hold: {written}\n")
    assert told in str(caught.value)
    assert len(caught.value.problems) == 1
