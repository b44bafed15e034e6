"""The plan of two bubbles that are locked beside a nose."""

from __future__ import annotations

from typing import TYPE_CHECKING

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe

if TYPE_CHECKING:
    from balloon_usd.plan import Plan

PAIR = """
format: 1
name: pair
units: cm
fps: 12
balloons:
  main: {size: 260, length: 14, tail: 5}
steps:
  - bubbles: {nose: 4, left: 6, right: 6}
  - lock: [left, right]
  - rest: tail
physics: {hold: 0.5}
"""


def locked_pair() -> Plan:
    """Return it."""
    return plan(Recipe.parse(PAIR))
