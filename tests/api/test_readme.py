"""What the README shows works as it is shown."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from click.testing import CliRunner

from balloon_usd import Recipe, RecipeError, plan_recipe
from balloon_usd.cli import main
from balloon_usd.operations.table import WORDS

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")
TINY = """\
format: 1
name: dog
units: cm
fps: 8
balloons:
  main: {size: 260, length: 5, tail: 2}
steps:
  - bubbles: {head: 5}
  - rest: tail
"""


def blocks(language: str) -> list[str]:
    """The fenced blocks of a language."""
    return re.findall(rf"^```{language}\n(.*?)^```$", README, re.DOTALL | re.MULTILINE)


def test_the_first_recipe_fits_without_cautions() -> None:
    (text,) = blocks("yaml")
    assert plan_recipe(Recipe.parse(text)).cautions == ()


def test_a_slip_is_told_as_shown() -> None:
    (text,) = blocks("yaml")
    with pytest.raises(RecipeError) as raised:
        Recipe.parse(text.replace("lock: [left_ear,", "lock: [lft_ear,"), file="mouse.yaml")
    assert f"   {raised.value}\n" in README


@pytest.mark.parametrize("code", blocks("python"), ids=["from a recipe", "from a builder"])
def test_the_python_examples_run(code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("recipes").mkdir()
    Path("recipes/dog.yaml").write_text(TINY)
    exec(compile(code, "README.md", "exec"), {})


@pytest.mark.parametrize("kind", WORDS)
def test_every_operation_is_explained(kind: str) -> None:
    assert f"| `{kind}: " in README


@pytest.mark.parametrize("command", main.commands)
def test_every_command_is_explained(command: str) -> None:
    assert f"`balloon-usd {command}" in README
    assert CliRunner().invoke(main, [command, "--help"]).exit_code == 0
