"""Runs as processes of their own: started, watched through /proc, killed, and compared by what they leave."""

from __future__ import annotations

import json
import os
import signal
import sys
import time
from contextlib import suppress
from pathlib import Path

import balloon_usd
from tests import interruptible

ROOT = Path(balloon_usd.__file__).parents[1]
WORKER = "balloon_usd.batch.worker"
PATIENCE = 120
"""Seconds after which a run hangs; the slowest one of this folder takes a tenth of that."""


def start(*words, **options):
    """Start `balloon-usd run` with words."""
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([*sys.path[:1], str(ROOT)])}
    command = [sys.executable, "-m", "balloon_usd", "run", *map(str, words)]
    return interruptible.start(command, env=environment, **options)


def run(*words, **options):
    """Run to the end; return the exit code and what was told."""
    process = start(*words, **options)
    out, err = process.communicate(timeout=PATIENCE)
    return process.returncode, out + err


def workers(parent, role=""):
    """Return the processes that a run has started, of a role if one is named."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        with suppress(OSError, ValueError, IndexError):
            words = (entry / "cmdline").read_bytes().decode().split("\0")
            if (
                WORKER in words
                and words[-2] == str(parent)
                and words[words.index(WORKER) + 1].startswith(role)
            ):
                found.append(int(entry.name))
    return sorted(found)


def all_gone(parent, seconds=5.0):
    """Whether no process of a run is left after some seconds at most."""
    end = time.monotonic() + seconds
    while workers(parent):
        if time.monotonic() > end:
            return False
        time.sleep(0.05)
    return True


def kill(pid):
    with suppress(ProcessLookupError):
        os.kill(pid, signal.SIGKILL)


def tree(folder):
    """Return all that a folder holds, hidden files too; of the journal all but the time that each recipe took."""
    found = {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
    journal = found.pop("batch.jsonl", b"").decode().splitlines()
    found["batch.jsonl"] = [{**json.loads(line), "seconds": 0} for line in journal]
    return found


def records(folder):
    """Return the lines of the journal by the names of their sculptures."""
    lines = (folder / "batch.jsonl").read_text().splitlines()
    return {record["name"]: record for record in map(json.loads, lines)}
