"""Jobs as a farm runs them, with OpenJD's own command line."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import balloon_usd
from tests import interruptible

ROOT = Path(balloon_usd.__file__).parents[1]
ENVIRONMENT = {**os.environ, "PYTHONPATH": str(ROOT)}


def openjd(*words):
    command = [sys.executable, "-m", "openjd", *map(str, words)]
    return subprocess.run(command, env=ENVIRONMENT, capture_output=True, text=True, timeout=120, check=False)


@pytest.fixture
def program(folder):
    """A program that starts the very code under test."""
    script = folder / "balloon-usd"
    script.write_text(f'#!/bin/sh\nexec "{sys.executable}" -m balloon_usd "$@"\n')
    script.chmod(0o755)
    return script


def test_a_job_passes_openjds_check_and_its_tasks_make_the_stages(cli, folder, write_recipe, program):
    for name in ("cat", "dog", "my dachshund"):
        write_recipe(f"recipes/{name}.yaml", name=name.split()[-1])
    short = ["--frames", ":2", "--no-preview", "--no-report", "--device", "cpu", "--flat"]
    assert cli("farm-template", "recipes", "--chunk", 2, "-o", "job.yaml", *short).exit_code == 0
    checked = openjd("check", "job.yaml")
    assert checked.returncode == 0, checked.stdout
    done = openjd("run", "job.yaml", "-p", f"Command={program}", "-p", "Output=stages")
    assert done.returncode == 0, done.stdout
    assert "Chunks run: 2" in done.stdout
    assert "openjd_progress: 100" in done.stdout
    stages = sorted(path.name for path in (folder / "stages").iterdir())
    assert stages == ["batch.jsonl", "cat.usdc", "dachshund.usdc", "dog.usdc"]


def test_a_task_whose_recipe_is_gone_fails_with_the_line_that_says_so(cli, folder, write_recipe):
    recipe = write_recipe("recipes/dog.yaml")
    (folder / "chunks.jsonl").write_text('["dog.yaml"]\n')
    recipe.unlink()
    result = cli("farm-task", "chunks.jsonl", 1, "recipes", "--", "--output", "out")
    assert result.exit_code == 2
    assert "recipes/dog.yaml:1:1: cannot be read (No such file or directory)" in result.stdout


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (["chunks.jsonl", 2, "recipes"], "chunks.jsonl: there is no chunk 2, expected 1 to 1"),
        (["gone.jsonl", 1, "recipes"], "gone.jsonl: cannot be read (No such file or directory)"),
    ],
)
def test_a_task_without_a_chunk_fails_in_one_line(cli, folder, words, problem):
    (folder / "chunks.jsonl").write_text('["dog.yaml"]\n')
    result = cli("farm-task", *words)
    assert (result.exit_code, result.stderr) == (2, f"{problem}\n")


def test_a_task_that_the_farm_ends_leaves_nothing_half_written(folder, write_recipe):
    write_recipe("recipes/dog.yaml")
    (folder / "chunks.jsonl").write_text('["dog.yaml"]\n')
    words = [
        "farm-task",
        "chunks.jsonl",
        "1",
        "recipes",
        "--",
        "--output",
        "out",
        "--device",
        "cpu",
        "--detail",
        "full",
    ]
    task = interruptible.start([sys.executable, "-m", "balloon_usd", *words], env=ENVIRONMENT)
    for line in task.stdout:
        if line == "openjd_status: inflate: main\n":
            break
    task.send_signal(signal.SIGTERM)
    _, error = task.communicate(timeout=30)
    assert task.returncode == 143
    assert error == "terminated, nothing half-written is left\n"
    assert list((folder / "out").iterdir()) == []
