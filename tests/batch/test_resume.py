"""The same command again: what is there already, whole and made of the same, is skipped."""

from __future__ import annotations

import json

import pytest

from tests.batch import runs

ORDER = ("-o", "out", "--no-preview", "--flat")
SHORT_RECIPE = """\
format: 1
name: {name}
units: cm
fps: 8
balloons:
  main: {{size: 260, length: 9.2, color: blue, tail: 3}}
steps:
  - bubbles: {{nose: 4}}
  - rest: tail
physics: {{hold: 0.5}}
"""


@pytest.fixture
def again(cli, solver, tmp_path):
    """Type a run once more; return the names of the recipes that it made anew."""

    def again(*words, recipes="recipes"):
        before = len(solver.calls)
        result = cli("run", recipes, *words)
        assert result.exit_code == 0, result.output
        again.said = result.stderr
        return sorted(name for names in solver.calls[before:] for name in names)

    return again


def test_what_is_there_is_skipped_and_what_is_broken_is_made_anew(again, write_recipes, tmp_path):
    write_recipes("a", "b", "c", "d")
    out = tmp_path / "out"
    assert again(*ORDER) == ["a", "b", "c", "d"]
    first = runs.tree(out)

    assert again(*ORDER) == []
    assert again.said.count("already there and whole, skipped (--force makes it anew)") == 4
    assert runs.tree(out) == first

    flipped = bytearray(first["a.report.png"])
    flipped[len(flipped) // 2] ^= 1
    (out / "a.report.png").write_bytes(flipped)
    (out / "b.report.json").unlink()
    (out / "c.usdc").write_bytes(first["c.usdc"][:-1])
    assert again(*ORDER) == ["a", "b", "c"]
    assert runs.tree(out) == first

    # A journal that was cut short knows all but its last line.
    lines = (out / "batch.jsonl").read_text().splitlines(keepends=True)
    (out / "batch.jsonl").write_text("".join(lines[:-1]) + lines[-1][:100])
    assert again(*ORDER) == ["d"]
    assert runs.tree(out) == first

    (out / "batch.jsonl").unlink()
    assert again(*ORDER, "--jobs", 1) == ["a", "b", "c", "d"]
    assert runs.tree(out) == first
    assert again(*ORDER, "--force") == ["a", "b", "c", "d"]
    assert runs.tree(out) == first


@pytest.mark.long
def test_what_was_made_of_something_else_is_made_anew(again, write_recipes, tmp_path):
    recipe = write_recipes("a", "b") / "a.yaml"
    assert again(*ORDER, "--no-report") == ["a", "b"]
    assert again(*ORDER) == ["a", "b"], "a report is asked for now"
    assert again(*ORDER, "--no-report") == [], "more than is asked for is there"
    recipe.write_text(recipe.read_text() + "# changed\n")
    assert again(*ORDER) == ["a"]
    assert again(*ORDER, "--detail", "preview") == ["a", "b"]
    assert again(*ORDER, "--detail", "preview", "--frames", "2:3") == ["a", "b"]
    assert again(*ORDER, "--detail", "preview", "--frames", "2:3", "--device", "cpu") == []
    journal = tmp_path / "out" / "batch.jsonl"
    journal.write_text(journal.read_text().replace('"version": "', '"version": "0.', 1))
    assert again(*ORDER, "--detail", "preview", "--frames", "2:3") == ["a"]
    (tmp_path / "out").rename(tmp_path / "moved")
    assert again("-o", "moved", *ORDER[2:], "--detail", "preview", "--frames", "2:3") == []


def test_a_line_for_each_recipe_is_kept_in_the_order_of_the_recipes(again, solver, write_recipes, tmp_path):
    write_recipes("c", "a", "b")
    again("-o", "out", "--no-preview", "--flat", "--no-report")
    write_recipes("z", folder="more")
    again("-o", "out", "--no-preview", "--flat", "--no-report", recipes="more")
    lines = [json.loads(line) for line in (tmp_path / "out" / "batch.jsonl").read_text().splitlines()]
    assert [line["name"] for line in lines] == ["z", "a", "b", "c"]
    assert all(len(line["files"]) == 1 for line in lines)
