"""`tulip_link`: what may be pressed into what."""

from __future__ import annotations

import pytest

from balloon_usd.operations.tulip_link import TulipLink
from balloon_usd.plan import plan, plan_text
from balloon_usd.recipe import Recipe, RecipeError

LINK = "tulip_link: {bubble: socket, length: 7, over: root}"
CANDLE = TulipLink.example.replace(
    "  - rest: flame", "  - bubbles: {root: 3}\n    balloon: fire\n  - rest: flame"
)
CANDLE = CANDLE.replace("over: flame", "over: root")


def told(text: str) -> str:
    with pytest.raises(RecipeError) as caught:
        plan(Recipe.parse(text))
    return str(caught.value)


@pytest.mark.parametrize(
    ("steps", "message"),
    [
        ("tulip_link: {bubble: socket, length: 3, over: root}", "3 cm of a 260 are too short for a tulip"),
        ("tulip_link: {bubble: socket, length: 8, over: root}", "8 cm of a 260 are too long for a tulip"),
        ("tulip_link: {bubble: socket, length: 7, over: rot}", 'unknown bubble "rot", did you mean "root"?'),
        ("tulip_link: {bubble: socket, length: 7}", "tulip_link.over: is missing, expected it here"),
        ("tulip_link: {bubble: socket, over: root}", "tulip_link.length: is missing, expected it here"),
        ("tulip_link: {bubble: root, length: 7, over: root}", 'bubble "root" was made at'),
        ("tulip_link: {bubble: socket, length: 7, over: flame}", '"flame" is not the first bubble of "fire"'),
        ("tulip_link: {bubble: socket, length: 7, over: socket}", '"socket" is of "main" itself'),
        ("tulip_link: [socket, root]", "tulip_link"),
        (f"bubbles: {{a: 5}}\n    balloon: main\n  - {LINK}", '"socket" is not the first bubble of "main"'),
        (f"tie: {{end: root.start, to: flame.start}}\n  - {LINK}", "is twisted to root.end by now"),
        (f"{LINK}\n    seconds: 1", "1 s are too short a time to press the end of a balloon into another"),
        (f"{LINK}\n    point: up", "makes no sense with tulip_link"),
        (f"pop: root\n  - {LINK}", 'the twist between "root" and "flame" would let the gas of both out'),
    ],
)
def test_what_cannot_be_pressed_in_is_refused_with_the_reason(steps: str, message: str) -> None:
    assert message in told(CANDLE.replace(LINK, steps))


def test_without_a_balloon_it_is_not_known_whose_first_bubble_is_made() -> None:
    assert "does not say on which balloon" in told(
        CANDLE.replace("over: root}\n    balloon: main", "over: root}")
    )


def test_what_is_pressed_in_is_held_and_the_plan_says_so() -> None:
    recipe = Recipe.parse(CANDLE)
    assert recipe.piece.gripped() == {"root"}
    text = plan_text(plan(recipe))
    assert "presses root into socket, which holds it" in text
    assert "socket.start = socket.end = wax.start = root.start" in text


def test_the_twist_behind_what_is_pressed_in_is_outside_and_unwinds() -> None:
    (ends,) = Recipe.parse(CANDLE).piece.free_joints()
    assert [str(end) for end in ends] == ["root.end", "flame.start"]
    assert not Recipe.parse(TulipLink.example).piece.free_joints()


def test_with_one_turn_nothing_is_held() -> None:
    loose = CANDLE.replace("root}\n    balloon: main", "root}\n    balloon: main\n    turns: 1")
    found = plan(Recipe.parse(loose))
    assert any("may unwind" in caution.what for caution in found.cautions)
    assert "presses root into socket\n" in plan_text(found)


def test_a_wide_balloon_leans_unless_a_ball_is_twisted_off_at_its_knot() -> None:
    def cautions(text: str) -> list[str]:
        wide = text.replace("size: 160, color: orange, length: 7", "size: 350, color: orange, length: 14")
        return [each.what for each in plan(Recipe.parse(wide)).cautions]

    assert "flame may lean on socket" in cautions(TulipLink.example)
    assert "root may lean on socket" not in cautions(CANDLE.replace("root: 3", "root: 5"))


@pytest.mark.parametrize("step", ["aim: {socket: up}", "aim: {root: up}"])
def test_neither_is_turned_away_from_the_other(step: str) -> None:
    expected = "would take root away from socket, which holds it: expected this step before that one"
    assert expected in told(f"{CANDLE}  - {step}\n")


def test_a_balloon_whose_first_bubble_was_cut_off_has_no_knot() -> None:
    ear = "  - ear: {e: 3}\n    balloon: fire\n  - cut: root\n  - rest: flame"
    sealed = CANDLE.replace("  - rest: flame", ear).replace("over: root", "over: e")
    assert '"fire" has no knot any more, "root" is popped' in told(sealed)


def test_each_link_takes_the_knots_of_two_balloons() -> None:
    assert "2 balloons could make it" in plan_text(plan(Recipe.parse(CANDLE)))


def test_a_popped_tulip_holds_nothing_any_more() -> None:
    popped = CANDLE + "  - pop: socket\n"
    cautions = plan(Recipe.parse(popped)).cautions
    assert any("root is held no more once socket is popped" in each.what for each in cautions)


def test_it_can_be_written_in_python_and_in_other_units() -> None:
    recipe = Recipe.parse(CANDLE)
    assert Recipe.parse(recipe.to_yaml()) == recipe
