"""What every operation of the table keeps to."""

from __future__ import annotations

import ast
import json
from contextlib import suppress
from pathlib import Path

import jsonschema
import pytest
import yaml
from PIL import Image

import balloon_usd
from balloon_usd.operations.modifiers import MODIFIERS
from balloon_usd.operations.moves import Move
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.table import BY_WORD, OPERATIONS, WORDS
from balloon_usd.plan import plan, plan_svg, plan_text
from balloon_usd.recipe import Recipe, RecipeError, recipe_schema

SCHEMA = jsonschema.Draft202012Validator(recipe_schema())
ROOMS = Path(balloon_usd.__file__).parent
DOCS = Path(__file__).parents[2] / "docs"
VALUES = {
    "balloon": "main",
    "point": "up",
    "turns": 2.5,
    "burp": 20,
    "spin": 90,
    "disc": True,
    "strokes": 4,
    "seconds": 1.5,
    "note": "gently",
}

each_operation = pytest.mark.parametrize("operation", OPERATIONS, ids=WORDS)


def step_of(operation: type[Operation]) -> Operation:
    return next(step for step in Recipe.parse(operation.example).steps if step.word == operation.word)


def subclasses(of: type[Operation]) -> set[type[Operation]]:
    return {of}.union(*(subclasses(each) for each in of.__subclasses__()))


def test_every_operation_that_is_written_stands_in_the_table() -> None:
    named = {each for each in subclasses(Operation) if getattr(each, "word", "")}
    assert named == set(OPERATIONS)
    assert len(BY_WORD) == len(OPERATIONS)


@each_operation
def test_it_has_a_file_of_its_own_with_its_word(operation: type[Operation]) -> None:
    assert operation.__module__ == f"balloon_usd.operations.{operation.word}"
    assert operation.word in operation.model_fields
    lines = (ROOMS / "operations" / f"{operation.word}.py").read_text().splitlines()
    assert len(lines) < 250


@each_operation
def test_its_example_is_read_written_back_and_planned(operation: type[Operation]) -> None:
    recipe = Recipe.parse(operation.example)
    assert operation.word in {step.word for step in recipe.steps}
    assert Recipe.parse(recipe.to_yaml()) == recipe
    planned = plan(recipe)
    assert all(isinstance(move, Move) for move in planned.choreography.moves)
    assert plan_text(planned)
    assert plan_svg(planned)


@each_operation
def test_it_says_where_it_is_described(operation: type[Operation]) -> None:
    assert operation.sources
    assert all(len(source) > 10 for source in operation.sources)


@each_operation
def test_it_has_a_page_that_shows_its_picture_and_what_its_code_knows(operation: type[Operation]) -> None:
    page = (DOCS / "reference" / "operations" / f"{operation.word}.md").read_text(encoding="utf-8")
    assert page.startswith(f"# {operation.word}: ")
    assert f"](../../pictures/operations/{operation.word}.webp)" in page
    assert f"<!-- generated: operation {operation.word} -->\n\n## Keys\n" in page
    assert "\n## What is checked\n\n- " in page


@each_operation
def test_its_picture_is_one_of_three_frames_and_small(operation: type[Operation]) -> None:
    file = DOCS / "pictures" / "operations" / f"{operation.word}.webp"
    with Image.open(file) as picture:
        assert picture.width > 3 * 300
        assert len(picture.convert("RGB").getcolors(picture.width * picture.height)) > 100
    assert file.stat().st_size < 60_000


@pytest.mark.parametrize("folder", [("reference", "operations"), ("pictures", "operations")])
def test_no_page_and_no_picture_is_of_another_operation(folder: tuple[str, str]) -> None:
    assert {file.stem for file in DOCS.joinpath(*folder).iterdir()} - {"index"} == set(WORDS)


@each_operation
def test_the_schema_takes_its_example_and_no_modifier_that_makes_no_sense(operation: type[Operation]) -> None:
    data = yaml.safe_load(operation.example)
    SCHEMA.validate(data)
    step = next(entry for entry in data["steps"] if operation.word in entry)
    for modifier in MODIFIERS:
        changed = json.loads(json.dumps(data))
        changed["steps"][data["steps"].index(step)][modifier] = VALUES[modifier]
        if modifier in operation.modifiers():
            SCHEMA.validate(changed)
        else:
            with pytest.raises(jsonschema.ValidationError):
                SCHEMA.validate(changed)
            with pytest.raises(RecipeError, match=f"makes no sense with {operation.word}"):
                Recipe.parse(yaml.safe_dump(changed, sort_keys=False))


@each_operation
def test_what_it_names_is_the_same_in_a_file_and_in_python(operation: type[Operation]) -> None:
    step = step_of(operation)
    entry = step.entry("cm")
    raw = {*operation.makes(entry), *operation.uses(entry)}
    assert {name.partition(".")[0] for name in step.names} <= raw


@each_operation
def test_it_makes_what_it_says_and_has_a_length_for_all_but_a_rest(operation: type[Operation]) -> None:
    recipe = Recipe.parse(operation.example)
    for index, step in enumerate(recipe.steps):
        made = {name: made.last for name, made in recipe.piece.bubbles.items() if made.step == index}
        assert set(made) == set(step.makes(step.entry("cm")))
        assert set(step.lengths) == {name for name, last in made.items() if not last}


@each_operation
def test_its_label_begins_with_its_word(operation: type[Operation]) -> None:
    assert step_of(operation).label.startswith(f"{operation.word}: ")


@each_operation
@pytest.mark.parametrize("value", [None, 7, "x", [], {}, [3], {"a": None}])
def test_a_value_of_any_form_is_read_without_a_crash(operation: type[Operation], value: object) -> None:
    assert isinstance(operation.makes(value), tuple)
    assert isinstance(operation.uses(value), tuple)
    data = {**yaml.safe_load(operation.example), "steps": [{operation.word: value}]}
    with suppress(RecipeError):
        Recipe.parse(yaml.safe_dump(data, sort_keys=False))


def test_no_other_room_has_a_list_of_words() -> None:
    for file in sorted(ROOMS.rglob("*.py")):
        if "operations" in file.parts:
            continue
        for node in ast.walk(ast.parse(file.read_text())):
            if isinstance(node, (ast.Tuple, ast.List, ast.Set, ast.Dict)):
                parts = node.keys if isinstance(node, ast.Dict) else node.elts
                found = {part.value for part in parts if isinstance(part, ast.Constant)} & set(WORDS)
                assert len(found) < 3, f"{file}:{node.lineno} lists {sorted(found)}"
