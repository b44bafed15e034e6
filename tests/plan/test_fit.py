"""What cannot fit where it is sent is refused with its place, the reason and the nearest that can be made."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from balloon_usd.balloon.bubble_shape import bubble_of_length
from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.tube_theory import maxwell_state
from balloon_usd.operations.closing import ROUND
from balloon_usd.plan import plan
from balloon_usd.plan.open_tube import softened
from balloon_usd.recipe import Recipe, RecipeError

ROOT = Path(__file__).parents[2]
SHIPPED = [
    path
    for folder in ("recipes", "tests/crowd/recipes", "docs/examples")
    for path in ROOT.glob(f"{folder}/**/*.yaml")
]


def refused(planned, body: str) -> list[str]:
    with pytest.raises(RecipeError) as error:
        planned(body)
    return [str(problem) for problem in error.value.problems]


@pytest.mark.parametrize("path", SHIPPED, ids=lambda path: path.stem)
def test_everything_that_is_shipped_fits(path):
    assert plan(Recipe.load(path)).bubbles


@pytest.mark.parametrize("size", ["160", "260", "350", "646"])
@pytest.mark.parametrize("rubber", ["ogden", "ogden-treloar", "gent"])
def test_bubbles_below_nine_tenths_of_the_width_of_their_tube_are_wider_than_long(size, rubber):
    law, of = softened(rubber_named(rubber)), size_named(size)
    width = 2.0 * of.radius * maxwell_state(law).bulged.a
    ball = bubble_of_length(of, law, ROUND * width)
    assert ball.diameter == pytest.approx(ball.length, rel=0.08)


@pytest.mark.parametrize("word", ["loop", "fold"])
def test_a_loop_or_fold_tighter_than_its_tube_is_refused_with_the_shortest_that_works(planned, word):
    body = f"balloons: {{a: {{size: 260, tail: 10}}}}\nsteps: [{{bubbles: {{b: 6}}}}, {{{word}: {{c: %s}}}}]"
    (text,) = refused(planned, body % 4)
    assert text.startswith(f"figure.yaml:5:39: steps[1].{word}.c: 4 cm of a 260 make a ball")
    found = re.search(rf"expected ear instead of {word}, or at least ([\d.]+) cm$", text)
    assert found is not None
    assert planned(body % found[1])
    assert planned((body % 4).replace(word, "ear"))


def test_a_lock_of_the_two_ends_of_a_ball_is_refused_where_it_stands(planned):
    body = "balloons: {a: {size: 260, tail: 10}}\nsteps:\n  - bubbles: {b: %s, c: 6}\n"
    body += "  - lock: {joints: [b.start, b.end]}\n"
    (text,) = refused(planned, body % 3)
    assert text.startswith("figure.yaml:7:5: steps[1].lock: closes b: 3 cm of a 260 make a ball")
    assert planned(body % 4.6)


def test_a_ball_that_several_locks_close_is_refused_at_the_last_of_them(planned):
    (text,) = refused(
        planned,
        """
        balloons: {a: {size: 260, tail: 10}}
        steps:
          - bubbles: {b: 9, c: 3, d: 9}
          - lock: {joints: [b.start, d.start]}
          - lock: {joints: [b.start, b.end]}
        """,
    )
    assert "steps[2].lock: closes c: 3 cm" in text


BENT = "balloons: {a: {size: 260, tail: 10}}\nsteps: [{bubbles: {b: %s}}, {bend: {b: %s}}]"


def test_a_bend_that_turns_more_than_its_bubble_has_length_for_is_refused_with_what_it_has(planned):
    (text,) = refused(planned, BENT % (2, 180))
    assert text.startswith("figure.yaml:5:39: steps[1].bend.b: 180 degrees are too tight for 2 cm of a 260")
    found = re.search(r"expected at most (\d+) degrees, or a bubble of at least ([\d.]+) cm$", text)
    assert found is not None
    assert planned(BENT % (2, found[1]))
    assert planned(BENT % (found[2], 180))


def test_a_bend_that_creases_is_told_and_a_wide_one_is_not(planned):
    def said(figure):
        return [caution.what for caution in figure.cautions if "bent" in caution.what]

    assert said(planned(BENT % (4, 180))) == ["b (4 cm) is too short to be bent by 180 degrees"]
    assert said(planned(BENT % (6, 180))) == []
    assert said(planned(BENT % (4, 90))) == []


def test_all_that_cannot_fit_is_told_at_once_also_beside_what_is_wrong_otherwise(planned):
    texts = refused(
        planned,
        """
        balloons: {a: {size: 260, tail: 10}}
        steps:
          - bubbles: {b: 2}
          - bend: {b: 180}
          - loop: {c: 3}
          - fold: {d: 2}
          - rest: e
          - lock: {joints: [b.start, e.end]}
        """,
    )
    words = [re.search(r"steps\[\d\]\.\w+", text)[0] for text in texts]
    assert words == ["steps[1].bend", "steps[2].loop", "steps[3].fold", "steps[5].lock"]
