"""Twins of a figure: bubbles `left_...` and `right_...` of which a recipe says the same."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING, TypeAlias

from balloon_usd.operations.aim import Aim
from balloon_usd.operations.curving import Curves
from balloon_usd.operations.moves import OTHER_SIDE
from balloon_usd.operations.reach import swung_with

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from balloon_usd.plan.strip import PlannedBubble, Strip
    from balloon_usd.recipe import Recipe

LEFT, RIGHT = "left_", "right_"
OPPOSITE = (("left", "right"), ("up", "down"), ("forward", "back"))
"""Sides that are exchanged by mirrors."""
Said: TypeAlias = tuple[str, frozenset[str]]
"""What is done with a bubble, and to which sides."""
SAME_LENGTH = 1e-6
"""Largest difference of planned lengths of twins, m."""


def twins_of(recipe: Recipe, strips: Mapping[str, Strip]) -> list[tuple[PlannedBubble, PlannedBubble]]:
    """Return the pairs of bubbles of which a recipe says the same, the left one first; none that was set
    between others as a whole, for it goes in edgewise, and none with one that sits in a tulip.
    """
    tubes = [strip for strip in strips.values() if strip.shape is None]
    by_name = {bubble.name: bubble for strip in tubes for bubble in strip.bubbles}
    twins = [
        (bubble, right)
        for name, bubble in by_name.items()
        if name.startswith(LEFT) and (right := by_name.get(RIGHT + name.removeprefix(LEFT))) is not None
    ]
    if not twins:
        return []
    tucked, later = _tucked(recipe), _said_later(recipe)
    pressed = {contact.bubble for contact in recipe.piece.contacts if contact.kind == "tulip_link"}
    return [
        (left, right)
        for left, right in twins
        if not any({left.name, right.name} <= limb for limb in tucked)
        and pressed.isdisjoint((left.name, right.name))
        and _said_equal(recipe, strips, left, right)
        and _are_mirrored(later[left.name], later[right.name])
    ]


def _tucked(recipe: Recipe) -> list[frozenset[str]]:
    """Return the bubbles of each limb that is set between others."""
    tucks = (contact for contact in recipe.piece.contacts if contact.kind == "tuck")
    limbs = (recipe.piece.after(each.step).limb(each.bubble, each.others) for each in tucks)
    return [limb.bubbles for limb in limbs if limb is not None]


def _said_later(recipe: Recipe) -> defaultdict[str, list[Said]]:
    """Return what steps do with each bubble once it is made, so that it lies or looks otherwise, and to which
    sides: it is popped, turned or curved, by itself or with what it hangs on, or brought to others.
    """
    found: defaultdict[str, list[Said]] = defaultdict(list)
    for name in recipe.piece.popped:
        found[name].append(("popped", frozenset()))
    for contact in recipe.piece.contacts:
        found[contact.bubble].append((contact.kind, frozenset()))
    for index, step in enumerate(recipe.steps):
        if isinstance(step, Aim):
            piece = recipe.piece.after(index)
            for name, sides in step.aim.items():
                limb = piece.limb(name)
                for each in (name,) if limb is None else limb.bubbles:
                    found[each].append((step.word, frozenset(sides)))
        elif isinstance(step, Curves):
            piece = recipe.piece.after(index)
            for name in step.names:
                for each in (name, *swung_with(piece, name)):
                    found[each].append((step.word, frozenset([step.point or "up"])))
    return found


def _are_mirrored(left: Sequence[Said], right: Sequence[Said]) -> bool:
    """Tell whether the same is done with both of a pair but for sides that one mirror exchanges: which one it
    is depends on how the figure lies in the hands.
    """
    for pair in OPPOSITE:
        mirror = dict(zip(pair, reversed(pair), strict=True))
        image = [(word, frozenset(mirror.get(each, each) for each in sides)) for word, sides in left]
        if image == list(right):
            return True
    return False


def _said_equal(
    recipe: Recipe, strips: Mapping[str, Strip], left: PlannedBubble, right: PlannedBubble
) -> bool:
    a, b = strips[left.balloon], strips[right.balloon]
    rests = {strip.bubbles[-1].name for strip in (a, b) if not strip.is_round}
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
