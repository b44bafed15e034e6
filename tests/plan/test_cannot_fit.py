"""Recipes of somebody who wants walls in walls: each is refused, or told of, with a reason."""

from __future__ import annotations

import re

import pytest

from balloon_usd.recipe import RecipeError

ONE = "balloons: {a: {size: 260, length: 100, tail: 15}}\nsteps: [%s]"
TWO = """
balloons: {a: {size: 260, tail: 15}, b: {size: 260, tail: 8}}
steps:
  - {bubbles: {p: 6, q: 6, r: 6}, balloon: a}
  - {bubbles: {s: %s}, balloon: b}
  - lock: {joints: [p.start, s.start]}
  - lock: {joints: [r.end, s.end]}
"""


def many(kind: str, count: int, length: float) -> str:
    return f"{kind}: {{{', '.join(f'b{k}: {length}' for k in range(count))}}}"


REFUSED = {
    "a loop tighter than its tube": (ONE % "bubbles: {b: 6}, loop: {c: 4}", r"steps\[1\]\.loop\.c: 4 cm"),
    "a fold tighter than its tube": (ONE % "bubbles: {b: 6}, fold: {c: 2}", r"steps\[1\]\.fold\.c: 2 cm"),
    "a ball locked to itself": (
        ONE % "bubbles: {b: 3, c: 6}, lock: {joints: [b.start, b.end]}",
        r"steps\[1\]\.lock: closes b: 3 cm of a 260 make a ball",
    ),
    "a joint locked to itself": (
        ONE % "bubbles: {b: 6, c: 6}, lock: {joints: [b.end, c.start]}",
        "these joints are already one",
    ),
    "thirty pellets at one spot": (ONE % many("ear", 30, 2), "about which there is room for 13"),
    "every joint of a chain of balls at one spot": (
        ONE % (many("bubbles", 26, 5) + f", lock: {{joints: [{', '.join(f'b{k}.end' for k in range(26))}]}}"),
        "would meet in one joint",
    ),
    "half a turn of a ball": (ONE % "bubbles: {b: 6, c: 2}, bend: {c: 180}", "180 degrees are too tight"),
}
TOLD = {
    "a loop without a hole": (ONE % "loop: {b: 8}", "too short for a loop"),
    "ten small ears at one spot": (ONE % many("ear", 10, 3), "10 bubbles of at most 3 cm crowd"),
    "a triangle with one long side": (
        ONE % "bubbles: {b: 30, c: 6, d: 6}, lock: [b, c, d]",
        r"b \(30 cm\) is longer than c and d together \(12 cm\)",
    ),
    "a ring of two balloons with one long side": (
        TWO % 40,
        r"s \(40 cm\) is longer than p, q and r together",
    ),
    "a pair of a long and a short one": (ONE % "bubbles: {b: 24, c: 3}, lock: [b, c]", "an unequal pair"),
    "the same pair by its joints": (
        ONE % "bubbles: {b: 24, c: 3}, lock: {joints: [b.start, c.end]}",
        "an unequal pair",
    ),
    "a crease": (ONE % "bubbles: {b: 6, c: 4}, bend: {c: 180}", "too short to be bent by 180 degrees"),
    "two ends bent over one bubble": (
        ONE % "bubbles: {b: 10, c: 10, d: 10, e: 10}, bend: {c: 180}, bend: {e: 180}",
        "bends lay a_rest onto b",
    ),
}


@pytest.mark.parametrize(("body", "told"), REFUSED.values(), ids=REFUSED)
def test_what_cannot_fit_is_refused_with_the_reason(planned, body, told):
    with pytest.raises(RecipeError, match=rf"figure\.yaml:\d+:\d+: .*{told}.*expected "):
        planned(body)


@pytest.mark.parametrize(("body", "told"), TOLD.values(), ids=TOLD)
def test_what_fits_badly_is_told_with_reason_and_remedy(planned, body, told):
    found = [caution for caution in planned(body).cautions if re.search(told, caution.what)]
    assert found
    assert all(caution.why and caution.remedy for caution in found)
