"""Recipes written in Python, and recipes written back as YAML."""

from __future__ import annotations

import math
from inspect import signature
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from balloon_usd.language.quantities import METRES, angle_entry, length_entry, metres, radians
from balloon_usd.operations.bubbles import Bubbles
from balloon_usd.operations.lock import Lock
from balloon_usd.operations.operation import Operation
from balloon_usd.operations.press import PressedBubble
from balloon_usd.operations.rest import Rest
from balloon_usd.operations.table import OPERATIONS, WORDS
from balloon_usd.recipe import LATEX_COLORS, Balloon, Joint, Recipe, RecipeBuilder, RecipeError

RECIPES = sorted((Path(__file__).parents[2] / "recipes").rglob("*.yaml"))
EXAMPLES = settings(deadline=None, max_examples=120)

DOG = """\
format: 1
name: dog
title: Classic dog
units: cm
balloons:
  main: {size: 260, color: red, tail: 10}
steps:
  - bubbles: {nose: 10, left_ear: 10, right_ear: 10}
  - lock: [left_ear, right_ear]
    point: up
  - rest: tail
"""


def dog() -> RecipeBuilder:
    return (
        RecipeBuilder("dog", title="Classic dog")
        .balloon("main", size="260", color="red", tail=0.10)
        .bubbles(nose=0.10, left_ear=0.10, right_ear=0.10)
        .lock("left_ear", "right_ear", point="up")
        .rest("tail")
    )


def full() -> RecipeBuilder:
    return (
        RecipeBuilder(
            "all",
            title='a "title": #1\nline two',
            source="here",
            units="in",
            fps=30,
            pose="hang",
            mirror=True,
        )
        .balloon("one", size=260, color=[0.1, 0.2, 1.0], inflated="40 cm", radius=0.008, thickness=0.0003)
        .balloon("two", size=160, color="#1f5fd0", tail=0.05, length="1.5 m")
        .bubbles({"a": 0.1}, b="4 in", balloon="one", turns=2.5, seconds=1, note="on")
        .loop(c=0.2, balloon="one", point="up", turns=4)
        .fold(d=0.2, balloon="two", point="down", seconds=0.5)
        .ear({"e": 0.03}, balloon="two", point="left", note="5")
        .lock("a", "b", point="right", turns=3.5)
        .lock(joints=["a.start", "d.end"], seconds=2, note="cross over")
        .rest("one_end", balloon="one", seconds=1)
        .bend(a=60, b="0.3 rad", point="forward", seconds=1.5)
        .press("b", at="1 in", depth=0.012, point="down", balloon="one", seconds=2, note="poke")
        .press("two_rest", force="500 mN")
        .wait(2, note="look")
        .physics(rubber="gent", softening=False, gravity=9.81)
        .physics(substeps=100)
    )


def test_the_builder_writes_the_recipe_a_maker_would_write() -> None:
    assert dog().to_yaml() == DOG
    assert dog().build() == Recipe.parse(DOG)


def test_a_built_recipe_tells_that_it_was_built() -> None:
    assert dog().build().file == "<builder>"


def test_the_builder_knows_every_operation_and_manner() -> None:
    recipe = full().build()
    assert recipe.title == 'a "title": #1\nline two'
    assert (recipe.fps, recipe.pose) == (30.0, "hang")
    assert recipe.balloons["one"].color.rgb == (0.1, 0.2, 1.0)
    assert recipe.balloons["one"].inflated == 0.4
    assert recipe.balloons["two"].length == 1.5
    assert recipe.steps[0].lengths == {"a": 0.1, "b": 0.1016}
    assert (recipe.steps[0].turns, recipe.steps[0].seconds, recipe.steps[0].note) == (2.5, 1.0, "on")
    assert recipe.steps[3].note == "5"
    assert recipe.steps[5].ends == (Joint("a", "start"), Joint("d", "end"))
    assert recipe.steps[7].bend == {"a": math.radians(60), "b": 0.3}
    assert recipe.steps[8].press == PressedBubble(bubble="b", at=0.0254, depth=0.012)
    assert recipe.steps[9].press == PressedBubble(bubble="two_rest", force=0.5)
    assert recipe.steps[10].wait == 2.0
    assert (recipe.physics.rubber, recipe.physics.softening, recipe.physics.substeps) == ("gent", False, 100)


def test_what_the_builder_was_given_reads_back_equal() -> None:
    recipe = full().build()
    assert Recipe.parse(recipe.to_yaml()) == recipe
    assert Recipe.parse(full().to_yaml()) == recipe


def test_the_builder_reports_all_problems_at_places_of_its_text() -> None:
    wrong = dog().lock("left_eer", "right_ear").bubbles(more=0.1).wait(100)
    with pytest.raises(RecipeError) as caught:
        wrong.build()
    lines = wrong.to_yaml().splitlines()
    assert [lines[problem.line - 1][problem.column - 1 :] for problem in caught.value.problems] == [
        "lock: [left_eer, right_ear]",
        "10}",
        "100",
    ]
    assert 'unknown bubble "left_eer", did you mean "left_ear"?' in str(caught.value)
    assert str(caught.value).startswith("<builder>:")


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        (RecipeBuilder("dog"), "steps: is empty"),
        (dog().physics(rubber="gum"), "unknown rubber"),
        (dog().physics(air="thin"), "unknown key"),
        (dog().bend(tail=math.nan), "nan is no angle"),
        (RecipeBuilder("dog").balloon("m", size=260, tail=math.inf).rest("r"), "balloons.m.tail: "),
        (RecipeBuilder("dog").balloon("m", size=260).rest("r"), "how far it is blown up"),
        (RecipeBuilder("my dog").balloon("m", size=260, tail=0.1).rest("r"), "is no name"),
        (RecipeBuilder("dog").balloon("m", size="huge", tail=0.1).rest("r"), 'unknown balloon size "huge"'),
    ],
)
def test_the_builder_refuses_what_a_file_refuses(wrong: RecipeBuilder, message: str) -> None:
    with pytest.raises(RecipeError) as caught:
        wrong.build()
    assert message in str(caught.value)


@pytest.mark.parametrize("path", RECIPES, ids=lambda path: f"{path.parent.name}/{path.stem}")
def test_a_shipped_recipe_reads_back_equal_from_its_own_text(path: Path) -> None:
    recipe = Recipe.load(path)
    written = recipe.to_yaml()
    assert Recipe.parse(written) == recipe
    assert Recipe.parse(written).to_yaml() == written
    assert recipe.name == path.stem


def test_a_builder_writes_the_constants_of_the_particle_model_in_its_units() -> None:
    builder = (
        RecipeBuilder("air", units="mm")
        .balloon("main", size=260, capsule=0.2)
        .wait(1)
        .physics(model="kosaka", kosaka={"ks": 20000.0, "gamma": 0.001, "re": "1 cm"})
    )
    recipe = builder.build()
    assert 'kosaka: {ks: 20000, gamma: 1, re: "1 cm"}' in builder.to_yaml()
    assert "kosaka: {ks: 20000, gamma: 1, re: 10}" in recipe.to_yaml()
    assert (recipe.physics.kosaka.gamma, recipe.physics.kosaka.re) == (0.001, 0.01)
    assert recipe.balloons["main"].capsule == 0.2
    assert Recipe.parse(recipe.to_yaml()) == recipe


@given(leak=st.floats(1e-3, 2_592_000.0))
def test_a_written_time_reads_back_bit_for_bit(leak: float) -> None:
    builder = RecipeBuilder("f").balloon("main", size=260, tail=0.1).wait(1.0).physics(leak=leak)
    recipe = builder.build()
    assert recipe.physics.leak == leak
    assert Recipe.parse(recipe.to_yaml()).physics.leak == leak


@pytest.mark.parametrize(
    ("leak", "written"),
    [(5400.0, "90 min"), (3600.0, "1 h"), (86400.0, "1 day"), (172800.0, "2 days"), (90.5, "90.5 s")],
)
def test_a_time_is_written_in_the_largest_unit_in_which_it_is_whole(leak: float, written: str) -> None:
    recipe = RecipeBuilder("f").balloon("main", size=260, tail=0.1).wait(1.0).physics(leak=leak).build()
    assert f'leak: "{written}"' in recipe.to_yaml()


@given(force=st.floats(1e-6, 100.0))
@EXAMPLES
def test_a_written_force_reads_back_bit_for_bit(force: float) -> None:
    builder = RecipeBuilder("f").balloon("main", size=260, tail=0.1).press("main_rest", force=force)
    again = Recipe.parse(builder.build().to_yaml()).steps[0].press
    assert again is not None
    assert again.force == force


def test_a_recipe_made_of_models_is_checked_and_written_in_metres() -> None:
    balloon = Balloon(size="260", tail=0.1)
    made = Recipe(
        format=1, name="dog", balloons={"m": balloon}, steps=(Bubbles(bubbles={"a": 0.1}), Rest(rest="r"))
    )
    assert made.file == "<python>"
    assert 'bubbles: {a: "0.1 m"}' in made.to_yaml()
    assert Recipe.parse(made.to_yaml()) == made
    with pytest.raises(ValidationError, match=r"steps\[0\].lock: unknown bubble"):
        Recipe(format=1, name="dog", balloons={"m": balloon}, steps=(Lock(lock=("a", "b")),))


@given(length=st.floats(1e-7, 5.0), units=st.sampled_from([None, *(unit for unit in METRES if unit != '"')]))
@EXAMPLES
def test_a_written_length_reads_back_bit_for_bit(length: float, units: str | None) -> None:
    assert metres(length_entry(length, units), units) == length


@given(angle=st.floats(1e-6, math.pi))
@EXAMPLES
def test_a_written_angle_reads_back_bit_for_bit(angle: float) -> None:
    assert radians(angle_entry(angle)) == angle


TEXTS = st.one_of(
    st.text(st.characters(exclude_categories=["Cc", "Cs", "Zl", "Zp", "Cn", "Co"]), max_size=30),
    st.sampled_from(
        ["yes", "on", "null", "~", "1", "0x1F", ".nan", "a: b", "- a", "# a", "a #b", " a ", "'", '"', "\\"]
    ),
    st.sampled_from(
        ["two\nlines", "a\tb", "\n", "[a", "{a", "*a", "&a", "!a", "%a", "@a", "`a", "---", "é", "…"]
    ),
)
LENGTHS = st.one_of(st.floats(1e-4, 4.9), st.sampled_from(["4 in", "12 mm", '3"', "0.5 ft"]))
NAMES = st.one_of(
    st.from_regex(r"[A-Za-z_][A-Za-z0-9_]{0,8}", fullmatch=True),
    st.sampled_from(["on", "yes", "null", "true", "False", "e5", "_", "NaN"]),
)
COLORS = st.one_of(
    st.sampled_from(sorted(LATEX_COLORS)),
    st.from_regex(r"#[0-9a-fA-F]{6}", fullmatch=True),
    st.lists(st.floats(0, 1), min_size=3, max_size=3),
)


@st.composite
def builders(draw: st.DrawFn) -> RecipeBuilder:
    """Builders of recipes that make sense."""
    units = draw(st.sampled_from(["mm", "cm", "m", "in", "ft"]))
    fps = draw(st.none() | st.floats(1, 240))
    builder = RecipeBuilder(draw(NAMES), title=draw(TEXTS), source=draw(TEXTS), units=units, fps=fps)
    balloons = draw(st.lists(NAMES, min_size=1, max_size=2, unique=True))
    for name in balloons:
        filling = draw(st.sampled_from(["tail", "inflated"]))
        size = draw(st.sampled_from([160, 260, 321, 350, 360, 646]))
        builder.balloon(name, size=size, color=draw(st.none() | COLORS), **{filling: draw(LENGTHS)})
    names = draw(st.lists(NAMES, min_size=4, max_size=12, unique=True))
    for name in names[3:]:
        kind = draw(st.sampled_from(["bubbles", "loop", "fold", "ear"]))
        getattr(builder, kind)(
            {name: draw(LENGTHS)}, balloon=draw(st.sampled_from(balloons)), **manner(draw, kind)
        )
    builder.bubbles({names[0]: 0.1, names[1]: 0.1}, balloon=balloons[0])
    if draw(st.booleans()):
        builder.lock(names[0], names[1], **manner(draw, "lock"))
    else:
        builder.lock(joints=[f"{names[0]}.start", f"{names[1]}.end"], **manner(draw, "lock"))
    builder.rest(names[2], balloon=balloons[0])
    builder.bend({names[2]: draw(st.floats(0.01, 180)), names[3]: "1.25 rad"}, point="back")
    builder.wait(draw(st.floats(0.2, 60)), note=draw(TEXTS))
    return builder.physics(friction=draw(st.floats(0, 3)), softening=draw(st.booleans()))


def manner(draw: st.DrawFn, kind: str) -> dict[str, Any]:
    """How one step is done."""
    found: dict[str, Any] = {
        "turns": draw(st.none() | st.integers(1, 20).map(lambda halves: halves / 2)),
        "seconds": draw(st.none() | st.floats(0.2, 60)),
        "note": draw(st.none() | TEXTS),
    }
    if kind != "lock":
        found["burp"] = draw(st.none() | st.floats(1, 50) | st.just("20 %"))
    if kind != "bubbles":
        found["point"] = draw(st.none() | st.sampled_from(["up", "down", "left", "right", "forward", "back"]))
    return found


@given(builder=builders())
@EXAMPLES
def test_whatever_is_built_reads_back_equal(builder: RecipeBuilder) -> None:
    recipe = builder.build()
    assert Recipe.parse(builder.to_yaml()) == recipe
    again = Recipe.parse(recipe.to_yaml())
    assert again == recipe
    assert again.to_yaml() == recipe.to_yaml()


@pytest.mark.parametrize(
    ("top", "written", "read"),
    [
        ("left", "left", "left"),
        ("nose", "nose", ("nose",)),
        (["nose"], "nose", ("nose",)),
        (["nose", "tail"], "[nose, tail]", ("nose", "tail")),
    ],
)
def test_the_top_is_a_side_or_bubbles(top: Any, written: str, read: Any) -> None:
    recipe = (
        RecipeBuilder("dog", top=top)
        .balloon("main", size=260, tail=0.1)
        .bubbles(nose=0.1)
        .rest("tail")
        .build()
    )
    assert f"top: {written}\n" in recipe.to_yaml()
    assert Recipe.parse(recipe.to_yaml()).top == recipe.top == read


def test_every_operation_is_a_method_with_its_own_arguments_and_modifiers() -> None:
    builder = RecipeBuilder("f")
    for operation in OPERATIONS:
        method = getattr(builder, operation.word)
        takes = signature(method).parameters
        assert set(operation.modifiers()) < set(takes)
        assert method.__doc__ == operation.__doc__


def test_a_step_can_be_added_by_its_word_or_as_a_whole() -> None:
    by_word = RecipeBuilder("dog", title="Classic dog").balloon("main", size="260", color="red", tail=0.10)
    by_word.add("bubbles", nose=0.10, left_ear=0.10, right_ear=0.10)
    by_word.add("lock", "left_ear", "right_ear", point="up").add("rest", "tail")
    assert by_word.to_yaml() == DOG
    again = RecipeBuilder("dog", title="Classic dog").balloon("main", size="260", color="red", tail=0.10)
    for step in dog().build().steps:
        again.add(step)
    assert again.to_yaml() == DOG


@pytest.mark.parametrize("operation", OPERATIONS, ids=WORDS)
def test_the_builder_writes_the_steps_of_every_example(operation: type[Operation]) -> None:
    recipe = Recipe.parse(operation.example)
    builder = RecipeBuilder("f", units="in")
    for name, balloon in recipe.balloons.items():
        lengths = {"tail": balloon.tail, "length": balloon.length, "inflated": balloon.inflated}
        builder.balloon(name, size=balloon.size, **lengths)
    for step in recipe.steps:
        builder.add(step)
    assert builder.build().steps == recipe.steps


def test_an_unknown_word_and_unknown_arguments_are_refused_at_once() -> None:
    builder = RecipeBuilder("f")
    with pytest.raises(ValueError, match='unknown operation "bubble", did you mean "bubbles"'):
        builder.add("bubble", a=0.1)
    with pytest.raises(TypeError, match="point"):
        builder.rest("b", point="up")
    with pytest.raises(AttributeError):
        builder.bubble(a=0.1)
    with pytest.raises(TypeError):
        builder.add(dog().build().steps[0], turns=2)


@pytest.mark.parametrize(
    ("word", "what", "keys", "told"),
    [
        (
            "tuck",
            (),
            {"between": ["a", "b"]},
            r"tuck: missing a required argument: 'bubble', expected tuck\(bubble, ",
        ),
        (
            "tuck",
            ("c",),
            {"between": ["a"]},
            r"tuck: got an unexpected keyword argument 'between', expected tuck",
        ),
        (
            "press",
            ("a", "b"),
            {},
            r"press: too many positional arguments, expected press\(bubble, \*, at=None",
        ),
        (
            "tulip_link",
            ("a", None, "b"),
            {},
            'None is no length, expected a number of metres, or a text such as "5 cm"',
        ),
    ],
)
def test_wrong_arguments_are_told_with_the_word_and_those_that_it_takes(word, what, keys, told) -> None:
    with pytest.raises(TypeError, match=told):
        RecipeBuilder("f").add(word, *what, **keys)


def test_what_is_given_twice_or_in_unknown_units_is_refused_at_once() -> None:
    with pytest.raises(ValueError, match='there is a balloon "main" already'):
        RecipeBuilder("f").balloon("main", size=260).balloon("main", size=160)
    with pytest.raises(TypeError, match='bubbles: "a" is given twice, expected it once'):
        RecipeBuilder("f").bubbles({"a": 0.05}, a=0.06)
    with pytest.raises(ValueError, match='unknown unit "inch"'):
        RecipeBuilder("f", units="inch")


def test_numbers_and_arrays_of_numpy_are_written_as_plain_ones():
    number = np.float32
    figure = (
        RecipeBuilder("head", fps=number(30))
        .balloon("main", size=np.int64(260), tail=number(0.125), color=np.array([1.0, 0.0, 0.5]))
        .bubbles(nose=number(0.0625), left=0.0625, right=0.0625, seconds=number(2.5))
        .lock("left", "right", turns=number(3.5))
        .spiral(["left"], ["right"], turns=number(1.5))
        .curl(nose=np.float64(0.75))
        .physics(friction=number(0.5))
    )
    assert (
        figure.to_yaml()
        == """\
format: 1
name: head
units: cm
fps: 30
balloons:
  main: {size: 260, color: [1, 0, 0.5], tail: 12.5}
steps:
  - bubbles: {nose: 6.25, left: 6.25, right: 6.25}
    seconds: 2.5
  - lock: [left, right]
    turns: 3.5
  - spiral: {bubbles: [[left], [right]], turns: 1.5}
  - curl: {nose: 0.75}
physics:
  friction: 0.5
"""
    )
