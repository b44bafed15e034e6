"""A call in a child process: what it gives, and every way in which the child can end."""

from __future__ import annotations

import ctypes
import os
import signal
import sys
import time
import warnings
from collections import deque
from itertools import repeat
from pathlib import Path

import pytest
from pxr import Tf

from balloon_usd.cli import child_memory, child_process
from balloon_usd.cli.child_process import ChildProcess, DamagedError, read_in_child, remove_unfinished
from balloon_usd.cli.failure import ExitCode, Failure
from balloon_usd.files.lock import hold
from tests import interruptible

if sys.platform == "win32":
    pytest.skip("the work is done in this process there", allow_module_level=True)

NOWHERE = Path("nowhere"), ""


def add(one, other):
    return one + other


def number():
    return os.getpid()


def crash():
    return ctypes.string_at(0)


def report_of_a_crash():
    Tf.Fatal("a library gives up")


def end(code):
    os._exit(code)


def send(ending):
    os.kill(os.getpid(), ending)
    time.sleep(60)


def give(error):
    raise error


def claim(count):
    return len(bytearray(count))


def stand_still():
    deque(repeat(None), maxlen=0)


def get_on():
    time.sleep(5)
    return "done"


def warn():
    warnings.warn("a library warns", stacklevel=1)
    os.write(1, b"printed\n")


def begin_and_crash(folder):
    with hold(folder / ".sheet.png.01234567.partial"):
        crash()


@pytest.fixture
def child():
    with ChildProcess() as child:
        yield child


def alive(process):
    """Whether a process is there and no zombie."""
    try:
        return Path(f"/proc/{process}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def waits_for(what, seconds=20):
    deadline = time.monotonic() + seconds
    while not (found := what()) and time.monotonic() < deadline:
        time.sleep(0.02)
    return found


def test_one_child_does_one_call_after_the_other_and_is_gone_in_the_end():
    with ChildProcess() as child:
        assert child.call([], add, 1, other=2) == 3
        process = child.call([], number)
        assert process not in (os.getpid(), child.call([], os.getppid))
        assert child.call([], number) == process
    assert not alive(process)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        ((crash,), "reading it crashed (SIGSEGV)"),
        ((send, signal.SIGABRT), "reading it crashed (SIGABRT)"),
        ((send, signal.SIGBUS), "reading it crashed (SIGBUS)"),
        ((send, signal.SIGKILL), "reading it was killed, perhaps for taking all memory"),
        ((end, 0), "reading it ended with exit code 0"),
        ((give, SystemExit(3)), "reading it ended with exit code 3"),
        ((give, MemoryError()), "it claims more than fits into memory"),
        ((claim, 1 << 45), "it claims more than fits into memory"),
        ((give, IndexError("a\n\x1bb")), "a value cannot be read (IndexError: a ?b)"),
        (
            (add, 1, "x"),
            "a value cannot be read (TypeError: unsupported operand type(s) for +: 'int' and 'str')",
        ),
        ((give, ValueError("x" * 500)), f"a value cannot be read (ValueError: {'x' * 160}...)"),
    ],
)
def test_a_child_that_breaks_off_is_told_in_a_line_and_followed_by_another(child, capfd, words, said):
    with pytest.raises(DamagedError) as told:
        child.call(["no.usdz"], *words)
    assert str(told.value) == said
    assert child.call([], add, 1, 2) == 3
    assert capfd.readouterr() == ("", "")


def test_a_crash_leaves_no_report_of_the_library(child, tmp_path, monkeypatch):
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    with pytest.raises(DamagedError, match="SIGABRT"):
        child.call(["no.usdz"], report_of_a_crash)
    assert [*tmp_path.iterdir()] == []


def test_a_child_that_does_not_get_on_is_given_up(child, monkeypatch):
    monkeypatch.setattr(child_process, "GLANCE", 0.1)
    monkeypatch.setattr(child_process, "STALLED", 4.0)
    monkeypatch.setattr(child_process, "GRACE", 0.2)
    with pytest.raises(DamagedError, match="reading it did not get on for"):
        child.call(["no.usdz"], stand_still)
    assert child.call([], get_on) == "done"


@pytest.mark.parametrize("error", [Failure("so", ExitCode.NOT_WRITTEN), OSError(28, "full", "here")])
def test_errors_of_the_program_and_the_system_are_raised_as_they_are(child, error):
    with pytest.raises(type(error)) as told:
        child.call([], give, error)
    assert str(told.value) == str(error)
    assert getattr(told.value, "exit_code", None) == getattr(error, "exit_code", None)


def test_what_libraries_print_is_passed_on_where_that_is_wanted(child, capsys):
    child.call([], warn)
    assert capsys.readouterr().err == ""
    child.pass_on()
    out, err = capsys.readouterr()
    assert out == ""
    assert "UserWarning: a library warns" in err
    assert err.endswith("printed\n")


def test_memory_is_allowed_by_the_size_of_a_stage(tmp_path, monkeypatch):
    monkeypatch.setattr(child_memory, "SHARE", 1000.0)
    folder = tmp_path / "dog"
    folder.mkdir()
    (folder / "dog.usdc").write_bytes(bytes(5000))
    file, nothing = str(folder / "dog.usdc"), str(tmp_path / "no\0")
    assert child_memory.bytes_there([file, nothing]) == 5000
    assert child_memory.bytes_there([str(folder)]) > 5000
    more = child_memory.memory_for(5000) - child_memory.memory_for(0)
    assert more == 5000 * child_memory.TIMES_AS_MUCH
    assert child_memory.memory_for(0) > child_memory.LEAST


def test_a_small_stage_of_large_files_elsewhere_may_take_more(child, tmp_path, monkeypatch):
    (tmp_path / "far.usda").write_text(f"#usda 1.0\n# {'x' * 4_000_000}\n")
    (tmp_path / "near").mkdir()
    near = tmp_path / "near" / "near.usda"
    near.write_text("#usda 1.0\n(\n    subLayers = [@../far.usda@]\n)\n")
    monkeypatch.setattr(child_memory, "LEAST", 500 << 20)
    assert child.call([near], claim, 700 << 20) == 700 << 20
    with pytest.raises(DamagedError, match="more than fits"):
        child.call([near], claim, 4000 << 20)


def test_what_a_child_has_begun_when_it_crashes_is_removed(tmp_path):
    other = tmp_path / ".sheet.png.76543210.partial"
    held = hold(other)
    with pytest.raises(Failure) as told:
        read_in_child("dog.usdz", (tmp_path, "sheet"), begin_and_crash, tmp_path)
    assert told.value.message == "dog.usdz: damaged: reading it crashed (SIGSEGV)"
    assert told.value.exit_code == 2
    assert [*tmp_path.iterdir()] == [other]
    held.close()
    remove_unfinished(tmp_path, "sheet")
    assert [*tmp_path.iterdir()] == []


MAIN = """
import sys
from pathlib import Path
import click
from balloon_usd.cli.group import Commands
from balloon_usd.cli.child_process import read_in_child
from busy import begin

@click.group(cls=Commands)
def main(): pass

@main.command()
def draw():
    read_in_child("dog", (Path("out"), "sheet"), begin, Path("out"), Path("mark"))

main()
"""
BUSY = """
import os, time
from balloon_usd.files.lock import hold

def begin(folder, mark):
    partial = folder / ".sheet.png.01234567.partial"
    try:
        with hold(partial):
            mark.write_text(str(os.getpid()))
            time.sleep(60)
    finally:
        partial.unlink()
"""


@pytest.mark.parametrize("kind", ["a new interpreter", "forked"])
@pytest.mark.parametrize("ending", [signal.SIGINT, signal.SIGTERM, signal.SIGKILL])
def test_a_command_that_is_ended_leaves_no_child_and_no_file(kind, ending, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "busy.py").write_text(BUSY)
    paths = os.pathsep.join([*sys.path, str(tmp_path)])
    text = MAIN if kind == "forked" else f"import pxr\n{MAIN}"
    words = [sys.executable, "-c", text, "draw"]
    process = interruptible.start(words, cwd=tmp_path, env={**os.environ, "PYTHONPATH": paths})
    mark = tmp_path / "mark"
    assert waits_for(lambda: mark.exists() and mark.read_text())
    child = int(mark.read_text())
    assert (Path(f"/proc/{child}/cmdline").read_bytes().count(b"serve") > 0) == (kind != "forked")
    process.send_signal(ending)
    out, err = process.communicate(timeout=20)
    assert waits_for(lambda: not alive(child))
    assert out == ""
    if ending == signal.SIGKILL:
        assert (process.returncode, err) == (-ending, "")
        return
    word = "interrupted" if ending == signal.SIGINT else "terminated"
    assert (process.returncode, err) == (128 + ending, f"{word}, nothing half-written is left\n")
    assert [*(tmp_path / "out").iterdir()] == []
