"""What the README and the pages show works as it is shown."""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

import pytest
import yaml
from click.testing import CliRunner

import balloon_usd
from balloon_usd import Recipe, RecipeError, plan_recipe
from balloon_usd.cli import main

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text(encoding="utf-8")
EXAMPLES = ROOT / "docs/examples"
PAGES = sorted(ROOT.glob("*.md")) + sorted((ROOT / "docs").rglob("*.md"))
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


def page(name: str) -> str:
    """A page below docs."""
    return (ROOT / "docs" / name).read_text(encoding="utf-8")


def mouse() -> str:
    """The first recipe."""
    return (EXAMPLES / "mouse.yaml").read_text(encoding="utf-8")


def test_the_readme_is_short() -> None:
    assert len(README.splitlines()) <= 200


def test_package_readme_and_citation_name_the_same_licences() -> None:
    licences = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["license"]
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8"))
    assert f"Licence: {licences}: " in README
    assert f"Licence: {licences}: " in citation["abstract"]
    assert licences.startswith(citation["license"])


def test_the_first_recipe_fits_without_cautions() -> None:
    assert plan_recipe(Recipe.parse(mouse())).cautions == ()


def test_the_readme_shows_the_first_recipe() -> None:
    assert re.findall(r"^```yaml\n(.*?)^```$", README, re.DOTALL | re.MULTILINE) == [mouse()]


@pytest.mark.parametrize("text", [README, page("tutorial/first_figure.md")], ids=["README", "tutorial"])
def test_a_slip_is_told_as_shown(text: str) -> None:
    with pytest.raises(RecipeError) as raised:
        Recipe.parse(mouse().replace("lock: [left_ear,", "lock: [lft_ear,"), file="mouse.yaml")
    assert str(raised.value) in [line.strip() for line in text.splitlines()]


@pytest.mark.parametrize("example", ["from_recipe.py", "from_builder.py"])
def test_the_python_examples_run(example: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("recipes").mkdir()
    Path("recipes/dog.yaml").write_text(TINY)
    exec(compile((EXAMPLES / example).read_text(encoding="utf-8"), example, "exec"), {})


@pytest.mark.parametrize("example", sorted(path.name for path in EXAMPLES.iterdir()))
def test_every_example_is_shown_on_a_page(example: str) -> None:
    assert any(f"<!-- generated: example {example} -->" in path.read_text("utf-8") for path in PAGES)


@pytest.mark.parametrize("command", main.commands)
def test_every_command_is_explained(command: str) -> None:
    assert f"`balloon-usd {command}" in page("reference/command_line.md")
    assert CliRunner().invoke(main, [command, "--help"]).exit_code == 0


@pytest.mark.parametrize("name", sorted(set(balloon_usd.__all__) - {"__version__"}))
def test_every_public_name_has_its_docstring_on_a_page(name: str) -> None:
    assert re.search(rf":: balloon_usd\.{name}(\(\))?$", page("reference/python.md"), re.MULTILINE)


@pytest.mark.parametrize("path", PAGES, ids=[str(path.relative_to(ROOT)) for path in PAGES])
def test_lines_of_a_page_are_no_longer_than_130_characters(path: Path) -> None:
    # A row of a table is one line.
    text = re.sub(r"<!-- generated: .*?<!-- end", "", path.read_text(encoding="utf-8"), flags=re.DOTALL)
    assert max(len(line) for line in text.splitlines()) <= 130


@pytest.mark.parametrize("path", PAGES, ids=[str(path.relative_to(ROOT)) for path in PAGES])
def test_links_of_a_page_lead_to_files(path: Path) -> None:
    text = re.sub(r"^```.*?^```$", "", path.read_text(encoding="utf-8"), flags=re.DOTALL | re.MULTILINE)
    in_place, below = r"\]\(([^)#]+)[^)]*\)", r"^\[[^]]+\]: (\S+)$"
    for target in re.findall(in_place, text) + re.findall(below, text, re.MULTILINE):
        assert "://" in target or (path.parent / target).is_file(), target
