"""What a run holds does not grow with the number of its recipes."""

from __future__ import annotations

import threading
import time
from contextlib import suppress
from pathlib import Path

import pytest

from tests.batch import runs
from tests.batch.conftest import write_recipes_into

LOOKS = 4
"""Looks in a row, a twentieth of a second apart, in which a file counts as held."""


def held(pid):
    """Return the peak memory of a process [kB] and how many files it has open."""
    entry = Path("/proc") / str(pid)
    status = dict(line.split(":", 1) for line in (entry / "status").read_text().splitlines())
    return int(status["VmHWM"].split()[0]), len(list((entry / "fd").iterdir()))


def sustained(counts):
    """Return the most of what was held in several looks in a row: files that are read at a start are open
    for moments.
    """
    return max(min(counts[at : at + LOOKS]) for at in range(max(1, len(counts) - LOOKS + 1)))


def most_held(recipes, folder):
    """Run; return the most memory and open files of the scheduler, the writers and the simulators."""
    process = runs.start(recipes, "-o", folder, "--flat", "--no-preview", "--no-report", "--device", "cpu")
    memory, files, told = {}, {}, []
    # It says more than a pipe holds.
    listener = threading.Thread(target=lambda: told.extend(process.communicate()))
    listener.start()
    while listener.is_alive():
        found = {pid: role for role in ("writer", "simulator") for pid in runs.workers(process.pid, role)}
        for pid, role in {process.pid: "scheduler", **found}.items():
            with suppress(OSError, KeyError, ValueError):
                peak, opened = held(pid)
                memory[role] = max(peak, memory.get(role, 0))
                files.setdefault((role, pid), []).append(opened)
        time.sleep(0.05)
    assert process.returncode == 0, told[1][-2000:]
    open_files = {
        role: max(sustained(each) for (of, _), each in files.items() if of == role) for role in memory
    }
    return {role: (memory[role], open_files[role]) for role in memory}


@pytest.mark.long
@pytest.mark.parametrize(("few", "many"), [(8, 40), (40, 400)], ids=["40", "400"])
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
