"""Messages: `file:line:col: path: what, what was expected, nearest valid choice`, all at once, in order."""

from __future__ import annotations

from typing import Annotated

import pytest
from pydantic import BaseModel, Field, ValidationError

from balloon_usd.language.names import Name
from balloon_usd.language.problem import Problem, quoted
from balloon_usd.operations.table import WORDS
from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.recipe.translation import validation_complaints

HEAD = "format: 1\nname: dog\nunits: cm\nballoons:\n  main: {size: 260, tail: 10}\nsteps:\n"
TWO = HEAD.replace("steps:", "  other: {size: 160, tail: 5}\nsteps:")


def refusal(text: str) -> RecipeError:
    with pytest.raises(RecipeError) as caught:
        Recipe.parse(text, file="dog.yaml")
    return caught.value


def messages(text: str) -> list[str]:
    return str(refusal(text)).splitlines()


def test_the_message_of_the_design_stands_at_its_place() -> None:
    steps = "  - bubbles: {nose: 10, left_ear: 10, right_ear: 10}\n  - lock: [lft_ear, right_ear]\n"
    assert messages(HEAD + steps) == [
        'dog.yaml:8:5: steps[1].lock: unknown bubble "lft_ear", did you mean "left_ear"?'
    ]


def test_a_problem_has_its_parts_as_fields() -> None:
    error = refusal(HEAD + "  - bubbles: {a: -1}\n")
    what = "-1 cm is out of range, expected more than 0 and at most 5 m"
    assert error.problems == (Problem("dog.yaml", 7, 18, "steps[0].bubbles.a", what),)
    assert isinstance(error, ValueError)


def test_a_problem_of_the_whole_file_has_no_path() -> None:
    assert str(Problem("dog.yaml", 1, 1, "", "is wrong")) == "dog.yaml:1:1: is wrong"


ONE_STEP = [
    ("bubbles: {a: 0}", 18, "steps[0].bubbles.a: 0 is out of range, expected more than 0 and at most 5 m"),
    (
        "bubbles: {a: 501}",
        18,
        "steps[0].bubbles.a: 5.01 m is out of range, expected more than 0 and at most 5 m",
    ),
    (
        "bubbles: {a: 4 yd}",
        18,
        'steps[0].bubbles.a: unknown length unit "yd", expected one of mm, cm, m, in, ", ft, finger, fingers, hand, hands',
    ),
    (
        "bubbles: {a: '10,5 cm'}",
        18,
        'steps[0].bubbles.a: "10,5 cm" has a decimal comma, expected a decimal point: "10.5 cm"',
    ),
    ("bubbles: {a: long}", 18, 'steps[0].bubbles.a: "long" is no length, expected "12 mm" or "4 in"'),
    ("bubbles: {a: true}", 18, 'steps[0].bubbles.a: true is no length, expected "12 mm" or "4 in"'),
    (
        "bubbles: {a: .nan}",
        18,
        'steps[0].bubbles.a: nan is no length, expected a finite number such as "12 mm" or "4 in"',
    ),
    (
        "bubbles: {a: -.inf}",
        18,
        'steps[0].bubbles.a: -inf is no length, expected a finite number such as "12 mm" or "4 in"',
    ),
    (
        "bubbles: {a: 1e400}",
        18,
        'steps[0].bubbles.a: inf is no length, expected a finite number such as "12 mm" or "4 in"',
    ),
    ("bubbles: {}", 5, "steps[0].bubbles: is empty, expected at least one entry"),
    ("bubbles: 3", 14, "steps[0].bubbles: 3 does not fit, expected entries such as {nose: 10}"),
    (
        "bubbles: {9a: 1}",
        19,
        'steps[0].bubbles["9a"]: "9a" is no name, expected letters, digits and _ not beginning with a digit,'
        ' such as "_9a"',
    ),
    (
        "bubbles: {left ear: 1}",
        25,
        'steps[0].bubbles["left ear"]: "left ear" is no name, expected letters, digits and _ not'
        " beginning with a"
        ' digit, such as "left_ear"',
    ),
    (
        "lock: 3",
        11,
        "steps[0].lock: 3 does not fit, expected a list of bubbles, or {joints: [nose.end, tail.start]}",
    ),
    ("wait: yes", 11, 'steps[0].wait: "yes" is no number, expected 0.2 to 60 s'),
    ("wait: 0.1", 11, "steps[0].wait: 0.1 is out of range, expected 0.2 to 60 s, the nearest is 0.2"),
    ("wait: 61", 11, "steps[0].wait: 61 is out of range, expected 0.2 to 60 s, the nearest is 60"),
    ("rest: 5", 11, "steps[0].rest: 5 is no name, expected letters, digits and _ not beginning with a digit"),
    ("wait:", 5, "steps[0].wait: no value, expected one here or no such line"),
    ("wait: ~", 5, "steps[0].wait: no value, expected one here or no such line"),
    ("hello", 5, 'steps[0]: "hello" does not fit, expected entries such as key: value'),
    (
        "{note: x}",
        5,
        f"steps[0]: no operation, expected one of {', '.join(WORDS)}",
    ),
]


@pytest.mark.parametrize(("step", "column", "message"), ONE_STEP)
def test_a_wrong_step_gives_one_message_at_its_place(step: str, column: int, message: str) -> None:
    assert messages(f"{HEAD}  - {step}\n") == [f"dog.yaml:7:{column}: {message}"]


MANNER = [
    ("turns: 2.3", "2.3 is out of range, expected 0.5 to 10 turns in steps of 0.5, the nearest is 2.5"),
    ("turns: 0", "0 is out of range, expected 0.5 to 10 turns in steps of 0.5, the nearest is 0.5"),
    ("turns: 11", "11 is out of range, expected 0.5 to 10 turns in steps of 0.5, the nearest is 10"),
    ("turns: three", '"three" is no number, expected 0.5 to 10 turns in steps of 0.5'),
    ("turns: true", "true is no number, expected 0.5 to 10 turns in steps of 0.5"),
    ("burp: 0.2", "0.2 % is out of range, expected 1 to 50 %, the nearest is 1 %"),
    ("burp: 60 %", "60 % is out of range, expected 1 to 50 %, the nearest is 50 %"),
    ("burp: 2 N", '"2 N" is no share, expected 20 or "20 %"'),
    ("burp: 20%%", '"20%%" is no share, expected 20 or "20 %"'),
    ("burp: much", '"much" is no share, expected 20 or "20 %"'),
    ("burp: .nan", 'nan is no share, expected a finite number such as 20 or "20 %"'),
    ("seconds: 0.1", "0.1 is out of range, expected 0.2 to 60 s, the nearest is 0.2"),
    ("seconds: .nan", "nan is no number, expected 0.2 to 60 s"),
    ("note: 5", '5 is no text, expected it in quotes: "5"'),
    ('note: "a\\x07b"', "character U+0007 is not allowed, expected printable text"),
    ("point: upp", 'unknown point "upp", did you mean "up"?'),
    ("point: sideways", 'unknown point "sideways", expected one of up, down, left, right, forward, back'),
    ("balloon: mian", 'unknown balloon "mian", did you mean "main"?'),
]


@pytest.mark.parametrize(("line", "message"), MANNER)
def test_a_wrong_manner_is_found_at_its_value(line: str, message: str) -> None:
    key = line.partition(":")[0]
    column = 5 + len(key) + 2
    found = messages(f"{HEAD}  - loop: {{a: 10}}\n    {line}\n")
    assert found == [f"dog.yaml:8:{column}: steps[0].{key}: {message}"]


@pytest.mark.parametrize(
    ("angle", "message"),
    [
        ("0", "0 degrees is out of range, expected more than 0 and at most 180"),
        ("190", "190 degrees is out of range, expected more than 0 and at most 180"),
        ("-5 deg", "-5 degrees is out of range, expected more than 0 and at most 180"),
        ("60 cm", 'unknown angle unit "cm", expected one of deg, rad'),
        ("far", '"far" is no angle, expected 60 or "60 deg"'),
    ],
)
def test_a_wrong_angle_is_found_at_its_value(angle: str, message: str) -> None:
    steps = f"  - bubbles: {{a: 10}}\n  - bend: {{a: {angle}}}\n"
    assert messages(HEAD + steps) == [f"dog.yaml:8:15: steps[1].bend.a: {message}"]


BALLOON = [
    ("size: 261", "size", 16, 'unknown balloon size "261", did you mean "321"?'),
    (
        "size: 260.0",
        "size",
        16,
        "260.0 is no balloon size, expected one of 160, 260, 321, 350, 360, 646, R5, R11, H6, H11",
    ),
    (
        "size: 260, color: rde",
        "color",
        28,
        'unknown color "rde", did you mean "red"? ("#rrggbb" and [r, g, b] work too)',
    ),
    (
        "size: 260, color: '#12345'",
        "color",
        28,
        '"#12345" is no color, expected six hex digits such as "#d7141e"',
    ),
    ("size: 260, color: [0, 1, 2]", "color", 21, "2 is no share of a color, expected 0 to 1"),
    (
        "size: 260, color: [0, 1]",
        "color",
        21,
        '[0, 1] is no color, expected a name, "#rrggbb" or [r, g, b] with 0 to 1',
    ),
    ("size: 260, radius: 1", "radius", 29, None),
    (
        "size: 260, radius: 20",
        "radius",
        29,
        "20 cm is out of range, expected at least 1 mm and at most 10 cm",
    ),
    (
        "size: 260, thickness: 1",
        "thickness",
        32,
        "1 cm is out of range, expected more than 0.02 mm and at most 3 mm",
    ),
    ("size: 260, length: 0", "length", 29, "0 is out of range, expected more than 0 and at most 5 m"),
    (
        "size: 260, inflated: 5",
        "inflated",
        31,
        "stands beside tail, expected exactly one of tail, inflated, filled, capsule",
    ),
    ("size: 260, colour: red", "colour", 29, 'unknown key "colour", did you mean "color"?'),
]


@pytest.mark.parametrize(("entry", "key", "column", "message"), BALLOON)
def test_a_wrong_balloon_entry_is_found_at_its_place(
    entry: str, key: str, column: int, message: str | None
) -> None:
    text = f"format: 1\nname: dog\nunits: cm\nballoons:\n  main: {{{entry}, tail: 10}}\nsteps: [wait: 1]\n"
    if message is None:
        assert Recipe.parse(text).balloons["main"].radius == 0.01
    else:
        assert messages(text) == [f"dog.yaml:5:{column}: balloons.main.{key}: {message}"]


@pytest.mark.parametrize(
    ("entry", "column", "message"),
    [
        (
            "{size: 260}",
            3,
            "balloons.m: does not say how far it is blown up, expected tail, inflated or filled, or capsule in model kosaka",
        ),
        ("{tail: 1}", 3, "balloons.m.size: is missing, expected the size of the balloon, such as 260"),
        (
            "{size: 260, tail: -1}",
            24,
            "balloons.m.tail: -1 cm is out of range, expected at least 0 and at most 5 m",
        ),
        ("260", 6, "balloons.m: 260 does not fit, expected entries such as key: value"),
    ],
)
def test_a_balloon_needs_a_size_and_a_filling(entry: str, column: int, message: str) -> None:
    text = f"format: 1\nname: dog\nunits: cm\nballoons:\n  m: {entry}\nsteps: [wait: 1]\n"
    assert messages(text) == [f"dog.yaml:5:{column}: {message}"]


PHYSICS = [
    ("rubber: ogdn", 'unknown rubber "ogdn", did you mean "ogden"?'),
    ("softening: on", '"on" does not fit, expected true or false'),
    ("softening: 1", "1 does not fit, expected true or false"),
    ("substeps: 20.5", "20.5 is no whole number, expected 20 to 2000"),
    ("substeps: 19", "19 is out of range, expected 20 to 2000, the nearest is 20"),
    ("gravity: -1", "-1 is out of range, expected 0 to 100 m/s2, the nearest is 0"),
    ("friction: 4", "4 is out of range, expected 0 to 3, the nearest is 3"),
    ("friction: .inf", "inf is out of range, expected 0 to 3, the nearest is 3"),
    ("model: kosak", 'unknown model "kosak", did you mean "kosaka"?'),
    ("burst: never", 'unknown burst "never", expected one of report, stop'),
    ("hold: 61", "61 is out of range, expected 0 to 60 s, the nearest is 60"),
    ("mass_scaling: x", 'unknown mass_scaling "x", expected one of selective, none'),
]


@pytest.mark.parametrize(("line", "message"), PHYSICS)
def test_a_wrong_entry_of_the_physics_is_found_at_its_value(line: str, message: str) -> None:
    key = line.partition(":")[0]
    found = messages(f"{HEAD}  - bubbles: {{a: 10}}\nphysics:\n  {line}\n")
    assert found == [f"dog.yaml:9:{3 + len(key) + 2}: physics.{key}: {message}"]


HEADS = [
    ("format: 1", "format: 2", "1:9", 'format: unknown format "2", expected 1'),
    ("format: 1", "format: '1'", "1:9", 'format: "1" is no format, expected 1'),
    ("format: 1", "format: true", "1:9", "format: true is no format, expected 1"),
    ("format: 1", "format: 1.0", "1:9", "format: 1.0 is no format, expected 1"),
    (
        "name: dog",
        "name: my dog",
        "2:7",
        'name: "my dog" is no name, expected letters, digits and _ not beginning with a digit, such as'
        ' "my_dog"',
    ),
    (
        "name: dog",
        "name: ../dog",
        "2:7",
        'name: "../dog" is no name, expected letters, digits and _ not beginning with a digit, such as "dog"',
    ),
    ("name: dog", "name: dog\ntitle: 7", "3:8", 'title: 7 is no text, expected it in quotes: "7"'),
    (
        "name: dog",
        "name: dog\nfps: 0",
        "3:6",
        "fps: 0 is out of range, expected 1 to 240 frames/s, the nearest is 1",
    ),
    ("units: cm", "units: cm\nfront: rigth", "4:8", 'front: unknown front "rigth", did you mean "right"?'),
    (
        "units: cm",
        "units: cm\ntop: main_ret",
        "4:6",
        'top: unknown top "main_ret", did you mean "main_rest"?',
    ),
    (
        "units: cm",
        "units: cm\ntop: [a, b]",
        "4:10",
        'top[1]: unknown bubble "b", expected one of a, main_rest',
    ),
    ("units: cm", "units: cm\ntop: []", "4:1", "top: is empty, expected at least one entry"),
    (
        "units: cm",
        "units: cm\nfront: a\ntop: [a]",
        "5:1",
        "top: names what is the front already, expected another side of the figure",
    ),
    (
        "units: cm",
        "units: cm\ntop: 3",
        "4:6",
        'top: unknown top "3", expected one of forward, back, left, right, up, down',
    ),
    ("units: cm", "units: cm\nmirror: yes", "4:9", 'mirror: "yes" does not fit, expected true or false'),
    ("units: cm", "units: cm\npose: stant", "4:7", 'pose: unknown pose "stant", did you mean "stand"?'),
    ("units: cm", "units: miles", "3:8", 'units: unknown units "miles", expected one of mm, cm, m, in, ft'),
    ("units: cm", "units: CM", "3:8", 'units: unknown units "CM", did you mean "cm"?'),
    (
        "units: cm",
        "units: [cm]",
        "3:1",
        "units: [cm] is no units, expected one of mm, cm, m, in, ft",
    ),
    (
        "name: dog",
        "name: dog\nballons: 3",
        "3:10",
        'ballons: unknown key "ballons", did you mean "balloons"?',
    ),
]


@pytest.mark.parametrize(("right", "wrong", "place", "message"), HEADS)
def test_a_wrong_head_is_found_at_its_place(right: str, wrong: str, place: str, message: str) -> None:
    text = (HEAD + "  - bubbles: {a: 10}\n").replace(right, wrong, 1)
    assert messages(text) == [f"dog.yaml:{place}: {message}"]


def test_missing_keys_are_named_with_an_example() -> None:
    assert messages("title: nothing\n") == [
        "dog.yaml:1:1: format: is missing, expected format: 1",
        "dog.yaml:1:1: name: is missing, expected a name for the file such as dog",
        "dog.yaml:1:1: balloons: is missing, expected balloons such as {main: {size: 260, color: red,"
        " tail: 10}}",
        f"dog.yaml:1:1: steps: is missing, expected a list of steps, each with one of {', '.join(WORDS)}",
    ]


def test_empty_balloons_and_steps_are_refused() -> None:
    assert messages("format: 1\nname: dog\nballoons: {}\nsteps: []\n") == [
        "dog.yaml:3:1: balloons: is empty, expected at least one entry",
        "dog.yaml:4:1: steps: is empty, expected at least one entry",
    ]


def test_lengths_without_a_unit_are_reported_once_with_the_remedy() -> None:
    text = HEAD.replace("units: cm\n", "") + "  - bubbles: {a: 10, b: 4 in, c: 7}\n"
    assert messages(text) == [
        "dog.yaml:4:27: balloons.main.tail: 10 has no unit, expected units: cm at the top of the recipe, or a"
        ' length such as "10 cm" (2 more lengths have none)'
    ]


@pytest.mark.parametrize(
    ("step", "told"),
    [
        ("twist: {nose: 5}", 'steps[0].twist: unknown key "twist", did you mean "bubbles"?'),
        ("pinch_twist: {nose: 5}", 'steps[0].pinch_twist: unknown key "pinch_twist", did you mean "ear"?'),
        ("join: [nose, tail]", 'steps[0].join: unknown key "join", did you mean "lock"?'),
        (
            "string: 20 cm",
            'steps[0].string: "string" is not in format 1: a string between two joints, '
            "expected tie, which brings them together",
        ),
        ("apple: {nose: 5}", 'steps[0].apple: unknown key "apple", did you mean "tulip"?'),
        (
            "mirror: true",
            'steps[0].mirror: "mirror" is said of the whole figure, expected it at the top of the recipe',
        ),
        (
            "color: blue",
            'steps[0].color: "color" is said of a balloon, expected it beside that below balloons',
        ),
    ],
)
def test_words_of_makers_and_keys_of_other_places_are_told_where_they_belong(step: str, told: str) -> None:
    (message,) = messages(f"{HEAD}  - {step}\n")
    assert message.endswith(told)


def test_all_problems_are_reported_at_once_in_the_order_of_the_file() -> None:
    text = (
        "format: 2\nname: my-dog\nunits: cm\nphysics: {rubber: gum}\nballoons:\n  main: {size: 26,"
        " tail: 10}\n"
        "steps:\n  - bubbels: {a: 1}\n  - bubbles: {b: -1}\n    turns: 99\n  - lock: [b, c]\n  - bend:"
        " {b: 400}\n"
    )
    error = refusal(text)
    assert [(problem.line, problem.column, problem.path) for problem in error.problems] == [
        (1, 9, "format"),
        (2, 7, "name"),
        (4, 19, "physics.rubber"),
        (6, 16, "balloons.main.size"),
        (8, 5, "steps[0].bubbels"),
        (9, 18, "steps[1].bubbles.b"),
        (10, 12, "steps[1].turns"),
        (11, 5, "steps[2].lock"),
        (12, 15, "steps[3].bend.b"),
    ]
    assert len(str(error).splitlines()) == len(error.problems)


def test_more_than_a_hundred_problems_are_counted_and_not_listed() -> None:
    names = "".join(f"      b{number}: x\n" for number in range(101))
    lines = messages(f"{HEAD}  - bubbles:\n{names}")
    assert len(lines) == 101
    assert lines[-1] == "dog.yaml: 1 more problems"


def test_hostile_keys_cannot_steer_the_terminal_or_flood_it() -> None:
    lines = messages(HEAD + '  - bubbles: {"a\\x1b[2J": 1, ' + "x" * 500 + ": 1}\n")
    assert len(lines) == 2
    assert all(line.isprintable() and len(line) < 250 for line in lines)
    assert "\\x1b[2J" in lines[0]


@pytest.mark.parametrize(
    ("step", "key", "message"),
    [
        (
            "bubbles: {a: 1}",
            "point: up",
            "makes no sense with bubbles, expected one of balloon, turns, burp, seconds, note",
        ),
        ("rest: a", "turns: 2", "makes no sense with rest, expected one of balloon, seconds, note"),
        ("wait: 1", "seconds: 2", "makes no sense with wait, expected note"),
        ("wait: 1", "balloon: main", "makes no sense with wait, expected note"),
    ],
)
def test_a_manner_that_makes_no_sense_is_refused(step: str, key: str, message: str) -> None:
    name = key.partition(":")[0]
    place = f"8:{5 + len(name) + 2}"
    assert messages(f"{HEAD}  - {step}\n    {key}\n") == [f"dog.yaml:{place}: steps[0].{name}: {message}"]


def test_a_step_has_one_operation() -> None:
    assert messages(HEAD + "  - bubbles: {a: 1}\n    rest: b\n") == [
        "dog.yaml:8:11: steps[0].rest: stands beside bubbles, expected one operation in a step: begin a"
        " new step"
    ]


AB_C = "  - bubbles: {a: 10, b: 5, c: 5}\n"
LOCKS = [
    (
        "[a, c]",
        5,
        "lock: no neighbours (b between them), expected [a, b, c] or lock: {joints: [a.start, c.end]}",
    ),
    ("[b, a]", 5, "lock: not in the order of the balloon, expected [a, b]"),
    ("[a, a]", 5, "lock: names a bubble twice, expected each once"),
    (
        "[a]",
        5,
        "lock: 1 bubbles cannot be locked, expected at least two bubbles; one bubble closes on itself"
        " with loop,"
        " fold or ear",
    ),
    ("[a, 5]", 15, "lock[1]: 5 is no name, expected letters, digits and _ not beginning with a digit"),
    ("[a, zebra]", 5, 'lock: unknown bubble "zebra", expected one of a, b, c'),
    ("{joints: [a.end]}", 12, "lock.joints: 1 joints cannot be locked, expected at least two"),
    (
        "{joints: [a.end, b.start]}",
        12,
        "lock.joints: a.end, b.start: these joints are already one, expected different joints",
    ),
    (
        "{joints: [a.end, a.middle]}",
        28,
        'lock.joints[1]: "a.middle" is no joint, expected a bubble and its end such as nose.end',
    ),
    ("{joints: [a.end, z.end]}", 12, 'lock.joints: unknown bubble "z", expected one of a, b, c'),
    ("{joints: 5}", 20, "lock.joints: 5 does not fit, expected a list such as [left_ear, right_ear]"),
    ("{}", 5, "lock.joints: is missing, expected a list such as [nose.end, tail.start]"),
]


@pytest.mark.parametrize(("lock", "column", "message"), LOCKS)
def test_a_lock_that_makes_no_sense_is_refused(lock: str, column: int, message: str) -> None:
    assert messages(f"{HEAD}{AB_C}  - lock: {lock}\n") == [f"dog.yaml:8:{column}: steps[1].{message}"]


def test_a_lock_before_its_bubbles_says_where_they_are_made() -> None:
    assert messages(HEAD + "  - lock: [a, b]\n  - bubbles: {a: 1, b: 2}\n") == [
        f'dog.yaml:7:5: steps[0].lock: bubble "{name}" does not exist yet, it is made at'
        f" steps[1].bubbles.{name}:"
        " expected this step after that one"
        for name in "ab"
    ]


def test_a_lock_cannot_be_done_twice() -> None:
    steps = AB_C + "  - lock: [a, b]\n  - lock: {joints: [b.end, a.start]}\n"
    assert messages(HEAD + steps) == [
        "dog.yaml:9:12: steps[2].lock.joints: b.end, a.start: these joints are already one, expected"
        " different joints"
    ]


@pytest.mark.parametrize("kind", ["loop", "fold", "ear"])
def test_the_ends_of_a_loop_fold_or_ear_are_already_one(kind: str) -> None:
    steps = f"  - {kind}: {{a: 9}}\n  - lock: {{joints: [a.start, a.end]}}\n"
    assert messages(HEAD + steps) == [
        "dog.yaml:8:12: steps[1].lock.joints: a.start, a.end: these joints are already one, expected"
        " different joints"
    ]


def test_bending_an_unknown_bubble_is_refused() -> None:
    assert messages(HEAD + "  - bend: {neck: 60}\n") == [
        'dog.yaml:7:18: steps[0].bend.neck: unknown bubble "neck", expected main_rest'
    ]


def test_a_bubble_name_can_be_used_once() -> None:
    assert messages(HEAD + "  - bubbles: {a: 1}\n  - loop: {a: 9}\n") == [
        'dog.yaml:8:15: steps[1].loop.a: bubble "a" was made at steps[0].bubbles.a, expected a new name'
    ]


def test_a_bubble_name_can_be_used_once_even_on_two_balloons() -> None:
    steps = "  - bubbles: {a: 1}\n    balloon: main\n  - bubbles: {a: 1}\n    balloon: other\n"
    assert messages(TWO + steps) == [
        'dog.yaml:10:18: steps[1].bubbles.a: bubble "a" was made at steps[0].bubbles.a, expected a new name'
    ]


@pytest.mark.parametrize(
    ("step", "column", "path"),
    [("bubbles: {a: 1}", 18, "bubbles.a"), ("rest: again", 11, "rest"), ("ear: {e: 3}", 14, "ear.e")],
)
def test_nothing_is_made_of_a_balloon_after_its_rest(step: str, column: int, path: str) -> None:
    assert messages(f"{HEAD}  - rest: tail\n  - {step}\n") == [
        f'dog.yaml:8:{column}: steps[1].{path}: balloon "main" has ended at steps[0].rest, expected'
        " nothing made"
        " of it after its rest"
    ]


def test_locks_bends_and_waits_may_follow_the_rest() -> None:
    steps = AB_C + "  - rest: tail\n  - lock: [b, c, tail]\n  - bend: {tail: 60}\n  - wait: 1\n"
    assert len(Recipe.parse(HEAD + steps).steps) == 5


@pytest.mark.parametrize(
    "step", ["bubbles: {a: 1}", "loop: {a: 9}", "fold: {a: 9}", "ear: {a: 3}", "rest: a"]
)
def test_a_step_that_makes_bubbles_says_on_which_of_several_balloons(step: str) -> None:
    assert messages(f"{TWO}  - {step}\n") == [
        "dog.yaml:8:5: steps[0]: does not say on which balloon, expected balloon: one of main, other"
    ]


def test_a_lock_list_stays_on_one_balloon() -> None:
    steps = (
        "  - bubbles: {a: 1}\n    balloon: main\n  - bubbles: {b: 1}\n    balloon: other\n  - lock: [a, b]\n"
    )
    assert messages(TWO + steps) == [
        "dog.yaml:12:5: steps[2].lock: bubbles of different balloons (main, other),"
        " expected lock: {joints: [a.start, b.end]}"
    ]


def test_a_bend_that_names_a_balloon_stays_on_it() -> None:
    steps = "  - bubbles: {a: 1}\n    balloon: main\n  - bend: {a: 60}\n    balloon: other\n"
    assert messages(TWO + steps) == [
        'dog.yaml:11:14: steps[1].balloon: bubble "a" is on balloon "main", expected no other balloon named'
    ]


def test_a_later_room_finds_the_place_of_a_step_or_of_what_encloses_it() -> None:
    recipe = Recipe.parse(HEAD + AB_C + "  - rest: tail\n", file="dog.yaml")
    assert str(recipe.problem(("steps", 0, "bubbles", "b"), "does not fit")) == (
        "dog.yaml:7:25: steps[0].bubbles.b: does not fit"
    )
    assert str(recipe.problem(("steps", 1, "turns"), "too few")) == "dog.yaml:8:5: steps[1].turns: too few"
    assert str(recipe.problem((), "odd")) == "dog.yaml:1:1: odd"


def test_too_few_and_too_many_entries_are_counted() -> None:
    class Pair(BaseModel):
        pair: Annotated[tuple[Name, ...], Field(min_length=2, max_length=2)]

    def told(value: object) -> list[str]:
        with pytest.raises(ValidationError) as caught:
            Pair.model_validate({"pair": value})
        return [found.text for found in validation_complaints(caught.value, {"pair": value}, Pair)]

    assert told([]) == ["is empty, expected at least one entry"]
    assert told(["a"]) == ["1 entry here, expected at least 2"]
    assert told(["a", "b", "c"]) == ["3 entries here, expected at most 2"]
    assert len(told(["a", 5])) == 1


@pytest.mark.parametrize(
    ("value", "shown"),
    [
        ({"bubble": "a", "by": [1, None]}, "{bubble: a, by: [1, null]}"),
        (["a", True, 2.5], "[a, true, 2.5]"),
        ([[[["deep"]]]], "[[[...]]]"),
        ("a b", '"a b"'),
    ],
)
def test_a_value_is_shown_in_messages_as_it_stands_in_a_file(value: object, shown: str) -> None:
    assert quoted(value) == shown
