"""`marriage`: two rows of bubbles side by side, pair rolled through pair."""

from __future__ import annotations

import pytest

from balloon_usd.operations.marriage import Marriage
from balloon_usd.operations.moves import PassThrough, Weld
from balloon_usd.plan import plan
from balloon_usd.plan.report import plan_text
from balloon_usd.recipe import Recipe, RecipeBuilder, RecipeError

HEAD = Marriage.example[: Marriage.example.index("  - marriage")]


def text(row):
    return f"{HEAD}  - {{marriage: {row}, balloon: main}}\n"


def test_each_pair_becomes_a_closed_ring_and_every_second_bubble_lies_in_the_pair_before():
    piece = Recipe.parse(Marriage.example).piece
    pairs = [(f"white_{k}", f"red_{k}") for k in (1, 2, 3, 4)]
    assert all(piece.is_closed(pair) for pair in pairs)
    held = [(each.kind, each.bubble, each.others) for each in piece.contacts]
    assert held == [("roll", "white_2", pairs[0]), ("roll", "white_4", pairs[2])]


def test_each_is_rolled_before_its_pair_is_closed():
    found = plan(Recipe.parse(Marriage.example))
    done = [
        move.bubble if isinstance(move, PassThrough) else len(move.rings)
        for move in found.choreography.moves
        if isinstance(move, (PassThrough, Weld))
    ]
    assert done == [2, 2, "white_2", 2, 2, "white_4", 2]
    assert found.cautions == ()


def test_the_plan_says_what_is_married_and_what_is_rolled():
    told = plan_text(plan(Recipe.parse(Marriage.example)))
    assert "step 2 marries red_1.start, white_1.start" in told
    assert "step 2 rolls white_4 between white_3, red_3, which hold it" in told


def test_it_is_written_as_it_was_read():
    builder = (
        RecipeBuilder("two_tone").balloon("red", size="260", tail=0.08).balloon("main", size="260", tail=0.08)
    )
    builder = builder.bubbles(red_1=0.08, red_2=0.08, balloon="red")
    built = builder.marriage({"white_1": 0.08, "white_2": "8 cm"}, ["red_1", "red_2"], balloon="main").build()
    assert Recipe.parse(built.to_yaml()).steps == built.steps


REFUSED = {
    "no row": ("{bubbles: {a: 8, b: 8}, to: [red_1, red_3]}", "red_1, red_3 are no row"),
    "backwards": ("{bubbles: {a: 8, b: 8}, to: [red_2, red_1]}", "red_2, red_1 are no row"),
    "too many": ("{bubbles: {a: 8, b: 8}, to: [red_1, red_2, red_3]}", "3 bubbles for 2, expected as many"),
    "one": ("{bubbles: {a: 8}, to: [red_1, red_2]}", "marriage.bubbles: 1 entry here, expected at least 2"),
    "unknown": (
        "{bubbles: {a: 8, b: 8}, to: [red_1, rde_2]}",
        'unknown bubble "rde_2", did you mean "red_2"',
    ),
    "joints": ("{bubbles: {a: 8, b: 8}, to: [red_1.end, red_2.end]}", "is no name"),
    "no list": ("{bubbles: {a: 8, b: 8}, to: red_1}", "expected a list"),
    "names that are taken": ("{bubbles: {red_1: 8, b: 8}, to: [red_1, red_2]}", "expected a new name"),
    "more than there is": (
        "{bubbles: {a: 80, b: 8}, to: [red_1, red_2]}",
        'marriage.bubbles.a: "a" of 80 cm',
    ),
    "far too long": (
        "{bubbles: {a: 8, b: 20}, to: [red_1, red_2]}",
        "b is 20 cm long, and a and red_1 only 8",
    ),
}


@pytest.mark.parametrize(("row", "told"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_be_married_is_refused_with_the_reason(row, told):
    with pytest.raises(RecipeError) as caught:
        plan(Recipe.parse(text(row)))
    assert told in str(caught.value)


def test_a_balloon_is_not_married_to_itself():
    alone = text("{bubbles: {a: 8, b: 8}, to: [red_1, red_2]}").replace("balloon: main", "balloon: red")
    with pytest.raises(RecipeError, match="red_1 is of the same balloon, expected bubbles of another"):
        Recipe.parse(alone)


def test_what_closes_on_itself_is_not_married():
    rings = HEAD + "  - {loop: {ring: 20}, balloon: red}\n"
    row = "  - {marriage: {bubbles: {a: 8, b: 8}, to: [red_4, ring]}, balloon: main}\n"
    with pytest.raises(RecipeError, match="ring closes on itself, expected bubbles with two ends apart"):
        Recipe.parse(rings + row)


FIRST = "  - {marriage: {bubbles: {a: 8, b: 8}, to: [red_1, red_2]}, balloon: main}\n"


def test_a_row_is_married_on_where_it_ends_and_where_both_are_locked_already():
    after = "  - {marriage: {bubbles: {c: 8, d: 8}, to: [red_3, red_4]}, balloon: main}\n"
    piece = plan(Recipe.parse(HEAD + FIRST + after)).recipe.piece
    assert all(piece.is_closed(pair) for pair in (("a", "red_1"), ("c", "red_3"), ("d", "red_4")))
    necks = "  - {bubbles: {w: 5}, balloon: main}\n  - lock: {joints: [red_1.end, w.end]}\n"
    found = plan(Recipe.parse(HEAD + necks + FIRST.replace("[red_1, red_2]", "[red_2, red_3]")))
    assert found.recipe.piece.is_closed(("a", "red_2"))
    assert sum(isinstance(move, Weld) for move in found.choreography.moves) == 3


@pytest.mark.parametrize(
    ("joined", "to", "told"),
    [
        ("red_1.end", "[red_1, red_2]", "a and red_1 form no closed pair"),
        ("red_1.end", "[red_3, red_4]", "red_2 would be closed on itself"),
    ],
)
def test_rows_that_are_joined_elsewhere_are_not_married(joined, to, told):
    locked = f"  - {{bubbles: {{w: 5}}, balloon: main}}\n  - lock: {{joints: [{joined}, w.end]}}\n"
    with pytest.raises(RecipeError, match=f"{told}, for rows are joined already"):
        Recipe.parse(HEAD + locked + FIRST.replace("[red_1, red_2]", to))


def test_no_maker_marries_in_a_moment():
    with pytest.raises(RecipeError, match="2 s are too short a time to marry 2 bubbles, expected at least"):
        plan(Recipe.parse(HEAD + FIRST.replace("balloon: main", "balloon: main, seconds: 2")))


def test_pairs_of_unequal_lengths_are_cautioned():
    told = plan(Recipe.parse(text("{bubbles: {a: 6, b: 8}, to: [red_1, red_2]}"))).cautions
    assert "a and red_1 are 6 cm and 8 cm long" in [caution.what for caution in told]
