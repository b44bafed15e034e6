from __future__ import annotations

import json
from pathlib import PurePosixPath, PureWindowsPath

import pytest

from balloon_usd.farm import chunk_lines, chunk_of_line, chunk_size, in_chunks
from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe

HOSTILE = ["dog.yaml", "a folder/it's.yaml", "ä\u2028{{Param.Output}}.yaml", 'line\nbreak".yaml']


def test_a_chunk_is_read_as_it_was_written():
    text = chunk_lines([[PurePosixPath("mouse.yaml")], [PurePosixPath(name) for name in HOSTILE]])
    assert [str(path) for path in chunk_of_line(text, 1)] == ["mouse.yaml"]
    assert [str(path) for path in chunk_of_line(text, 2)] == HOSTILE


def test_what_openjd_would_fill_in_is_not_in_the_text():
    assert "{" not in chunk_lines([[PurePosixPath(name)] for name in HOSTILE])


def test_folders_are_parted_by_slashes_wherever_it_is_written():
    assert json.loads(chunk_lines([[PureWindowsPath("animals\\dog.yaml")]])) == ["animals/dog.yaml"]


@pytest.mark.parametrize("number", [0, 3, -1])
def test_a_chunk_that_is_not_there_is_told(number):
    with pytest.raises(ValueError, match=f"there is no chunk {number}, expected 1 to 2"):
        chunk_of_line('["a"]\n["b"]\n', number)


@pytest.mark.parametrize("line", ["", "dog.yaml", "[]", "[1]", '{"a": 1}'])
def test_a_line_that_is_no_chunk_is_told(line):
    with pytest.raises(ValueError, match="line 1 is no JSON list of paths"):
        chunk_of_line(f"{line}\n", 1)


def test_a_gpu_gets_larger_chunks():
    assert chunk_size("cuda") == chunk_size("cuda:1") > chunk_size("auto") == chunk_size("cpu")


def test_like_goes_with_like_and_the_longest_come_first(write_recipe):
    files = [
        write_recipe(f"{name}.yaml", hold=hold) for name, hold in (("a", 1), ("b", 3), ("c", 2), ("d", 1))
    ]
    files[1].write_text(files[1].read_text().replace("fps: 8", "fps: 12"))
    chunks = in_chunks([plan(Recipe.load(file)) for file in files], 2)
    assert [[plan.recipe.name for plan in chunk] for chunk in chunks] == [["c", "a"], ["d", "b"]]
