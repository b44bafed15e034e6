"""`run_batch`, as a program calls it: wrong values are refused before anything starts, and errors come back."""

from __future__ import annotations

import gc
import weakref
from pathlib import Path
from types import SimpleNamespace

import pytest

from balloon_usd import BatchError, FrameRange, Machine, NotKept, Order, StageError, Status, run_batch
from balloon_usd.batch.messages import NotMade, Role, Start
from balloon_usd.batch.watch import Silence
from balloon_usd.batch.writer import Writer

ALONE = Machine(1, ("cpu",))


def order(folder, **more):
    return Order(folder, preview=False, report=False, **more)


def test_the_folder_is_made_and_a_refused_recipe_takes_no_other_along(solver, write_recipe, tmp_path):
    folder = tmp_path / "new" / "folder"
    records = run_batch([tmp_path / "none.yaml", write_recipe()], order(folder), ALONE)
    assert [record.status for record in records] == [Status.REFUSED, Status.DONE]
    assert (folder / "snake" / "snake.usda").exists()


def test_a_folder_may_be_a_text(solver, write_recipe, tmp_path):
    (record,) = run_batch([write_recipe()], order(str(tmp_path / "out")), ALONE)
    assert record.status is Status.DONE


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"detail": "coarse"}, "unknown detail 'coarse', expected one of draft"),
        ({"look": "glass"}, 'unknown look "glass", expected one of recipe'),
        ({"flat": True, "usdz": True}, "flat and usdz exclude each other"),
        ({"usdz": True, "shot": True}, "shot and usdz exclude each other"),
    ],
)
def test_what_cannot_be_ordered_is_told_at_once(wrong, told):
    with pytest.raises(ValueError, match=told):
        order("out", **wrong)


def test_frames_are_a_range_and_recipes_a_list():
    with pytest.raises(TypeError, match=r"frames are \(1, 5\), expected a FrameRange"):
        order("out", frames=(1, 5))
    assert order("out", frames=FrameRange(1, 5)).frames.last == 5
    with pytest.raises(TypeError, match="is one recipe, expected a list"):
        run_batch("dog.yaml", order("out"), ALONE)


@pytest.mark.parametrize("cores", [0, -1])
def test_a_machine_without_cores_or_devices_is_refused_and_not_waited_for(cores):
    with pytest.raises(ValueError, match="cores make nothing, expected at least 1"):
        Machine(cores)
    with pytest.raises(ValueError, match="no device"):
        Machine(1, ())


def test_what_a_watch_raises_comes_back_as_it_is(solver, write_recipe, tmp_path):
    class Deaf(Silence):
        def ended(self, record):
            raise ConnectionError("nobody is there")

    with pytest.raises(ConnectionError, match="nobody is there"):
        run_batch([write_recipe()], order(tmp_path / "out"), ALONE, Deaf())


def test_a_journal_that_cannot_be_written_is_an_error_of_the_batch(
    solver, write_recipe, tmp_path, monkeypatch
):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("balloon_usd.batch.journal.locked", full)
    with pytest.raises(BatchError, match="cannot be written: No space left on device") as told:
        run_batch([write_recipe()], order(tmp_path / "out"), ALONE)
    assert isinstance(told.value, NotKept)


class _Mapped:
    """What holds room on a disk, as files do that are deleted while they are mapped."""


class _Full:
    """A sculpture whose disk is full; its error has seen what is mapped."""

    part = SimpleNamespace(file="snake.yaml", job=0, batch=0, last=9)
    failed = ""

    def __init__(self):
        self.mapped = None

    def add(self, _frame):
        mapped = _Mapped()
        self.mapped = weakref.ref(mapped)
        raise StageError("No space left on device")

    def finish(self):
        self.add(None)

    def stop(self):
        gc.collect()


class _Listening:
    """A connection that looks at what is still mapped when it is told that a stage was not made."""

    def __init__(self, sculpture):
        self.sculpture, self.told = sculpture, []

    def send(self, message):
        if isinstance(message, NotMade):
            self.told.append((message.why, self.sculpture.mapped()))


@pytest.mark.parametrize("late", [False, True], ids=["while frames come", "at the end"])
def test_a_full_disk_has_room_again_before_it_is_told(late):
    sculpture = _Full()
    heard = _Listening(sculpture)
    writer = Writer(heard, Start(Role.WRITER, Order(Path("out")), "cpu"))
    if late:
        writer._complete.append(sculpture)
        writer._finish(sculpture)
    else:
        batch = SimpleNamespace(sculptures={0: sculpture})
        writer._write(batch, 0, [None])
        assert not batch.sculptures
    assert heard.told == [("snake.yaml: No space left on device", None)]
