"""Threads that use OpenUSD at once take turns: none waits for ever, and none fails."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from queue import Queue
from threading import Thread
from typing import TYPE_CHECKING

import pytest
from pxr import Usd

import balloon_usd
from balloon_usd.diff import differences
from balloon_usd.diff.drawing import draw_comparison
from balloon_usd.openusd import usd_access
from balloon_usd.preview import read_stage
from balloon_usd.stage import StageWriter, write_stage
from balloon_usd.stage.properties import check_property, check_selections, check_stage, check_variants
from tests.stage.tubes import frames, sculpture

if TYPE_CHECKING:
    from tests.stage.tubes import Frame

ROOT = Path(__file__).parents[2]
SOON, LATE = 0.05, 120.0
"""Times in which a thread that need not wait has begun, and after which it is stuck (s)."""


@pytest.mark.parametrize(("kind", "count"), [("first_calls", 50), ("names", 3), ("beside_imports", 4)])
def test_threads_that_begin_at_once_all_end(kind: str, count: int) -> None:
    """Without a lock a process in seven hung in its first calls, and every one that loaded or imported."""
    words = [sys.executable, str(Path(__file__).with_name("starts.py")), kind, str(count)]
    environment = {**os.environ, "PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"}
    done = subprocess.run(words, env=environment, capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("", "")


@pytest.fixture(scope="module")
def dog(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The dog in one file. Only to be read."""
    return write_stage(sculpture(), frames(2), tmp_path_factory.mktemp("dog"), flat=True).files[0]


def begin(act: Callable[[], object]) -> tuple[Thread, list[object]]:
    """Do something in another thread; what it returns is put into a list."""
    done: list[object] = []
    thread = Thread(target=lambda: done.append(act()), daemon=True)
    thread.start()
    return thread, done


def on_stage(act: Callable[[object], object]) -> Callable[[Path, Path], Callable[[], object]]:
    """Something that is done with an open stage."""

    def prepare(dog: Path, folder: Path) -> Callable[[], object]:
        stage = Usd.Stage.Open(str(dog))
        return lambda: act(stage)

    return prepare


def of_writer(act: Callable[[StageWriter], object]) -> Callable[[Path, Path], Callable[[], object]]:
    """Something that is done with a stage that is being written."""

    def prepare(dog: Path, folder: Path) -> Callable[[], object]:
        writer = StageWriter(sculpture(), folder)
        writer.__enter__()
        writer.write(next(frames(1)))
        return lambda: act(writer)

    return prepare


def of_scene(act: Callable[[object], object]) -> Callable[[Path, Path], Callable[[], object]]:
    """Something that is read from a scene that is to be drawn."""

    def prepare(dog: Path, folder: Path) -> Callable[[], object]:
        scene = read_stage(dog)
        return lambda: act(scene)

    return prepare


ENTRIES: dict[str, Callable[[Path, Path], Callable[[], object]]] = {
    "describe": lambda dog, folder: sculpture,
    "write": lambda dog, folder: lambda: write_stage(sculpture(), frames(2), folder),
    "writer": lambda dog, folder: lambda: StageWriter(sculpture(), folder).__enter__(),
    "writer.write": of_writer(lambda writer: writer.write(list(frames(2))[1]) or True),
    "writer.finish": of_writer(lambda writer: writer.finish()),
    "writer.exit": of_writer(lambda writer: writer.__exit__(None, None, None) or True),
    "check": lambda dog, folder: lambda: balloon_usd.check_file(str(dog), nvidia=False),
    "compare": lambda dog, folder: lambda: balloon_usd.compare_files(dog, dog),
    "differences": on_stage(lambda stage: [*differences(stage, stage)] == []),
    "draw": lambda dog, folder: (
        lambda: balloon_usd.draw_contact_sheet(
            dog, folder / "dog.png", frames=[1], size=(48, 32), device="cpu"
        )
    ),
    "draw both": lambda dog, folder: (
        lambda: (
            draw_comparison(balloon_usd.compare_files(dog, dog), html=folder / "dog.html", device="cpu")
            or True
        )
    ),
    "export": lambda dog, folder: lambda: balloon_usd.export_stage(dog, folder, "obj"),
    "scene": lambda dog, folder: lambda: read_stage(dog),
    "scene.points": of_scene(lambda scene: scene.points(1.0)),  # type: ignore[attr-defined]
    "scene.doing": of_scene(lambda scene: scene.doing(1.0)),  # type: ignore[attr-defined]
    "scene.particles": of_scene(lambda scene: scene.particles(1.0)),  # type: ignore[attr-defined]
    "scene.colors": of_scene(lambda scene: scene.vertex_colors(1.0)),  # type: ignore[attr-defined]
    "property": on_stage(lambda stage: check_property(1, stage) == []),
    "properties": on_stage(lambda stage: check_stage(stage) == []),
    "selections": on_stage(lambda stage: [*check_selections(stage)]),
    "variants": on_stage(lambda stage: check_variants(stage) == []),
}
"""Everything that a thread may do with stages, by a name."""


@pytest.mark.parametrize("name", ENTRIES)
def test_one_thread_at_a_time_is_in_openusd(name: str, dog: Path, tmp_path: Path) -> None:
    act = ENTRIES[name](dog, tmp_path)
    with usd_access():
        thread, done = begin(act)
        thread.join(SOON)
        assert done == []
        assert thread.is_alive()
    thread.join(LATE)
    (result,) = done
    assert result


def test_a_thread_that_waits_for_a_frame_keeps_no_other_out(dog: Path, tmp_path: Path) -> None:
    ready: Queue[Frame | None] = Queue()
    thread, done = begin(lambda: write_stage(sculpture(), iter(ready.get, None), tmp_path))
    for frame in frames(3):
        assert balloon_usd.compare_files(dog, dog).same
        ready.put(frame)
    assert thread.is_alive()
    other, compared = begin(lambda: balloon_usd.compare_files(dog, dog).same)
    other.join(LATE)
    assert compared == [True]
    ready.put(None)
    thread.join(LATE)
    assert [written.frames for written in done] == [3]  # type: ignore[attr-defined]


def test_frames_may_come_from_a_thread_that_reads_stages(dog: Path, tmp_path: Path) -> None:
    """A writer that kept others out while it waits would wait for ever."""

    def moving() -> Iterator[Frame]:
        for frame in frames(3):
            thread, read = begin(lambda: read_stage(dog).start)
            thread.join(LATE)
            assert read == [1.0]
            yield frame

    assert write_stage(sculpture(), moving(), tmp_path).frames == 3


def test_stages_of_many_threads_are_as_those_of_one(dog: Path, tmp_path: Path) -> None:
    started = [
        begin(lambda number=number: write_stage(sculpture(), frames(2), tmp_path / str(number), flat=True))  # type: ignore[misc]
        for number in range(8)
    ]
    for thread, _ in started:
        thread.join(LATE)
    assert {(tmp_path / str(number) / "dog.usdc").read_bytes() for number in range(8)} == {dog.read_bytes()}


def test_no_module_imports_pxr_by_itself() -> None:
    """The package `openusd` alone can do that while another thread does the same."""
    package = Path(balloon_usd.__file__).parent
    found = {
        str(file.relative_to(package))
        for file in package.rglob("*.py")
        for line in file.read_text(encoding="utf-8").splitlines()
        if line.split()[:1] in (["from"], ["import"]) and line.split()[1].split(".")[0] == "pxr"
    }
    assert found == {"openusd/__init__.py", "openusd/first_calls.py"}
