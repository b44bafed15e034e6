"""Files that nobody should have written: each is refused with a clear message, quickly."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

import pytest

from balloon_usd.language.yaml_reader import BYTES_LIMIT, DEPTH_LIMIT, NODES_LIMIT
from balloon_usd.recipe import Recipe, RecipeError

if TYPE_CHECKING:
    from pathlib import Path

HEAD = "format: 1\nname: dog\nunits: cm\nballoons:\n  main: {size: 260, tail: 10}\nsteps:\n"
GOOD = HEAD + "  - bubbles: {a: 10}\n"


def messages(text: str) -> list[str]:
    with pytest.raises(RecipeError) as caught:
        Recipe.parse(text, file="f")
    return str(caught.value).splitlines()


def load_message(path: Path) -> str:
    with pytest.raises(RecipeError) as caught:
        Recipe.load(path)
    (problem,) = caught.value.problems
    assert problem.file == str(path)
    return f"{problem.line}:{problem.column}: {problem.text}"


@pytest.mark.parametrize(
    ("value", "message"),
    [
        ("!!int 3", "YAML tags are not allowed, expected no tag:yaml.org,2002:int"),
        ("!mine 3", "YAML tags are not allowed, expected no !mine"),
        (
            "!!python/object/apply:os.system ['true']",
            "YAML tags are not allowed, expected no tag:yaml.org,2002:python/",
        ),
        ("&x 3", "YAML anchors are not allowed, expected no &x"),
    ],
)
def test_tags_and_anchors_are_refused_where_they_stand(value: str, message: str) -> None:
    lines = messages(f"{HEAD}  - bubbles: {{a: {value}}}\n")
    assert any(line.startswith(f"f:7:18: steps[0].bubbles.a: {message}") for line in lines)


def test_aliases_are_refused_where_they_stand() -> None:
    assert messages(HEAD + "  - bubbles: {a: &x 3, b: *x}\n") == [
        "f:7:18: steps[0].bubbles.a: YAML anchors are not allowed, expected no &x",
        "f:7:27: steps[0].bubbles.b: YAML aliases are not allowed, expected the value itself instead of *x",
    ]


def test_an_alias_as_a_key_is_refused() -> None:
    assert messages("&x a: 1\n*x : 2\n")[-1] == "f:2:1: a key that is no plain text, expected key: value"


def test_a_billion_laughs_are_not_laughed() -> None:
    lines = ["a0: &a0 [lol]"] + [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 12)]
    begin = time.monotonic()
    assert any("YAML anchors are not allowed" in line for line in messages("\n".join(lines)))
    assert time.monotonic() - begin < 2.0


def test_merge_keys_are_ordinary_unknown_keys() -> None:
    (line,) = messages(GOOD.replace("steps:", "<<: {a: 1}\nsteps:"))
    assert line.startswith('f:6:1: ["<<"]: unknown key "<<", expected one of format, name, title')


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            GOOD + "name: cat\n",
            'f:8:1: name: key "name" stands here twice, expected it once (first at line 2)',
        ),
        (
            HEAD + "  - bubbles: {a: 10, a: {b: 3}}\n",
            'f:7:22: steps[0].bubbles.a: key "a" stands here twice, expected it once (first at line 7)',
        ),
    ],
)
def test_a_key_that_stands_twice_is_refused(text: str, message: str) -> None:
    assert messages(text) == [message]


def test_the_limit_of_depth_is_exact() -> None:
    def nested(depth: int) -> list[str]:
        return messages("[" * depth + "]" * depth)

    assert nested(DEPTH_LIMIT)[0].startswith("f:1:1: [[[")
    assert nested(DEPTH_LIMIT + 1) == [f"f:1:{DEPTH_LIMIT + 1}: nested deeper than {DEPTH_LIMIT} levels"]


def test_the_limit_of_values_is_exact() -> None:
    def steps(values: int) -> list[str]:
        return messages("[" + "1," * (values - 1) + "]")

    assert "does not fit" in steps(NODES_LIMIT)[0]
    assert "more than 20000 values, expected a recipe for balloons" in steps(NODES_LIMIT + 1)[0]


def test_the_limit_of_bytes_is_exact(tmp_path: Path) -> None:
    fits = GOOD + "#" * (BYTES_LIMIT - len(GOOD))
    assert Recipe.parse(fits).name == "dog"
    assert messages(fits + "#") == [
        f"f:1:1: the recipe is {BYTES_LIMIT + 1} bytes long, expected at most {BYTES_LIMIT}"
    ]
    path = tmp_path / "long.yaml"
    path.write_text(fits)
    assert Recipe.load(path).name == "dog"
    path.write_text(fits + "#")
    assert load_message(path) == f"1:1: the recipe is too long, expected at most {BYTES_LIMIT} bytes"


def test_bytes_are_counted_and_not_letters() -> None:
    assert "bytes long" in messages("# " + "é" * (BYTES_LIMIT // 2))[0]


FLOODS = {
    "brackets": "[" * 200_000,
    "braces": "{" * 200_000,
    "pairs of brackets": "[]" * 100_000,
    "dashes": "- " * 130_000,
    "question marks": "? " * 130_000,
    "colons": ":" * 260_000,
    "exclamation marks": "!" * 260_000,
    "quotes": "'" * 260_000,
    "stars": "*" * 260_000,
    "ampersands": "&a " * 80_000,
    "tabs": "\t" * 260_000,
    "one long word": HEAD + "a" * 200_000,
    "one long note": HEAD + "  - note: " + "a " * 120_000,
    "steps without value": HEAD + "  -\n" * 19_000,
    "keys that stand twice": HEAD + "  - {" + "b: 1, " * 9_900 + "}\n",
    "unknown keys": HEAD + "  - {" + ", ".join(f"b{n}: 1" for n in range(9_900)) + "}\n",
    "unknown bubbles": HEAD + "  - lock: [" + ", ".join(f"b{n}" for n in range(9_900)) + "]\n",
    "wrong lengths": HEAD + "  - bubbles: {" + ", ".join(f"b{n}: x" for n in range(9_900)) + "}\n",
    "lengths without unit": HEAD.replace("units: cm\n", "")
    + "  - bubbles: {"
    + ", ".join(f"b{n}: 1" for n in range(9_900))
    + "}\n",
}


@pytest.mark.parametrize("flood", FLOODS.values(), ids=FLOODS.keys())
def test_a_flood_is_refused_in_a_moment_with_a_short_message(flood: str) -> None:
    begin = time.process_time()
    lines = messages(flood)
    assert time.process_time() - begin < 2.0
    assert len(lines) <= 101
    assert all(len(line) < 700 for line in lines)


@pytest.mark.parametrize("text", ["", "\n", "# only a remark\n", "---\n", "--- ~\n", "null", "\ufeff"])
def test_an_empty_text_is_refused(text: str) -> None:
    assert messages(text) == ["f:1:1: the recipe is empty, expected a mapping that begins with format: 1"]


@pytest.mark.parametrize(("text", "shown"), [("[]", "[]"), ("5", "5"), ("dog", '"dog"'), ("true", "true")])
def test_a_file_that_is_no_mapping_is_refused(text: str, shown: str) -> None:
    assert messages(text) == [f"f:1:1: {shown} does not fit, expected entries such as key: value"]


def test_a_second_document_is_refused() -> None:
    assert messages(GOOD + "---\nformat: 1\n") == [
        "f:8:1: a second YAML document begins here, expected one recipe in a file"
    ]


def test_keys_that_are_no_text_are_refused() -> None:
    assert messages(HEAD + "  - ? [a]\n    : 1\n") == [
        "f:7:7: a key that is no plain text, expected key: value"
    ]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "a: b: c",
            'f:1:5: not valid YAML: mapping values are not allowed in this context; put texts that hold ": "',
        ),
        (
            "a: @b",
            "f:1:4: not valid YAML while scanning for the next token that begins at line 1: found character",
        ),
        (
            "a: 'b",
            "f:1:6: not valid YAML while scanning a quoted scalar that begins at line 1: found unexpected"
            " end",
        ),
        ("a: [1, 2\n", "f:2:1: not valid YAML while parsing a flow sequence that begins at line 1"),
    ],
)
def test_bad_yaml_is_refused_at_its_place(text: str, message: str) -> None:
    (line,) = messages(text)
    assert line.startswith(message)


@pytest.mark.parametrize(
    ("letter", "code"),
    [("\0", "0000"), ("\x1b", "001B"), ("\x7f", "007F"), ("\ud800", "D800"), ("\uffff", "FFFF")],
)
def test_characters_that_yaml_does_not_allow_are_refused_at_their_place(letter: str, code: str) -> None:
    assert messages(f"name: dog\ntitle: a{letter}b\n") == [
        f"f:2:9: character U+{code} is not allowed in YAML, expected printable text"
    ]


def test_a_recipe_is_read_from_a_file(tmp_path: Path) -> None:
    path = tmp_path / "dog.yaml"
    path.write_bytes(b"\xef\xbb\xbf" + GOOD.encode())
    assert Recipe.load(path) == Recipe.load(str(path)) == Recipe.parse(GOOD)
    assert Recipe.load(path).file == str(path)


def test_a_file_that_is_not_utf8_is_refused_at_the_byte(tmp_path: Path) -> None:
    path = tmp_path / "latin.yaml"
    path.write_bytes(b"format: 1\ntitle: caf\xe9\n")
    assert load_message(path) == "2:11: byte 0xE9 is not UTF-8, expected a text file saved as UTF-8"


def test_a_utf16_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "wide.yaml"
    path.write_bytes(GOOD.encode("utf-16"))
    assert load_message(path) == "1:1: byte 0xFF is not UTF-8, expected a text file saved as UTF-8"


def test_an_empty_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "empty.yaml"
    path.touch()
    assert load_message(path) == "1:1: the recipe is empty, expected a mapping that begins with format: 1"


def test_a_folder_is_refused(tmp_path: Path) -> None:
    assert load_message(tmp_path) == "1:1: is a folder, expected a recipe file"


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    expected = "1:1: cannot be read (No such file or directory), expected a recipe file"
    assert load_message(tmp_path / "none.yaml") == expected


def test_an_unreadable_file_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied")

    path = tmp_path / "secret.yaml"
    path.write_text(GOOD)
    monkeypatch.setattr("pathlib.Path.open", refuse)
    assert load_message(path) == "1:1: cannot be read (Permission denied), expected a recipe file"


def test_a_path_that_is_no_path_is_refused() -> None:
    with pytest.raises(RecipeError, match="cannot be read"):
        Recipe.load("a\0b.yaml")


def test_a_loop_of_links_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "loop.yaml"
    path.symlink_to(path)
    assert "cannot be read" in load_message(path)
