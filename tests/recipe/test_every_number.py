"""Every number of a recipe, given what no number should be: one message at its place, with what was expected."""

from __future__ import annotations

import pytest

from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.recipe.kosaka import Kosaka

IMPOSSIBLE = [
    "-1",
    ".nan",
    ".inf",
    "-.inf",
    "1e300",
    "-1e-300",
    "true",
    "many",
    "'3 apples'",
    "[1]",
    "{a: 1}",
    "''",
]
HEAD = "format: 1\nname: t\nunits: cm\n"
AFTER = "steps: [bubbles: {a: 5}]\n"
TUBE = "balloons:\n  main: {size: 260, tail: 10}\n"
PHYSICS = ["gravity", "friction", "substeps", "hold", "leak"]
LENGTHS = ["tail", "inflated", "radius", "length", "thickness"]
NUMBERS = [
    *[(f"physics.{key}", f"{HEAD}{TUBE}{AFTER}physics:\n  {key}: ") for key in PHYSICS],
    *[
        (f"physics.kosaka.{key}", f"{HEAD}{TUBE}{AFTER}physics:\n  model: kosaka\n  kosaka:\n    {key}: ")
        for key in Kosaka.model_fields
    ],
    *[
        (
            f"balloons.main.{key}",
            f"{HEAD}{AFTER}balloons:\n  main:\n    size: 260\n"
            + ("" if key in {"tail", "inflated"} else "    tail: 1\n")
            + f"    {key}: ",
        )
        for key in LENGTHS
    ],
    ("fps", f"{HEAD}{TUBE}{AFTER}fps: "),
    ("steps[0].wait", f"{HEAD}{TUBE}steps:\n  - wait: "),
    ("steps[0].bubbles.a", f"{HEAD}{TUBE}steps:\n  - bubbles:\n      a: "),
    ("steps[0].turns", f"{HEAD}{TUBE}steps:\n  - bubbles: {{a: 5}}\n    turns: "),
    ("steps[0].seconds", f"{HEAD}{TUBE}steps:\n  - bubbles: {{a: 5}}\n    seconds: "),
]


@pytest.mark.parametrize("value", IMPOSSIBLE)
@pytest.mark.parametrize(("path", "text"), NUMBERS, ids=[path for path, _ in NUMBERS])
def test_what_is_no_number_for_an_entry_is_refused_at_its_place(path: str, text: str, value: str) -> None:
    with pytest.raises(RecipeError) as caught:
        Recipe.parse(text + value + "\n", file="t.yaml")
    (problem,) = caught.value.problems
    assert problem.path == path
    assert problem.line == text.count("\n") + 1
    assert "expected" in problem.text
