from __future__ import annotations

import re
from pathlib import Path

import pytest

from balloon_usd.language.yaml_reader import read_yaml
from balloon_usd.variation.key_path import find_path

DOG = read_yaml((Path(__file__).parents[2] / "recipes" / "dog.yaml").read_text(encoding="utf-8"), "").data
TWO = read_yaml(
    """\
balloons: {main: {size: 260, color: [1, 0, 0], tail: 5}, other: {size: 160, tail: 5}}
steps:
  - bubbles: {a: 5, b: 5}
    balloon: main
  - lock: {joints: [a.end, b.end]}
  - bend: {b: 60}
  - press: {bubble: a, depth: 1}
physics: {kosaka: {swell: 0.1}}
""",
    "",
).data


@pytest.mark.parametrize(
    ("text", "path"),
    [
        ("balloons.main.tail", ("balloons", "main", "tail")),
        ("balloons.main.length", ("balloons", "main", "length")),
        ("balloons.main", ("balloons", "main")),
        ("fps", ("fps",)),
        ("steps.0.bubbles.nose", ("steps", 0, "bubbles", "nose")),
        ("steps[0].bubbles.nose", ("steps", 0, "bubbles", "nose")),
        ("steps[1].lock[0]", ("steps", 1, "lock", 0)),
        ("steps.1.lock.left_ear", ("steps", 1, "lock", 0)),
        ("steps.0.turns", ("steps", 0, "turns")),
        ("steps.nose.bubbles.nose", ("steps", 0, "bubbles", "nose")),
        ("steps.nose", ("steps", 0)),
        ("steps.left_ear.point", ("steps", 1, "point")),
        ("steps.left_ear.bubbles", ("steps", 0, "bubbles")),
        ("steps.tail.rest", ("steps", 6, "rest")),
        ("physics.friction", ("physics", "friction")),
        ("physics.kosaka.swell", ("physics", "kosaka", "swell")),
    ],
)
def test_a_path_leads_to_its_place_also_where_that_is_empty(text, path):
    assert find_path(text, DOG) == path


@pytest.mark.parametrize(
    ("text", "path"),
    [
        ("balloons.main.color.0", ("balloons", "main", "color", 0)),
        ("steps.1.lock.joints.1", ("steps", 1, "lock", "joints", 1)),
        ("steps[1].lock.joints[1]", ("steps", 1, "lock", "joints", 1)),
        ("steps.2.bend.b", ("steps", 2, "bend", "b")),
        ("steps.b.bend.b", ("steps", 2, "bend", "b")),
        ("steps.a.press.force", ("steps", 3, "press", "force")),
        ("physics.kosaka.re", ("physics", "kosaka", "re")),
    ],
)
def test_a_path_leads_into_every_form_of_step(text, path):
    assert find_path(text, TWO) == path


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("balloons.man.tail", 'unknown balloon "man", did you mean "main"?'),
        ("balloons.main.colour", 'unknown key "colour", did you mean "color"?'),
        ("balloon.main", 'unknown key "balloon", did you mean "balloons"?'),
        ("physics.fricton", 'unknown key "fricton", did you mean "friction"?'),
        ("physics.kosaka.swel", 'unknown key "swel", did you mean "swell"?'),
        ("steps.0.bubbles.nos", 'unknown bubble "nos", did you mean "nose"?'),
        (
            "steps.0.point",
            'unknown key "point", expected one of bubbles, balloon, turns, burp, seconds, note',
        ),
        ("steps.lft_ear.point", 'unknown bubble "lft_ear", did you mean "left_ear"?'),
        ("steps.left_ear", '"left_ear" is in steps[0] and steps[1], expected one of them by its number'),
        (
            "steps.left_ear.turns",
            '"left_ear" is in steps[0] and steps[1], expected one of them by its number',
        ),
        ("steps.7", "steps has no place 7, expected 0 to 6"),
        ("steps.-1", 'unknown bubble "-1", expected one of nose'),
        (f"steps.{'9' * 5000}", "steps has no place 999999"),
        ("steps.\u0663", 'unknown bubble "\u0663", expected one of nose'),
        ("units.x", 'units is "cm", which has no parts: expected the path to end there'),
        ("balloons.main.color.0", 'balloons.main.color is "red", which has no parts'),
        ("balloons.main.at.0", "balloons.main.at is not there, expected a value for all of it"),
        ("name", "is not varied, since each variation gets its own name: expected another key"),
        ("format", "is not varied"),
        ("", "no path, expected keys such as balloons.main.tail or steps[0].bubbles.nose"),
        ("balloons..tail", "no path"),
        (".fps", "no path"),
        ("[0]", "no path"),
        ("steps[0", 'unknown key "steps[0"'),
        ("a\x1bb\n", 'unknown key "a\\x1bb"'),
    ],
)
def test_a_path_that_leads_nowhere_is_told_with_the_nearest_that_is_known(text, said):
    with pytest.raises(ValueError, match=re.escape(said)) as raised:
        find_path(text, DOG)
    assert str(raised.value).isprintable()
