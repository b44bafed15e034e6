"""The plan of one bubble and a rest, with what a test wants to vary."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe

if TYPE_CHECKING:
    from balloon_usd.plan import Plan

RECIPE = """
format: 1
name: small
units: cm
fps: 12
balloons:
  main: {{size: 260, length: {length}, tail: {tail}, color: red}}
steps:
  - {kind}: {{head: {head}}}
    seconds: {seconds:g}
  - rest: tail
physics: {{hold: 0.2, {physics}}}
"""


def small(
    head: float = 6.0,
    kind: str = "bubbles",
    physics: str = "model: latex",
    seconds: float = 1.0,
    length: float = 9,
    tail: float = 3,
) -> Plan:
    """Return it; lengths in cm."""
    words = {
        "head": head,
        "kind": kind,
        "physics": physics,
        "seconds": seconds,
        "length": length,
        "tail": tail,
    }
    return plan(Recipe.parse(RECIPE.format(**words)))
