"""Plans that several tests look at."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

import pytest

from balloon_usd.plan import Plan, plan
from balloon_usd.recipe import Recipe

if TYPE_CHECKING:
    from collections.abc import Callable

HEAD = "format: 1\nname: figure\nunits: cm\n"

DOG = """
title: Classic dog
source: Kosaka 2008, fig. 2.4
balloons:
  main: {size: 260, color: red, tail: 10}
steps:
  - bubbles: {nose: 10, left_ear: 10, right_ear: 10}
  - lock: [left_ear, right_ear]
  - bubbles: {neck: 7, left_foreleg: 12, right_foreleg: 12}
  - lock: [left_foreleg, right_foreleg]
  - bubbles: {body: 15, left_hindleg: 12, right_hindleg: 12}
  - lock: [left_hindleg, right_hindleg]
  - rest: tail
"""


@pytest.fixture(scope="session")
def planned() -> Callable[[str], Plan]:
    """Plan the body of a recipe in centimetres."""
    return lambda body: plan(Recipe.parse(HEAD + textwrap.dedent(body), file="figure.yaml"))


@pytest.fixture(scope="session")
def dog(planned) -> Plan:
    """The dog of the thesis."""
    return planned(DOG)
