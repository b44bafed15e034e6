from __future__ import annotations

from copy import deepcopy
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from balloon_usd.language.yaml_reader import read_yaml
from balloon_usd.variation.error import VariationError
from balloon_usd.variation.template import template_of
from tests.variation.layouts import RECIPE, Layout

RECIPES = sorted((Path(__file__).parents[2] / "recipes").rglob("*.yaml"))
NAME = ("name",)
TAIL = ("balloons", "main", "tail")
SCALARS = [
    NAME,
    TAIL,
    ("fps",),
    ("balloons", "main", "length"),
    ("balloons", "main", "color", 1),
    ("balloons", "other", "size"),
    ("steps", 0, "bubbles", "right_ear"),
    ("steps", 1, "lock", 1),
    ("steps", 1, "note"),
    ("physics", "hold"),
    ("physics", "kosaka", "re"),
]
"""Places of values, some of them absent."""
COLLECTIONS = [
    ("balloons", "main"),
    ("balloons", "main", "color"),
    ("steps", 0),
    ("steps", 0, "bubbles"),
    ("steps", 1, "lock"),
    ("physics",),
    ("physics", "kosaka"),
]
plain = st.one_of(
    st.text(st.characters(exclude_categories=["Cs"]), max_size=12),
    st.integers(-999, 999),
    st.floats(-1e30, 1e30),
    st.booleans(),
    st.just("4 in"),
)
values = st.one_of(
    plain, st.lists(plain, max_size=3), st.dictionaries(st.from_regex("[a-z]+"), plain, max_size=3)
)


def with_values(data, values):
    data = deepcopy(data)
    for (*above, last), value in values.items():
        node = data
        for key in above:
            node = node.setdefault(key, {}) if isinstance(node, dict) else node[key]
        node[last] = value
    return data


def within(path, others):
    return any(path[: len(other)] == other or other[: len(path)] == path for other in others)


@st.composite
def layouts(draw):
    layout = Layout(draw)
    return layout.text(RECIPE), layout.comments


@pytest.mark.parametrize("file", RECIPES, ids=lambda file: f"{file.parent.name}/{file.stem}")
def test_a_template_that_is_filled_with_what_stood_there_is_the_recipe_itself(file):
    text = file.read_text(encoding="utf-8")
    data = read_yaml(text, "").data
    assert template_of(text, "", [NAME]).filled({NAME: data["name"]}) == text


@settings(deadline=None, max_examples=60)
@given(layouts(), st.lists(st.sampled_from(SCALARS), unique=True), st.data())
def test_a_filled_template_reads_as_what_was_set_and_keeps_all_comments(written, paths, data):
    text, comments = written
    given_values = {path: data.draw(values) for path in paths}
    filled = template_of(text, "", paths).filled(given_values)
    assert read_yaml(filled, "").data == with_values(RECIPE, given_values)
    assert [comment for comment in comments if comment not in filled] == []


@settings(deadline=None, max_examples=60)
@given(layouts(), st.sampled_from(COLLECTIONS), st.data())
def test_collections_can_be_replaced_too(written, path, data):
    value = data.draw(values)
    filled = template_of(written[0], "", [path]).filled({path: value})
    assert read_yaml(filled, "").data == with_values(RECIPE, {path: value})


def test_what_stands_after_a_collection_stays_when_it_is_replaced():
    text = """\
format: 1
name: dog
balloons:
  main:  # the only one
    size: 260
    tail: 10  # flat

  # what the hands do
steps:
  - bubbles:
      nose: 5  # long
      # a lock would follow
  - wait: 1  # a moment
"""
    paths = [("balloons", "main"), ("steps", 0, "bubbles")]
    filled = template_of(text, "", paths).filled({path: {"a": 1} for path in paths})
    assert (
        filled
        == """\
format: 1
name: dog
balloons:
  main: {a: 1} # the only one

  # what the hands do
steps:
  - bubbles: {a: 1}
      # a lock would follow
  - wait: 1  # a moment
"""
    )


def test_a_new_entry_does_not_come_between_a_comment_and_what_it_is_about():
    text = """\
format: 1
name: dog
balloons:
  main:
    size: 260
    # left at the end
    tail: 10

# what the hands do
steps:
  - wait: 1
"""
    path = ("balloons", "main", "color")
    filled = template_of(text, "", [path]).filled({path: "blue"})
    assert "    # left at the end\n    tail: 10\n" in filled
    assert "\n# what the hands do\nsteps:\n" in filled
    assert "    color: blue\n" in filled


def test_comments_behind_values_stay_in_line():
    text = "name: dog\nballoons: {main: {tail: 10}}  # 10\nsteps:\n  - wait: 12   # 12\n    note: x    # x\n"
    filled = template_of(text, "", [("steps", 0, "wait")]).filled({("steps", 0, "wait"): 15})
    assert "wait: 15   # 12\n    note: x    # x\n" in filled


def test_numbers_and_words_that_are_not_touched_stand_as_they_stood():
    text = "name: dog\nfps: 0x18\nballoons: {main: {size: '260', tail: +1.50}}\nsteps: [{wait: 1e0, note: 2001-01-01}]\n"
    assert template_of(text, "", [NAME]).filled({NAME: "cat"}) == text.replace("dog", "cat")


@pytest.mark.parametrize("end", ["\r\n", "\r"])
def test_line_ends_of_other_systems_become_plain(end):
    text = "name: dog  # x\nballoons: {main: {tail: 10}}\n# y\nsteps: [{wait: 1}]\n"
    assert template_of(text.replace("\n", end), "", [NAME]).filled({NAME: "dog"}) == text


def test_a_recipe_in_which_every_mark_stands_is_refused():
    note = "".join(map(chr, range(0xE000, 0xF900)))
    text = f'name: dog\nballoons: {{main: {{tail: 10}}}}\nsteps: [{{wait: 1, note: "{note}"}}]\n'
    with pytest.raises(VariationError, match=r"dog\.yaml: too many characters for private use"):
        template_of(text, "dog.yaml", [NAME])


def test_marks_are_not_mistaken_for_what_stands_there_or_is_set():
    text = 'name: dog\nballoons: {main: {tail: 10}}\nsteps: [{wait: 1, note: "\ue000\ue001"}]\n'
    filled = template_of(text, "", [NAME, TAIL]).filled({NAME: "\ue003", TAIL: "\ue002\ue002"})
    data = read_yaml(filled, "").data
    assert (data["name"], data["balloons"]["main"]["tail"]) == ("\ue003", "\ue002\ue002")
    assert data["steps"][0]["note"] == "\ue000\ue001"
