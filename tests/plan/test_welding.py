from __future__ import annotations

import pytest

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe, RecipeError


def chain(steps: str, bubbles: int = 34) -> str:
    lengths = ", ".join(f"b{number}: 12" for number in range(bubbles))
    head = "format: 1\nname: chain\nunits: cm\nballoons: {main: {size: 260, length: 130, tail: 20}}\n"
    return f"{head}steps:\n  - bubbles: {{{lengths}}}\n{steps}"


def lock(first: int, last: int) -> str:
    return f"  - lock: {{joints: [{', '.join(f'b{number}.end' for number in range(first, last))}]}}\n"


def test_thirty_two_joints_can_be_twisted_into_one_and_no_more():
    assert plan(Recipe.parse(chain(lock(0, 32)))).bubbles
    with pytest.raises(
        RecipeError, match=r":7:5: steps\[1\]: 33 joints would be twisted into one, expected at most 32$"
    ):
        plan(Recipe.parse(chain(lock(0, 33))))


def test_joints_that_hang_together_already_count():
    with pytest.raises(RecipeError, match=r"steps\[2\]: 33 joints"):
        plan(Recipe.parse(chain(lock(0, 17) + lock(16, 33))))
