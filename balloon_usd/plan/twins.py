"""Twins of a figure: bubbles `left_...` and `right_...` of which a recipe says the same."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.operations.moves import OTHER_SIDE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from balloon_usd.plan.strip import PlannedBubble, Strip
    from balloon_usd.recipe import Recipe

LEFT, RIGHT = "left_", "right_"
SAME_LENGTH = 1e-6
"""Largest difference of planned lengths of twins, m."""


def twins_of(recipe: Recipe, strips: Mapping[str, Strip]) -> list[tuple[PlannedBubble, PlannedBubble]]:
    """Return the pairs of bubbles of which a recipe says the same, the left one first; none that was set
    between others as a whole, for it goes in edgewise, and none with one that sits in a tulip.
    """
    tucked = _tucked(recipe)
    pressed = {contact.bubble for contact in recipe.piece.contacts if contact.kind == "tulip_link"}
    tubes = [strip for strip in strips.values() if strip.shape is None]
    by_name = {bubble.name: bubble for strip in tubes for bubble in strip.bubbles}
    twins = [
        (bubble, by_name.get(RIGHT + name.removeprefix(LEFT)))
        for name, bubble in by_name.items()
        if name.startswith(LEFT)
    ]
    return [
        (left, right)
        for left, right in twins
        if right is not None
        and not any({left.name, right.name} <= limb for limb in tucked)
        and pressed.isdisjoint((left.name, right.name))
        and _said_equal(recipe, strips, left, right)
    ]


def _tucked(recipe: Recipe) -> list[frozenset[str]]:
    """Return the bubbles of each limb that is set between others."""
    tucks = (contact for contact in recipe.piece.contacts if contact.kind == "tuck")
    limbs = (recipe.piece.after(each.step).limb(each.bubble, each.others) for each in tucks)
    return [limb.bubbles for limb in limbs if limb is not None]


def _said_equal(
    recipe: Recipe, strips: Mapping[str, Strip], left: PlannedBubble, right: PlannedBubble
) -> bool:
    a, b = strips[left.balloon], strips[right.balloon]
    rests = {a.bubbles[-1].name, b.bubbles[-1].name}
    return (
        left.kind == right.kind
        and abs(left.length - right.length) < SAME_LENGTH
        and (a.size, a.rubber) == (b.size, b.rubber)
        and rests.isdisjoint({left.name, right.name})
        and _point(recipe, right) == _mirrored_point(_point(recipe, left))
    )


def _point(recipe: Recipe, bubble: PlannedBubble) -> str:
    """Return where the step that makes a bubble points; "" if it does not say so."""
    return getattr(recipe.steps[bubble.step], "point", None) or ""


def _mirrored_point(point: str) -> str:
    """Return where the right one of a pair points if the left one points there."""
    return OTHER_SIDE.get(point, point)
