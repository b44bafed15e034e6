"""Balls that are wider than the bubbles between which hands bring them."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.language.choices import all_of
from balloon_usd.language.lengths import cm
from balloon_usd.operations.caution import Caution

if TYPE_CHECKING:
    from collections.abc import Sequence

    from balloon_usd.operations.layout import Layout

WIDER = 1.2
"""How much wider than the bubbles beside it such a ball is at least: tubes of one size give way."""


def wide_ball(
    index: int, layout: Layout, name: str, others: Sequence[str], most: float, fails: str
) -> Caution | None:
    """Return a caution of a ball that is wider than others bear, m; None of one that is not.

    `fails`: what may become of it then, in words.
    """
    width, tube = layout.bubble(name).width, max(layout.bubble(each).width for each in others)
    if width <= max(most, WIDER * tube):
        return None
    return Caution(
        index,
        f"{name} ({cm(width)} wide) may {fails} {all_of(others)}",
        "it is wider than what gives way to it",
        f"blow it up to {cm(most)}, or less",
    )
