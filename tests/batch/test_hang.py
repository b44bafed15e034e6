"""Runs that must end: many short ones, in a row and side by side, each with a watchdog."""

from __future__ import annotations

import subprocess

import pytest

from tests.batch import runs
from tests.batch.conftest import write_recipes_into


def hung(words, folder, count, at_once):
    """Run so often, some at once; return how many hung, and how those ended that did not."""
    hangs, codes = 0, []
    for first in range(0, count, at_once):
        numbers = range(first, min(first + at_once, count))
        processes = [runs.start(*words, "-o", str(number), cwd=folder) for number in numbers]
        for process in processes:
            try:
                process.communicate(timeout=runs.PATIENCE)
                codes.append(process.returncode)
            except subprocess.TimeoutExpired:
                hangs += 1
                process.kill()
                process.communicate()
    return hangs, codes


@pytest.mark.parametrize(
    ("count", "at_once", "recipes"),
    [
        (2, 1, 6),
        pytest.param(4, 4, 6, marks=pytest.mark.long),
        pytest.param(160, 1, 16, marks=pytest.mark.long),
        pytest.param(40, 4, 16, marks=pytest.mark.long),
    ],
)
def test_no_run_hangs(count, at_once, recipes, solver, tmp_path):
    folder = write_recipes_into(tmp_path / "recipes", [f"s{number}" for number in range(recipes)])
    words = (folder, "--flat", "--no-preview", "--no-report")
    hangs, codes = hung(words, tmp_path, count, at_once)
    print(f"{hangs} of {count} runs hung, {at_once} at once")
    assert (hangs, codes) == (0, [0] * count)
    expected = runs.tree(tmp_path / "0")
    assert all(runs.tree(tmp_path / str(number)) == expected for number in range(count))


@pytest.mark.long
@pytest.mark.parametrize("rounds", [1, 20])
def test_the_same_recipes_run_twice_at_once_end_in_whole_files(rounds, solver, tmp_path):
    recipes = write_recipes_into(tmp_path / "recipes", "abcd")
    once = runs.start(recipes, "-o", "once", "--no-preview", cwd=tmp_path)
    assert once.communicate(timeout=runs.PATIENCE)[0]
    for number in range(rounds):
        words = (recipes, "--no-preview", "--force", "-o", f"twice{number}")
        both = [runs.start(*words, cwd=tmp_path) for _ in range(2)]
        said = [process.communicate(timeout=runs.PATIENCE)[1] for process in both]
        assert [process.returncode for process in both] == [0, 0], said
        assert runs.tree(tmp_path / f"twice{number}") == runs.tree(tmp_path / "once")
