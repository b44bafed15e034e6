"""`tulip_link`: what may be pressed into what."""

from __future__ import annotations

import pytest

from balloon_usd.operations.tulip_link import TulipLink
from balloon_usd.plan import plan, plan_text
from balloon_usd.recipe import Recipe, RecipeError

LINK = "tulip_link: {bubble: socket, length: 7, over: root}"
CANDLE = TulipLink.example


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
    assert not recipe.piece.free_joints()
    text = plan_text(plan(recipe))
    assert "presses root into socket, which holds it" in text
    assert "socket.start = socket.end = wax.start = root.start" in text


def test_with_one_turn_nothing_is_held() -> None:
    found = plan(
        Recipe.parse(CANDLE.replace("balloon: main\n  - rest", "balloon: main\n    turns: 1\n  - rest"))
    )
    assert any("slip" in caution.what or "unwind" in caution.what for caution in found.cautions)


def test_a_popped_tulip_holds_nothing_any_more() -> None:
    popped = CANDLE + "  - pop: socket\n"
    cautions = plan(Recipe.parse(popped)).cautions
    assert any("root is held no more once socket is popped" in each.what for each in cautions)


def test_it_can_be_written_in_python_and_in_other_units() -> None:
    recipe = Recipe.parse(CANDLE)
    assert Recipe.parse(recipe.to_yaml()) == recipe
