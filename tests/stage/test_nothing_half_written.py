from __future__ import annotations

import errno
import os
import random
import shutil
import signal
import tempfile
import time
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import pytest
from pxr import Usd

from balloon_usd.stage import StageError, StageWriter, write_stage
from balloon_usd.stage.properties import check_stage, whole_or_absent
from tests.stage.capsule import Capsule
from tests.stage.tubes import Frame, frames, sculpture

if TYPE_CHECKING:
    import subprocess
    from pathlib import Path

Child = Callable[..., "subprocess.Popen[str]"]

FORMS: list[dict[str, bool]] = [{}, {"shot": True}, {"flat": True}, {"usdz": True}]

SLOW_RUN = """
def slowly():
    for frame in frames(int(os.environ.get("COUNT", "40"))):
        print(frame.time_code, flush=True)
        time.sleep(0.005)
        yield frame
write_stage(sculpture(), slowly(), os.environ["OUT"], flat="FLAT" in os.environ, usdz="USDZ" in os.environ)
print("done", flush=True)
"""


def bytes_of(folder: Path) -> dict[str, bytes]:
    return {str(f.relative_to(folder)): f.read_bytes() for f in folder.rglob("*") if f.is_file()}


def hidden(folder: Path) -> list[Path]:
    return list(folder.glob(".*"))


def frames_then(error: BaseException) -> Iterator[Frame]:
    yield from frames(3)
    raise error


@pytest.mark.parametrize("form", FORMS, ids=str)
@pytest.mark.parametrize("error", [KeyboardInterrupt(), RuntimeError("burst at step 3"), GeneratorExit()])
def test_what_stops_the_frames_passes_through_and_leaves_nothing(
    error: BaseException, form: dict[str, bool], tmp_path: Path
) -> None:
    with pytest.raises(type(error)):
        write_stage(sculpture(), frames_then(error), tmp_path, **form)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("form", [*FORMS, {"flat": True, "shot": True}], ids=str)
def test_a_failed_simulation_gives_a_whole_stage_of_another_name_and_the_earlier_one_stays(
    form: dict[str, bool], tmp_path: Path
) -> None:
    write_stage(sculpture(), frames(4), tmp_path, **form)
    before = bytes_of(tmp_path)
    with StageWriter(sculpture(), tmp_path, detail="full", **form) as writer:
        for frame in frames(2):
            writer.write(frame)
        written = writer.finish("at 0.1 s: torn")
    after = bytes_of(tmp_path)
    made = {name for name in after if name.startswith("dog.failed")}
    assert {name: content for name, content in after.items() if name not in made} == before
    assert {str(file.relative_to(tmp_path)) for file in written.files} == made
    assert not any("draft" in name for name in made), "no other detail is taken over"
    for file in {written.files[0], *tmp_path.glob("dog.failed_shot.usda")}:
        stage = Usd.Stage.Open(str(file))
        assert check_stage(stage) == []
        assert (stage.GetStartTimeCode(), stage.GetEndTimeCode()) == (1, 2)
    facts = Usd.Stage.Open(str(written.files[0])).GetRootLayer().customLayerData["balloon_usd"]
    assert (facts["failed"], facts["last_good_frame"]) == ("at 0.1 s: torn", 2)


def test_a_failed_stage_with_air_brings_its_texture(tmp_path: Path) -> None:
    thing = Capsule()
    with StageWriter(thing.describe(), tmp_path, flat=True) as writer:
        for frame in thing.frames(2):
            writer.write(frame)
        writer.finish("at 0.1 s: torn")
    assert sorted(bytes_of(tmp_path)) == ["capsule.failed.usdc", "wire.png"]
    assert check_stage(Usd.Stage.Open(str(tmp_path / "capsule.failed.usdc"))) == []


@pytest.mark.parametrize("form", FORMS, ids=str)
def test_what_stood_under_the_name_stays_when_a_run_fails(form: dict[str, bool], tmp_path: Path) -> None:
    write_stage(sculpture(), frames(4), tmp_path, **form)
    before = bytes_of(tmp_path)
    with pytest.raises(KeyboardInterrupt):
        write_stage(sculpture(fps=30.0), frames_then(KeyboardInterrupt()), tmp_path, **form)
    assert bytes_of(tmp_path) == before


@pytest.mark.parametrize("seed", range(4))
def test_a_kill_at_a_random_moment_leaves_nothing_under_the_name(
    seed: int, tmp_path: Path, child: Child
) -> None:
    form = [{}, {"FLAT": "1"}, {"USDZ": "1"}, {}][seed]
    process = child(SLOW_RUN, OUT=str(tmp_path), COUNT="10000", **form)
    assert process.stdout is not None
    process.stdout.readline()
    time.sleep(random.Random(seed).uniform(0.0, 0.3))
    process.send_signal(signal.SIGKILL)
    process.communicate()
    assert [path.name[:5] for path in tmp_path.iterdir()] == [".dog."]
    assert list(whole_or_absent(tmp_path, "dog")) == []
    write_stage(sculpture(), frames(3), tmp_path, **{name.lower(): True for name in form})
    assert hidden(tmp_path) == []


@pytest.mark.parametrize("flat", [False, True])
def test_a_kill_while_replacing_leaves_the_earlier_stage_whole(
    flat: bool, tmp_path: Path, child: Child
) -> None:
    write_stage(sculpture(), frames(4), tmp_path, flat=flat)
    before = bytes_of(tmp_path)
    code = "Path.replace = lambda *_: os.kill(os.getpid(), signal.SIGKILL)\n" + SLOW_RUN
    process = child(code, OUT=str(tmp_path), **({"FLAT": "1"} if flat else {}))
    process.communicate()
    assert process.returncode == -signal.SIGKILL
    assert list(whole_or_absent(tmp_path, "dog")) == []
    with pytest.raises(RuntimeError, match="no more"):
        write_stage(sculpture(), frames_then(RuntimeError("no more")), tmp_path)
    assert bytes_of(tmp_path) == before


def test_a_full_disk_while_packing_leaves_the_earlier_package(tmp_path: Path, child: Child) -> None:
    """The layer in the package fits below the limit, the package does not."""
    write_stage(sculpture(), frames(4), tmp_path, usdz=True)
    before = bytes_of(tmp_path)
    size = write_stage(sculpture(), frames(40), tmp_path / "apart", usdz=True).files[0].stat().st_size
    shutil.rmtree(tmp_path / "apart")
    code = f"""
resource.setrlimit(resource.RLIMIT_FSIZE, ({size - 10}, {size - 10}))
try:
    write_stage(sculpture(), frames(40), os.environ["OUT"], usdz=True)
except StageError as error:
    print(error)
"""
    output, errors = child(code, OUT=str(tmp_path)).communicate()
    assert output.startswith(f"{tmp_path / 'dog.usdz'} could not be written: "), errors
    assert (output.count("\n"), errors) == (1, "")
    assert bytes_of(tmp_path) == before


def test_a_kill_while_replacing_a_flat_stage_with_air_leaves_the_earlier_one_whole(
    tmp_path: Path, child: Child
) -> None:
    write_stage(Capsule().describe(), Capsule().frames(4), tmp_path, flat=True)
    before = bytes_of(tmp_path)
    code = """
def die(source, target):
    os.replace(source, target)
    os.kill(os.getpid(), signal.SIGKILL)
Path.replace = die
write_stage(Capsule().describe(), Capsule().frames(9), os.environ["OUT"], flat=True)
"""
    process = child(code, OUT=str(tmp_path))
    process.communicate()
    assert process.returncode == -signal.SIGKILL
    assert list(whole_or_absent(tmp_path, "capsule")) == []
    assert {name: content for name, content in bytes_of(tmp_path).items() if name in before} == before


def test_control_c_leaves_nothing(tmp_path: Path, child: Child) -> None:
    process = child(SLOW_RUN, OUT=str(tmp_path), COUNT="10000")
    assert process.stdout is not None
    process.stdout.readline()
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate()
    assert errors.strip().endswith("KeyboardInterrupt")
    assert list(tmp_path.iterdir()) == []


def test_a_living_run_is_not_swept(tmp_path: Path, child: Child) -> None:
    process = child(SLOW_RUN, OUT=str(tmp_path))
    assert process.stdout is not None
    process.stdout.readline()
    write_stage(sculpture(), frames(2), tmp_path)
    rest, errors = process.communicate()
    assert "done" in rest, errors
    assert hidden(tmp_path) == []
    assert list(whole_or_absent(tmp_path, "dog")) == []


def test_only_the_leftovers_of_the_same_name_are_swept(tmp_path: Path) -> None:
    names = [".dog.abcd1234.writing", ".doggy.abcd1234.writing", ".dog.keep", ".dog.mine.writing"]
    for name in names:
        (tmp_path / name).mkdir()
    write_stage(sculpture(), frames(2), tmp_path)
    assert sorted(path.name for path in hidden(tmp_path)) == sorted(names[1:])


@pytest.mark.parametrize(
    ("form", "name"), [("shot=True", "dog"), ("flat=True", "dog.usdc"), ("usdz=True", "dog.usdz")]
)
@pytest.mark.parametrize("limit", [600, 20_000, 60_000])
def test_a_full_disk_ends_in_one_clear_line(
    limit: int, form: str, name: str, tmp_path: Path, child: Child
) -> None:
    code = f"""
resource.setrlimit(resource.RLIMIT_FSIZE, ({limit}, {limit}))
try:
    write_stage(sculpture(), frames(40), os.environ["OUT"], {form})
except StageError as error:
    print(error)
"""
    output, errors = child(code, OUT=str(tmp_path)).communicate()
    assert (output, errors) == (f"{tmp_path / name} could not be written: File too large\n", "")
    assert list(tmp_path.iterdir()) == []


def test_a_disk_that_fills_while_frames_stream_ends_in_one_clear_line(tmp_path: Path, child: Child) -> None:
    code = """
import balloon_usd.stage.samples as samples
samples.SAVE_BYTES = 20_000
resource.setrlimit(resource.RLIMIT_FSIZE, (60_000, 60_000))
def counted():
    for frame in frames(40):
        print(frame.time_code)
        yield frame
try:
    write_stage(sculpture(), counted(), os.environ["OUT"])
except StageError as error:
    print(error)
"""
    output, errors = child(code, OUT=str(tmp_path)).communicate()
    *codes, line = output.splitlines()
    assert line == f"{tmp_path / 'dog'} could not be written: File too large", errors
    assert 5 < len(codes) < 40
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_written_is_told_before_the_first_frame(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(**_: object) -> str:
        raise PermissionError(errno.EACCES, os.strerror(errno.EACCES))

    monkeypatch.setattr(tempfile, "mkdtemp", refuse)
    unasked = frames(3)
    with pytest.raises(StageError) as caught:
        write_stage(sculpture(), unasked, tmp_path)
    assert str(caught.value) == f"{tmp_path / 'dog'} could not be written: Permission denied"
    assert next(unasked).time_code == 1


def test_an_output_folder_that_is_a_file_is_refused(tmp_path: Path) -> None:
    (tmp_path / "out").write_text("a file")
    with pytest.raises(StageError, match="could not be written: "):
        write_stage(sculpture(), frames(3), tmp_path / "out")


@pytest.mark.parametrize(
    ("form", "name"),
    [
        ({}, "dog"),
        ({"flat": True}, "dog.usdc"),
        ({"usdz": True}, "dog.usdz"),
        ({"shot": True}, "dog_shot.usda"),
    ],
)
def test_what_is_in_the_way_is_told_and_kept(form: dict[str, bool], name: str, tmp_path: Path) -> None:
    if name == "dog":
        (tmp_path / name).write_text("a file")
    else:
        (tmp_path / name).mkdir()
    with pytest.raises(StageError, match=r"a (file|folder) is in the way"):
        write_stage(sculpture(), frames(3), tmp_path, **form)
    assert len(list(tmp_path.iterdir())) == 1


def test_stages_can_grow_side_by_side(tmp_path: Path) -> None:
    with (
        StageWriter(sculpture(name="one"), tmp_path) as one,
        StageWriter(sculpture(name="two"), tmp_path, flat=True) as two,
        StageWriter(sculpture(name="three"), tmp_path) as three,
    ):
        for frame in frames(4):
            for writer in (one, two, three):
                writer.write(frame)
        assert one.finish().frames == two.finish().frames == 4
    assert sorted(path.name for path in tmp_path.iterdir()) == ["one", "two.usdc"]
    assert list(whole_or_absent(tmp_path, "one")) == list(whole_or_absent(tmp_path, "two")) == []


def test_a_link_to_a_folder_stays_a_link(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "dog").symlink_to(tmp_path / "elsewhere")
    write_stage(sculpture(), frames(3), tmp_path)
    assert (tmp_path / "dog").is_symlink()
    assert (tmp_path / "elsewhere" / "dog.usda").is_file()
