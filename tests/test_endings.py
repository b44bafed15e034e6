"""Signals that end a process, at moments at which Python drops exceptions."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

import balloon_usd
from balloon_usd.endings import endings_wait, never_dropped

ROOT = Path(balloon_usd.__file__).parents[1]


class Ended(BaseException):
    pass


class Finalized:
    """Asks its process to end in the middle of its finalizer."""

    def __del__(self):
        os.kill(os.getpid(), signal.SIGTERM)
        for _ in range(100):
            time.sleep(0)


@pytest.fixture
def terminable():
    def terminate(*_):
        raise Ended

    before = signal.signal(signal.SIGTERM, terminate)
    yield
    signal.signal(signal.SIGTERM, before)


def wait():
    end = time.monotonic() + 10
    while time.monotonic() < end:
        time.sleep(0.01)
    return "nobody asked"


def test_what_a_finalizer_drops_ends_the_block_all_the_same(terminable, capfd):
    def finalize():
        Finalized()
        return wait()

    with pytest.raises(Ended), never_dropped(Ended):
        finalize()
    assert capfd.readouterr().err == ""


def test_other_exceptions_of_finalizers_are_told_as_ever(capfd):
    class Broken:
        def __del__(self):
            raise ValueError("broken")

    told = []
    before, sys.unraisablehook = sys.unraisablehook, told.append
    try:
        with never_dropped(Ended):
            Broken()
    finally:
        sys.unraisablehook = before
    assert [each.exc_type for each in told] == [ValueError]


def test_what_waits_for_the_end_of_a_block_comes_then(terminable):
    done = []

    def work():
        with endings_wait():
            os.kill(os.getpid(), signal.SIGTERM)
            time.sleep(0.01)
            done.append("all")
        return wait()

    with pytest.raises(Ended):
        work()
    assert done == ["all"]


COMMAND = """
import os, signal, time
import click
from balloon_usd.cli.group import Commands

class Finalized:
    def __del__(self):
        os.kill(os.getpid(), signal.{ending})
        for _ in range(100):
            time.sleep(0)

@click.group(cls=Commands)
def main(): pass

@main.command()
def sit():
    Finalized()
    time.sleep(20)

main()
"""


@pytest.mark.parametrize(
    ("ending", "code", "told"), [("SIGINT", 130, "interrupted"), ("SIGTERM", 143, "terminated")]
)
def test_a_command_ends_wherever_it_is_asked_to(ending, code, told):
    done = subprocess.run(
        [
            sys.executable,
            "-c",
            f"import signal; signal.signal(signal.SIGINT, signal.default_int_handler)\n{COMMAND.format(ending=ending)}",
            "sit",
        ],
        cwd=ROOT,
        capture_output=True,
        text=True,
        timeout=15,
        check=False,
    )
    assert (done.returncode, done.stderr) == (code, f"{told}, nothing half-written is left\n")
