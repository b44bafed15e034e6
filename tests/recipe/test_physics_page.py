"""The tables of the physics and of the particle model's constants in the reference say what there is."""

from __future__ import annotations

import math
import re
from pathlib import Path

import pytest

from balloon_usd.balloon.detail import detail_named
from balloon_usd.language.quantities import Between
from balloon_usd.plan import plan
from balloon_usd.recipe import Physics, Recipe
from balloon_usd.recipe.kosaka import KOSAKA_LENGTHS, Kosaka
from balloon_usd.solver.kosaka.parameters import SUBSTEPS, parameters

PAGE = (Path(__file__).parents[2] / "docs/reference/physics.md").read_text(encoding="utf-8")
CAPSULE = (
    "format: 1\nname: air\nunits: cm\nballoons: {main: {size: 260, capsule: 20}}\n"
    "steps: [wait: 1]\nphysics: {model: kosaka}\n"
)


def rows() -> list[tuple[str, str, str]]:
    """Key, unit and default of every constant, as the table has them."""
    table = PAGE.partition("| key | unit | if absent | meaning |\n")[2].partition("\n\n")[0]
    cells = [[cell.strip() for cell in row.strip("|").split("|")] for row in table.splitlines()[1:]]
    found = []
    for keys, units, default, _ in cells:
        names, each = re.findall(r"`(\w+)`", keys), units.split(", ")
        found += [(name, each[k % len(each)], default) for k, name in enumerate(names)]
    return found


WITH_NUMBERS = [
    (key, float(default.removesuffix(" mm"))) for key, _, default in rows() if default[0].isdigit()
]


def test_every_key_of_the_physics_stands_in_its_table_once() -> None:
    table = PAGE.partition("| key | default | meaning |\n")[2].partition("\n\n")[0]
    keys = [re.findall(r"`(\w+)`", row)[0] for row in table.splitlines()[1:]]
    assert sorted(keys) == sorted(Physics.model_fields)


def test_every_constant_stands_in_the_table_once() -> None:
    assert sorted(key for key, _, _ in rows()) == sorted(Kosaka.model_fields)


def test_lengths_are_named_so_and_only_they() -> None:
    assert {key for key, unit, _ in rows() if unit == "length"} == set(KOSAKA_LENGTHS)


def unit_of(key: str) -> str:
    """Unit in which messages tell the range of a constant."""
    field = Kosaka.model_fields[key]
    annotated = field.metadata or field.annotation.__args__[0].__metadata__
    return next(rule.unit for rule in annotated if isinstance(rule, Between))


@pytest.mark.parametrize(("key", "unit"), [(key, unit) for key, unit, _ in rows() if unit != "length"])
def test_units_are_those_of_the_messages(key: str, unit: str) -> None:
    assert unit_of(key) == unit


@pytest.mark.parametrize(("key", "default"), WITH_NUMBERS, ids=[key for key, _ in WITH_NUMBERS])
def test_the_numbers_are_those_of_the_rule_for_a_260(key: str, default: float) -> None:
    strip = plan(Recipe.parse(CAPSULE)).strips["main"]
    width = 2.0 * math.pi * strip.inflated_radius / detail_named("draft").capsule_around
    law = parameters(Kosaka(), strip.inflated_radius, width, 1.0 / (24.0 * SUBSTEPS))
    scale = 1e3 if key in KOSAKA_LENGTHS else 1.0
    assert scale * getattr(law, key) == pytest.approx(default, rel=0.01)
