"""What a maker may write, and what it means in Python."""

from __future__ import annotations

import math

import pytest
import yaml

from balloon_usd.language.scalars import plain_scalar
from balloon_usd.operations.modifiers import MODIFIERS
from balloon_usd.operations.table import BY_WORD, WORDS
from balloon_usd.recipe import LATEX_COLORS, Joint, LockJoints, Recipe
from balloon_usd.recipe.kosaka import Kosaka

HEAD = "format: 1\nname: dog\nunits: cm\nballoons:\n  main: {size: 260, tail: 10}\nsteps:\n"
ABC = "  - bubbles: {a: 10, b: 5, c: 4}\n"


def recipe(steps: str) -> Recipe:
    return Recipe.parse(HEAD + steps)


def recipe_of(balloon: str, units: str = "units: cm\n") -> Recipe:
    return Recipe.parse(
        f"format: 1\nname: dog\n{units}balloons:\n  m: {balloon}\nsteps:\n  - bubbles: {{a: 1 m}}\n"
    )


def length_of(written: str, units: str = "cm") -> float:
    text = f"format: 1\nname: d\nunits: {units}\nballoons: {{m: {{size: 260, tail: 1}}}}\nsteps:\n"
    return Recipe.parse(f"{text}  - bubbles: {{a: {written}}}\n").steps[0].lengths["a"]


def test_a_short_recipe_has_the_documented_defaults() -> None:
    short = recipe(ABC)
    assert (short.format, short.name, short.title, short.source, short.fps) == (1, "dog", "", "", 24.0)
    assert short.balloons["main"].color.name == "red"
    assert short.balloons["main"].inflated is None
    step, physics = short.steps[0], short.physics
    assert (step.turns, step.seconds, step.note, step.balloon) == (3.0, None, None, None)
    assert (physics.model, physics.rubber, physics.softening) == ("latex", "ogden", True)
    assert (physics.gravity, physics.friction, physics.substeps) == (None, 0.8, None)
    assert (physics.burst, physics.hold, physics.mass_scaling) == ("report", None, "selective")


def test_bubbles_keep_their_order_and_become_metres() -> None:
    read = recipe("  - bubbles: {nose: 10, ear: 2.5, tip: 12 mm}\n")
    step = read.steps[0]
    assert step.word == "bubbles"
    assert list(step.lengths.items()) == [("nose", 0.1), ("ear", 0.025), ("tip", 0.012)]
    assert read.piece.row("main")[:-1] == ["nose", "ear", "tip"]


@pytest.mark.parametrize("kind", ["loop", "fold", "ear"])
def test_loop_fold_and_ear_make_bubbles_of_a_length(kind: str) -> None:
    step = recipe(f"  - {kind}: {{a: 10, b: 5}}\n    point: back\n").steps[0]
    assert (step.word, step.lengths, step.point) == (kind, {"a": 0.1, "b": 0.05}, "back")


def test_a_lock_list_joins_the_start_of_the_first_and_the_end_of_the_last() -> None:
    step = recipe(ABC + "  - lock: [a, b, c]\n").steps[1]
    assert (step.word, step.lock) == ("lock", ("a", "b", "c"))
    assert step.ends == (Joint("a", "start"), Joint("c", "end"))
    assert step.lengths == {}


def test_a_lock_of_joints_names_the_ends_itself() -> None:
    step = recipe(ABC + "  - lock: {joints: [a.start, a.end, c.end]}\n").steps[1]
    assert isinstance(step.lock, LockJoints)
    assert step.ends == (Joint("a", "start"), Joint("a", "end"), Joint("c", "end"))
    assert str(step.ends[2]) == "c.end"


def test_rest_wait_and_bend_have_their_own_values() -> None:
    steps = recipe("  - rest: tail\n  - wait: 1.5\n  - bend: {tail: 90}\n    point: left\n").steps
    assert [step.word for step in steps] == ["rest", "wait", "bend"]
    assert steps[0].rest == "tail"
    assert steps[1].wait == 1.5
    assert steps[2].bend == {"tail": math.pi / 2}


@pytest.mark.parametrize(
    ("written", "degrees"), [("60", 60.0), ("60 deg", 60.0), ("'1.5 rad'", math.degrees(1.5)), ("180", 180.0)]
)
def test_angles_are_degrees_unless_they_say_radians(written: str, degrees: float) -> None:
    bend = recipe(f"{ABC}  - bend: {{a: {written}}}\n").steps[1].bend
    assert bend is not None
    assert math.degrees(bend["a"]) == pytest.approx(degrees, rel=1e-12)


@pytest.mark.parametrize("point", ["up", "down", "left", "right", "forward", "back"])
def test_every_point_is_known(point: str) -> None:
    assert recipe(f"{ABC}  - lock: [a, b]\n    point: {point}\n").steps[1].point == point


VALUES = {
    "balloon": "main",
    "point": "up",
    "turns": "2.5",
    "burp": "20.0",
    "spin": "90.0",
    "disc": "True",
    "strokes": "4",
    "seconds": "1.5",
    "note": "gently",
}


def test_this_file_tries_every_manner() -> None:
    assert set(VALUES) == set(MODIFIERS)


@pytest.mark.parametrize("kind", WORDS)
def test_every_manner_that_makes_sense_with_an_operation_is_read(kind: str) -> None:
    manners = BY_WORD[kind].modifiers()
    data = yaml.safe_load(BY_WORD[kind].example)
    entry = next(entry for entry in data["steps"] if kind in entry)
    entry |= {manner: yaml.safe_load(VALUES[manner]) for manner in manners}
    steps = Recipe.parse(yaml.safe_dump(data, sort_keys=False)).steps
    step = next(step for step in steps if step.word == kind)
    for manner in manners:
        assert str(getattr(step, manner)) == VALUES[manner]


@pytest.mark.parametrize(
    ("written", "metres"),
    [
        ("10", 0.1),
        ("+10", 0.1),
        ("0.1", 0.001),
        (".5", 0.005),
        ("1e1", 0.1),
        ("12 mm", 0.012),
        ("12mm", 0.012),
        ("4 cm", 0.04),
        ("0.3 m", 0.3),
        ("4 in", 0.1016),
        ("'4\"'", 0.1016),
        ("1 ft", 0.3048),
        ("'10'", 0.1),
        ("'  4  in '", 0.1016),
        ("5 m", 5.0),
        ("1 1/2 in", 0.0381),
        ("'3/4\"'", 0.01905),
        ("1/2", 0.005),
    ],
)
def test_a_length_may_be_a_bare_number_or_carry_its_unit(written: str, metres: float) -> None:
    assert length_of(written) == metres


@pytest.mark.parametrize(
    ("units", "metres"), [("mm", 0.002), ("cm", 0.02), ("m", 2.0), ("in", 0.0508), ("ft", 0.6096)]
)
def test_bare_numbers_take_the_units_of_the_recipe(units: str, metres: float) -> None:
    assert length_of("2", units) == metres


def test_a_recipe_without_units_is_fine_when_every_length_has_one() -> None:
    assert recipe_of("{size: 260, tail: 4 in}", units="").balloons["m"].tail == 0.1016


def test_a_length_that_is_given_in_two_units_is_the_same_number() -> None:
    assert length_of("254 mm") == length_of("10 in") == length_of("25.4") == length_of("0.254 m")


@pytest.mark.parametrize("size", ["160", "260", "321", "350", "360", "646"])
def test_a_size_may_be_a_number_or_a_text(size: str) -> None:
    assert recipe_of(f"{{size: {size}, tail: 0}}").balloons["m"].size == size
    assert recipe_of(f"{{size: '{size}', tail: 0}}").balloons["m"].size == size


def test_a_balloon_may_be_measured_by_its_inflated_length_and_override_its_size() -> None:
    balloon = recipe_of("{size: 160, inflated: 40, radius: 4 mm, length: 1.5 m, thickness: 0.3 mm}").balloons[
        "m"
    ]
    assert (balloon.inflated, balloon.tail) == (0.4, None)
    assert (balloon.radius, balloon.length, balloon.thickness) == (0.004, 1.5, 0.0003)


def test_a_tail_may_be_nothing() -> None:
    assert recipe_of("{size: 260, tail: 0}").balloons["m"].tail == 0.0


@pytest.mark.parametrize("name", LATEX_COLORS)
def test_every_named_color_is_linear_rgb(name: str) -> None:
    color = recipe_of(f"{{size: 260, tail: 1, color: {name}}}").balloons["m"].color
    code = LATEX_COLORS[name]
    assert color.name == name
    assert recipe_of(f"{{size: 260, tail: 1, color: '{code}'}}").balloons["m"].color.rgb == color.rgb
    assert all(0.0 <= channel <= 1.0 for channel in color.rgb)


def test_a_hex_color_is_decoded_from_srgb() -> None:
    color = recipe_of("{size: 260, tail: 1, color: '#FF8000'}").balloons["m"].color
    assert color.rgb == pytest.approx((1.0, 0.2158605, 0.0), abs=1e-6)
    assert recipe_of("{size: 260, tail: 1, color: '#0a0a0a'}").balloons["m"].color.rgb[0] == pytest.approx(
        10 / 255 / 12.92
    )


def test_a_listed_color_is_linear_already() -> None:
    color = recipe_of("{size: 260, tail: 1, color: [0.25, 1, 0]}").balloons["m"].color
    assert (color.name, color.rgb) == ("", (0.25, 1.0, 0.0))


def test_gray_is_grey() -> None:
    gray = recipe_of("{size: 260, tail: 1, color: gray}").balloons["m"].color
    assert gray.rgb == recipe_of("{size: 260, tail: 1, color: grey}").balloons["m"].color.rgb


def test_the_physics_block_is_read() -> None:
    physics = recipe(
        ABC + "physics: {model: latex, rubber: gent, softening: false, gravity: 9.81, friction: 1,"
        " substeps: 40, burst: stop, hold: 0, leak: 6 h, mass_scaling: none}\n"
    ).physics
    assert physics.model_dump() == {
        "model": "latex",
        "rubber": "gent",
        "softening": False,
        "gravity": 9.81,
        "friction": 1.0,
        "substeps": 40,
        "burst": "stop",
        "hold": 0.0,
        "leak": 21600.0,
        "mass_scaling": "none",
        "kosaka": Kosaka().model_dump(),
    }


@pytest.mark.parametrize("rubber", ["ogden", "ogden-treloar", "gent", "mooney-rivlin", "neo-hooke"])
def test_every_rubber_law_is_known(rubber: str) -> None:
    assert recipe(f"{ABC}physics: {{rubber: {rubber}}}\n").physics.rubber == rubber


def test_several_balloons_are_told_apart_by_the_step() -> None:
    text = HEAD.replace("steps:", "  other: {size: 160, inflated: 30}\nsteps:")
    two = Recipe.parse(
        text + "  - bubbles: {a: 10}\n    balloon: main\n  - loop: {b: 8}\n    balloon: other\n"
        "  - lock: {joints: [a.end, b.start]}\n  - rest: a_end\n    balloon: main\n"
        "  - rest: b_end\n    balloon: other\n"
    )
    assert [step.balloon for step in two.steps] == ["main", "other", None, "main", "other"]


@pytest.mark.parametrize("word", ["on", "off", "yes", "no", "y", "n", "On", "YES"])
def test_the_switches_of_old_yaml_are_ordinary_words(word: str) -> None:
    step = recipe(f"  - bubbles: {{{word}: 3}}\n    note: {word}\n").steps[0]
    assert (step.note, step.lengths) == (word, {word: 0.03})


@pytest.mark.parametrize(
    ("written", "value"),
    [
        ("017", 17),
        ("0o17", 15),
        ("0x1F", 31),
        ("-5", -5),
        ("1.5e3", 1500.0),
        ("1.", 1.0),
        ("", None),
        ("~", None),
        ("null", None),
        ("true", True),
        ("FALSE", False),
        ("-.inf", -math.inf),
        ("1_000", "1_000"),
        ("1:30", "1:30"),
        ("0b11", "0b11"),
        ("2001-01-01", "2001-01-01"),
        ("tRue", "tRue"),
        ("=", "="),
        ("<<", "<<"),
        ("9" * 41, "9" * 41),
        ("٣", "٣"),
    ],
)
def test_plain_values_follow_the_core_schema_of_yaml_1_2(written: str, value: object) -> None:
    found = plain_scalar(written)
    assert found == value
    assert type(found) is type(value)


def test_not_a_number_is_read_as_such() -> None:
    found = plain_scalar(".nan")
    assert isinstance(found, float)
    assert math.isnan(found)


def test_a_date_is_an_ordinary_text() -> None:
    assert recipe("  - bubbles: {a: 1}\n    note: 2001-01-01\n").steps[0].note == "2001-01-01"


def test_a_quoted_number_is_a_text() -> None:
    assert recipe("  - bubbles: {a: 1}\n    note: '5'\n").steps[0].note == "5"


def test_a_byte_order_mark_and_windows_line_ends_do_no_harm() -> None:
    text = HEAD + ABC
    assert Recipe.parse("\ufeff" + text) == Recipe.parse(text.replace("\n", "\r\n")) == Recipe.parse(text)


def test_a_recipe_and_its_steps_cannot_be_changed() -> None:
    frozen = recipe(ABC)
    with pytest.raises(ValueError, match="frozen"):
        frozen.name = "cat"
    with pytest.raises(ValueError, match="frozen"):
        frozen.steps[0].turns = 1.0


def test_recipes_are_equal_by_what_they_say_and_not_by_their_layout() -> None:
    assert recipe(ABC) == recipe("  # the same\n  - bubbles: {a: 100 mm, b: 50 mm, c: 40 mm}\n")
    assert recipe(ABC) != recipe("  - bubbles: {a: 10, b: 5, c: 4.1}\n")
    assert recipe(ABC) != "a recipe"


def test_the_hash_is_of_the_text() -> None:
    assert len(recipe(ABC).sha256) == 64
    assert recipe(ABC).sha256 == recipe(ABC).sha256 != recipe(ABC + "# more\n").sha256


def test_a_recipe_knows_its_file() -> None:
    assert Recipe.parse(HEAD + ABC, file="dog.yaml").file == "dog.yaml"
