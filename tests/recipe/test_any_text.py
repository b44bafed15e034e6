"""Whatever stands in a file, reading it gives a recipe or a `RecipeError`, and soon."""

from __future__ import annotations

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from balloon_usd.recipe import Recipe, RecipeError

SHIPPED = [
    path.read_text(encoding="utf-8")
    for path in sorted((Path(__file__).parents[2] / "recipes").rglob("*.yaml"))
]
EXAMPLES = settings(deadline=None, max_examples=150)

SNIPPETS = st.sampled_from(
    [
        *[
            "",
            " ",
            "  ",
            "\n",
            "\n\n",
            "\t",
            ":",
            ": ",
            "- ",
            "? ",
            "[",
            "]",
            "{",
            "}",
            ",",
            "#",
            "'",
            '"',
            "|\n",
            ">\n",
        ],
        *[
            "&a ",
            "*a",
            "!!int ",
            "!x ",
            "<<: ",
            "---\n",
            "...\n",
            "%YAML 1.1\n",
            "@",
            "`",
            "\\",
            "~",
            "null",
            "true",
        ],
        *[
            "yes",
            ".nan",
            "-.inf",
            "1e400",
            "0",
            "-1",
            "9" * 50,
            "0x1F",
            "4 in",
            "10,5",
            '4"',
            "1e-400",
            "٣",
            "é",
        ],
        *["\0", "\ufeff", "\u2028", "\x85", "\ud800", "\U0001f388", "\r", "\r\n"],
        *[
            "steps",
            "bubbles",
            "lock",
            "loop",
            "fold",
            "ear",
            "rest",
            "bend",
            "press",
            "push",
            "kosaka",
            "capsule",
            "wait",
            "inflate",
            "joints",
            "balloon",
            "point",
        ],
        *[
            "tail",
            "nose",
            "left_ear",
            "nose.end",
            "units: cm\n",
            "  - rest: x\n",
            "  - lock: [a, b]\n",
            "physics: 1\n",
        ],
    ]
)


def read(text: str) -> Recipe | None:
    """Read a text; a refusal must have problems at places that are in the text."""
    try:
        return Recipe.parse(text, file="f")
    except RecipeError as error:
        refusal = error
    assert refusal.problems
    for problem in refusal.problems:
        assert 1 <= problem.line <= len(text.splitlines()) + 1
        assert 1 <= problem.column <= len(text) + 1
    for line in str(refusal).splitlines():
        assert line.startswith("f:")
        assert line.isprintable()
    return None


@st.composite
def mutated(draw: st.DrawFn) -> str:
    """Shipped recipes with pieces cut out, put in, doubled or exchanged."""
    text = draw(st.sampled_from(SHIPPED))
    for _ in range(draw(st.integers(1, 5))):
        start = draw(st.integers(0, len(text)))
        end = min(len(text), start + draw(st.sampled_from([0, 0, 1, 2, 5, 30, 200])))
        piece = draw(st.one_of(SNIPPETS, st.text(max_size=5), st.just(text[start:end] * 2)))
        text = text[:start] + piece + text[end:]
    return text


@st.composite
def lines_exchanged(draw: st.DrawFn) -> str:
    """Shipped recipes with some of their lines left out or in another order."""
    lines = draw(st.sampled_from(SHIPPED)).splitlines(keepends=True)
    picked = draw(st.lists(st.integers(0, len(lines) - 1), max_size=len(lines) + 5))
    return (
        "".join(lines[at] for at in picked)
        if draw(st.booleans())
        else "".join(lines[at] for at in sorted(picked))
    )


@given(text=mutated())
@EXAMPLES
def test_a_changed_recipe_is_read_or_refused(text: str) -> None:
    recipe = read(text)
    if recipe is not None:
        assert Recipe.parse(recipe.to_yaml()) == recipe


@given(text=lines_exchanged())
@EXAMPLES
def test_a_recipe_with_its_lines_exchanged_is_read_or_refused(text: str) -> None:
    read(text)


@given(text=st.text())
@EXAMPLES
def test_any_text_is_refused(text: str) -> None:
    assert read(text) is None


@given(pieces=st.lists(SNIPPETS, max_size=60))
@EXAMPLES
def test_any_heap_of_yaml_signs_is_refused(pieces: list[str]) -> None:
    assert read("".join(pieces)) is None


VALUES = st.recursive(
    st.one_of(
        st.none(),
        st.booleans(),
        st.integers(),
        st.floats(),
        st.text(max_size=8),
        st.sampled_from(["nose", "tail", "260"]),
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=4),
        st.dictionaries(
            st.sampled_from(
                [
                    "bubbles",
                    "lock",
                    "bend",
                    "rest",
                    "press",
                    "push",
                    "depth",
                    "wait",
                    "joints",
                    "nose",
                    "size",
                    "tail",
                    "color",
                    "x",
                ]
            ),
            inner,
            max_size=4,
        ),
    ),
    max_leaves=12,
)


def flow(value: object) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f'"{key}": {flow(entry)}' for key, entry in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(flow(entry) for entry in value) + "]"
    if isinstance(value, str):
        return "'" + value.replace("'", "''") + "'"
    return str(value).lower() if not isinstance(value, float) else repr(value)


@given(
    key=st.sampled_from(["format", "name", "title", "units", "fps", "balloons", "steps", "pose", "physics"]),
    value=VALUES,
)
@EXAMPLES
def test_any_value_at_any_key_is_read_or_refused(key: str, value: object) -> None:
    entries = {
        "format": "1",
        "name": "dog",
        "units": "cm",
        "balloons": "{main: {size: 260, tail: 10}}",
        "steps": "[bubbles: {nose: 5}]",
        key: flow(value),
    }
    read("".join(f"{name}: {entry}\n" for name, entry in entries.items()))


@given(step=VALUES, balloon=VALUES)
@EXAMPLES
def test_any_step_and_any_balloon_are_read_or_refused(step: object, balloon: object) -> None:
    read(
        f"format: 1\nname: dog\nunits: cm\nballoons: {{main: {{size: 260, tail: 1}}, other: {flow(balloon)}}}\n"
        f"steps: [bubbles: {{nose: 5}}, {flow(step)}]\n"
    )


@given(data=st.binary(max_size=400))
@settings(deadline=None, max_examples=100)
def test_a_file_of_any_bytes_is_refused(data: bytes, tmp_path_factory: pytest.TempPathFactory) -> None:
    path = tmp_path_factory.getbasetemp() / "any.yaml"
    path.write_bytes(data)
    with pytest.raises(RecipeError) as caught:
        Recipe.load(path)
    assert caught.value.problems
