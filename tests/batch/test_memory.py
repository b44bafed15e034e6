"""What a run holds does not grow with the number of its recipes."""

from __future__ import annotations

import threading
import time
from contextlib import suppress
from pathlib import Path

import pytest

from tests.batch import runs
from tests.batch.conftest import write_recipes_into


def held(pid):
    """Return the peak memory of a process [kB] and how many files it has open."""
    entry = Path("/proc") / str(pid)
    status = dict(line.split(":", 1) for line in (entry / "status").read_text().splitlines())
    return int(status["VmHWM"].split()[0]), len(list((entry / "fd").iterdir()))


def most_held(recipes, folder):
    """Run; return the most memory and open files of the scheduler, the writers and the simulators."""
    process = runs.start(recipes, "-o", folder, "--flat", "--no-preview", "--no-report", "--device", "cpu")
    most, told = {}, []
    # It says more than a pipe holds.
    listener = threading.Thread(target=lambda: told.extend(process.communicate()))
    listener.start()
    while listener.is_alive():
        found = {pid: role for role in ("writer", "simulator") for pid in runs.workers(process.pid, role)}
        for pid, role in {process.pid: "scheduler", **found}.items():
            with suppress(OSError, KeyError, ValueError):
                most[role] = tuple(map(max, held(pid), most.get(role, (0, 0))))
        time.sleep(0.05)
    assert process.returncode == 0, told[1][-2000:]
    return most


@pytest.mark.parametrize(
    ("few", "many"), [(8, 40), pytest.param(40, 400, marks=pytest.mark.long)], ids=["40", "400"]
)
def test_memory_and_open_files_do_not_grow_with_recipes(few, many, solver, tmp_path):
    found = {}
    for count in (few, many):
        recipes = write_recipes_into(tmp_path / f"recipes{count}", [f"s{number}" for number in range(count)])
        found[count] = most_held(recipes, tmp_path / f"out{count}")
    print(found)
    for role in ("scheduler", "writer", "simulator"):
        (memory, files), (memory_of_many, files_of_many) = found[few][role], found[many][role]
        assert memory_of_many <= 1.1 * memory, (role, found)
        assert files_of_many <= files + 4, (role, found)
