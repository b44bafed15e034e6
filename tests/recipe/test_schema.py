"""The JSON Schema that editors use says the same as the reader."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, cast

import pytest

from balloon_usd.language.yaml_reader import read_yaml
from balloon_usd.operations.press import PressedBubble
from balloon_usd.operations.table import OPERATIONS
from balloon_usd.recipe import Balloon, Physics, Recipe, RecipeError, recipe_schema
from balloon_usd.recipe.kosaka import Kosaka

RECIPES = sorted((Path(__file__).parents[2] / "recipes").rglob("*.yaml"))
SCHEMA = recipe_schema()
HEAD = "format: 1\nname: dog\nunits: cm\nballoons:\n  main: {size: 260, tail: 10}\nsteps:\n"
ABC = "  - bubbles: {a: 10, b: 5, c: 4 in}\n"

TYPES: dict[str, tuple[type, ...]] = {
    "object": (dict,),
    "array": (list, tuple),
    "string": (str,),
    "integer": (int,),
    "number": (int, float),
    "boolean": (bool,),
}
REMARKS = {"title", "description", "default", "$defs", "$schema"}


def accepts(schema: Mapping[str, Any], value: Any) -> bool:
    """Check a value against a schema; an unknown keyword is an error of this test."""
    checks = {
        "$ref": lambda rule: accepts(SCHEMA["$defs"][rule.removeprefix("#/$defs/")], value),
        "anyOf": lambda rule: any(accepts(part, value) for part in rule),
        "oneOf": lambda rule: sum(accepts(part, value) for part in rule) == 1,
        "type": lambda rule: (
            isinstance(value, TYPES[rule]) and isinstance(value, bool) == (rule == "boolean")
        ),
        "enum": lambda rule: value in rule,
        "const": lambda rule: value == rule and type(value) is type(rule),
        "pattern": lambda rule: not isinstance(value, str) or re.search(rule, value) is not None,
        "minLength": lambda rule: not isinstance(value, str) or len(value) >= rule,
        "maxLength": lambda rule: not isinstance(value, str) or len(value) <= rule,
        "minimum": lambda rule: not isinstance(value, (int, float)) or value >= rule,
        "maximum": lambda rule: not isinstance(value, (int, float)) or value <= rule,
        "exclusiveMinimum": lambda rule: not isinstance(value, (int, float)) or value > rule,
        "multipleOf": lambda rule: not isinstance(value, (int, float)) or value % rule == 0,
        "minItems": lambda rule: not isinstance(value, list) or len(value) >= rule,
        "maxItems": lambda rule: not isinstance(value, list) or len(value) <= rule,
        "items": lambda rule: not isinstance(value, list) or all(accepts(rule, item) for item in value),
        "prefixItems": lambda rule: (
            not isinstance(value, list)
            or all(accepts(part, item) for part, item in zip(rule, value, strict=False))
        ),
        "minProperties": lambda rule: not isinstance(value, dict) or len(value) >= rule,
        "required": lambda rule: not isinstance(value, dict) or set(rule) <= set(value),
        "propertyNames": lambda rule: not isinstance(value, dict) or all(accepts(rule, key) for key in value),
        "properties": lambda rule: accepts_entries(rule, value),
        "patternProperties": lambda rule: accepts_matching(rule, value),
        "additionalProperties": lambda rule: (
            not isinstance(value, dict)
            or rule is not False
            or all(
                key in schema.get("properties", ())
                or any(re.search(p, key) for p in schema.get("patternProperties", ()))
                for key in value
            )
        ),
    }
    return all(checks[keyword](rule) for keyword, rule in schema.items() if keyword not in REMARKS)


def accepts_entries(rules: Mapping[str, Any], value: Any) -> bool:
    return not isinstance(value, dict) or all(
        accepts(rules[key], entry) for key, entry in value.items() if key in rules
    )


def accepts_matching(rules: Mapping[str, Any], value: Any) -> bool:
    return not isinstance(value, dict) or all(
        accepts(rule, entry)
        for pattern, rule in rules.items()
        for key, entry in value.items()
        if re.search(pattern, key)
    )


def plain(text: str) -> object:
    return read_yaml(text, "f").data


def parts(schema: Any) -> Iterator[dict[str, Any]]:
    if isinstance(schema, dict):
        yield cast("dict[str, Any]", schema)
        for entry in schema.values():
            yield from parts(entry)
    elif isinstance(schema, list):
        for entry in schema:
            yield from parts(entry)


def test_there_are_shipped_recipes() -> None:
    assert len(RECIPES) >= 6


@pytest.mark.parametrize("path", RECIPES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_the_schema_accepts_a_shipped_recipe(path: Path) -> None:
    assert accepts(SCHEMA, plain(path.read_text(encoding="utf-8")))


EVERYTHING = (
    "format: 1\nname: all\ntitle: t\nsource: s\nunits: in\nfps: 30\n"
    "balloons:\n  m: {size: '160', color: [0, 0.5, 1], inflated: 30 cm, radius: 5 mm, length: 1 m, thickness: 0.2 mm}\n"
    "steps:\n  - bubbles: {a: 4, b: '4\"', c: 5}\n    balloon: m\n    turns: 2.5\n    seconds: 1\n    note: n\n"
    "  - loop: {d: 8}\n    point: up\n  - fold: {e: 8}\n  - ear: {f: 1.5}\n  - lock: [a, b]\n"
    "  - lock: {joints: [b.start, c.end]}\n  - rest: g\n  - bend: {g: 60 deg, a: 30}\n"
    "  - press: {bubble: a, at: 2, depth: 1 cm}\n  - press: {bubble: g, force: 2 N}\n  - wait: 1\n"
    "physics: {model: latex, rubber: gent, softening: false, gravity: 9.8, friction: 1, substeps: 40, burst: stop,"
    " hold: 1, leak: 2 days, mass_scaling: none}\n"
)


AIR = (
    "format: 1\nname: air\nunits: cm\nballoons: {main: {size: 260, capsule: 20}}\nsteps: [wait: 1]\n"
    "physics: {model: kosaka, kosaka: {swell: 0.1, natural: 0.5, ks: 1e5, kd: 1, alpha: 1, beta: 1, push: 1, gamma: 0.1,"
    " re: 1, air_offset: 1, contact_offset: 2 mm, leak_offset: 1, spacing: 0.7, drag: 0, grading: 0,"
    " calming: 0, force_limit: 10, elongation_limit: 1}}\n"
)


SHAPES = (
    "format: 1\nname: shapes\nunits: cm\nsteps: [wait: 1]\nballoons:\n"
    "  heart: {mesh: heart.obj, unit: mm, swell: 1.5, at: [0, -30, 1 ft], color: red, thickness: 0.2 mm}\n"
)


@pytest.mark.parametrize("text", [EVERYTHING, AIR, SHAPES], ids=["latex", "kosaka", "meshes"])
def test_the_schema_and_the_reader_accept_a_recipe_with_every_key(text: str) -> None:
    assert Recipe.parse(text).steps[-1].word == "wait"
    assert accepts(SCHEMA, plain(text))


def test_these_recipes_try_every_constant_of_the_particle_model() -> None:
    assert Recipe.parse(AIR).physics.kosaka.model_fields_set == set(Kosaka.model_fields)


WRONG = [
    "format: 2\nname: d\nballoons: {m: {size: 260, tail: 1 cm}}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {m: {size: 260, tail: 1 cm}}\nsteps: []\n",
    "format: 1\nname: 9d\nballoons: {m: {size: 260, tail: 1 cm}}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {m: {size: 261, tail: 1 cm}}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {m: {tail: 1 cm}}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {m: {size: 260, tail: -1}}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {m: {size: 260, tail: 1 yd}}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {m: {size: 260, tail: 1 cm, colour: red}}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {m: {size: 260, tail: 1 cm, color: [1, 2, 3]}}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {m: {size: 260, tail: 1 cm, color: rde}}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {m: {size: 260, mesh: a.obj}}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {m: {mesh: ''}}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {m: {mesh: a.obj, swell: 6}}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {m: {mesh: a.obj, unit: yd}}\nsteps: [wait: 1]\n",
    "format: 1\nname: d\nballoons: {m: {mesh: a.obj, at: [0 m, 1 m]}}\nsteps: [wait: 1]\n",
    HEAD + "  - {}\n",
    HEAD + "  - bubbles: {}\n",
    HEAD + "  - bubbles: {a: 0}\n",
    HEAD + "  - bubbles: {a: 1}\n    rest: b\n",
    HEAD + "  - bubbels: {a: 1}\n",
    HEAD + ABC + "  - lock: a\n",
    HEAD + ABC + "  - lock: {joints: [a.middle, b.end]}\n",
    HEAD + ABC + "  - bend: {a: 200}\n",
    HEAD + "  - bubbles: {a: 1}\n    turns: 2.3\n",
    HEAD + "  - loop: {a: 1}\n    point: sideways\n",
    HEAD + "  - wait: 0.1\n",
    HEAD + ABC + "  - press: {depth: 1}\n",
    HEAD + ABC + "  - press: {bubble: a, depth: 0}\n",
    HEAD + ABC + "  - press: {bubble: a, force: 2 kN}\n",
    HEAD + ABC + "  - press: {bubble: a, force: 101}\n",
    HEAD + ABC + "  - press: {bubble: a, depth: 1, deep: 2}\n",
    HEAD + ABC + "physics: {model: springs}\n",
    HEAD + ABC + "physics: {model: kosaka, kosaka: {ks: 0}}\n",
    HEAD + ABC + "physics: {model: kosaka, kosaka: {re: 1 yd}}\n",
    HEAD + ABC + "physics: {model: kosaka, kosaka: {kss: 2}}\n",
    HEAD + ABC + "physics: {leak: 6 weeks}\n",
    HEAD + ABC + "physics: {leak: 0}\n",
    HEAD + ABC + "physics: {rubber: gum}\n",
    HEAD + ABC + "physics: {softening: on}\n",
    HEAD + ABC + "physics: {substeps: 20.5}\n",
    HEAD + ABC + "fps: 500\n",
    HEAD + ABC + "unit: miles\n",
]


WRITTEN = """\
format: 1
name: petals
units: cm
let: {size: 3, skin: red, count: 6, long: 2 hands}
balloons:
  petal_<k>: {repeat: {k: = count}, size: 260, color: = skin, tail: = size * 2}
steps:
  - repeat: {k: 2 to count}
    note: each is joined to the one before it
    steps:
      - {bubbles: {b_<k>: = 2 * size}, balloon: petal_<k>, burp: = 10 * 2}
      - repeat: {side: [left, right], at: [1, 2]}
        steps: [{loop: {<side>_<k>: = long}, balloon: petal_<k>, point: <side>, turns: = at + 1}]
  - {bubbles: {b_1: 2 fingers}, balloon: petal_1}
  - lock: {joints: [b_1.start, b_<count>.start]}
"""


def test_the_schema_and_the_reader_take_repeats_formulas_and_named_values() -> None:
    assert len(Recipe.parse(WRITTEN).steps) == 17
    assert accepts(SCHEMA, plain(WRITTEN))


@pytest.mark.parametrize(
    ("right", "wrong"),
    [
        ("let: {size: 3,", "let: {size: [3],"),
        ("let: {", "let: {a b: 1, "),
        ("{k: 2 to count}", "{k k: 2}"),
        ("name: petals", "name: petals_<size>"),
        ("{k: = count}, size", "{k: 0}, size"),
        ("{k: 2 to count}", "{}"),
        ("    note: each is", "    turns: 3\n    note: each is"),
        ("- repeat: {k: 2", "- repeats: {k: 2"),
        (
            "steps: [{loop: {<side>_<k>: = long}, balloon: petal_<k>, point: <side>, turns: = at + 1}]",
            "steps: []",
        ),
    ],
)
def test_the_schema_and_the_reader_refuse_the_same_slips_in_repeats(right: str, wrong: str) -> None:
    text = WRITTEN.replace(right, wrong)
    assert text != WRITTEN
    with pytest.raises(RecipeError):
        Recipe.parse(text)
    assert not accepts(SCHEMA, plain(text))


def test_the_schema_and_the_reader_take_numbers_in_quotes() -> None:
    text = (HEAD + ABC).replace("10", "'10'")
    assert "tail: '10'" in text
    assert "a: '10'" in text
    Recipe.parse(text)
    assert accepts(SCHEMA, plain(text))


@pytest.mark.parametrize("text", WRONG)
def test_the_schema_and_the_reader_refuse_the_same_slips(text: str) -> None:
    with pytest.raises(RecipeError):
        Recipe.parse(text)
    assert not accepts(SCHEMA, plain(text))


@pytest.mark.parametrize(
    ("found", "model"),
    [
        (SCHEMA, Recipe),
        (SCHEMA["$defs"]["Balloon"], Balloon),
        *((SCHEMA["$defs"][each.__name__], each) for each in OPERATIONS),
        (SCHEMA["$defs"]["Physics"], Physics),
        (SCHEMA["$defs"]["Kosaka"], Kosaka),
        (SCHEMA["$defs"]["PressedBubble"], PressedBubble),
    ],
)
def test_the_schema_describes_every_key_and_forbids_others(found: dict[str, Any], model: type) -> None:
    beside = {Recipe: ["let"], Balloon: ["repeat"]}.get(model, [])
    assert list(found["properties"]) == [*model.model_fields, *beside]
    assert found["additionalProperties"] is False
    assert all(entry["description"] for entry in found["properties"].values())


def test_the_schema_requires_what_the_reader_requires() -> None:
    assert SCHEMA["required"] == ["format", "name", "balloons", "steps"]
    assert SCHEMA["$defs"]["Balloon"]["oneOf"] == [{"required": ["size"]}, {"required": ["mesh"]}]
    assert "required" not in SCHEMA["$defs"]["Physics"]
    steps = SCHEMA["properties"]["steps"]["items"]["oneOf"]
    assert steps == [
        {"$ref": f"#/$defs/{each}"} for each in [*(each.__name__ for each in OPERATIONS), "Repeat"]
    ]
    assert [SCHEMA["$defs"][each.__name__]["required"] for each in OPERATIONS] == [
        [w.word] for w in OPERATIONS
    ]


def test_null_is_nowhere_allowed() -> None:
    assert "null" not in json.dumps(SCHEMA)


def test_every_default_is_a_valid_value() -> None:
    with_default = [part for part in parts(SCHEMA) if "default" in part]
    assert len(with_default) >= 10
    for part in with_default:
        assert accepts(part, part["default"]), part


def test_the_schema_is_json_and_names_its_dialect() -> None:
    assert json.loads(json.dumps(SCHEMA)) == SCHEMA
    assert SCHEMA["$schema"] == "https://json-schema.org/draft/2020-12/schema"


def test_each_call_gives_a_schema_of_its_own() -> None:
    recipe_schema()["properties"].clear()
    assert recipe_schema() == SCHEMA
