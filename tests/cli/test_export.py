"""The command `balloon-usd export`, as a user types it."""

from __future__ import annotations

import pytest

from balloon_usd.stage import write_stage
from tests.stage.tubes import frames, sculpture


@pytest.fixture
def dog(tmp_path):
    return write_stage(sculpture(), frames(4), tmp_path).files[0]


def refused(result, code=2):
    """The one line with which a command ended as documented, without a traceback."""
    assert result.exit_code == code, result.output
    assert result.exception is None or isinstance(result.exception, SystemExit)
    (line,) = result.stderr.strip().splitlines()
    return line


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (("--format", "obj"), [f"dog.{n:04d}.obj" for n in (1, 2, 3, 4)]),
        (("--format", "ply", "--frames", "2:3"), ["dog.0002.ply", "dog.0003.ply"]),
        (("--format", "vtu", "--frames", "1,4"), ["dog.0001.vtu", "dog.0004.vtu", "dog.pvd"]),
        (("--format", "xdmf", "--frames", "3:"), ["dog.h5", "dog.xdmf"]),
    ],
)
def test_a_folder_of_a_stage_is_exported_where_it_was_asked_for(words, expected, cli, dog, left):
    result = cli("export", "dog", "-o", "out", *words)
    assert result.exit_code == 0, result.output
    assert left() == expected


def test_it_says_which_file_to_open(cli, dog):
    assert cli("export", "dog", "--format", "vtu", "-o", "out").output == "vtu out/dog.pvd and 4 more\n"
    one = cli("export", "dog/dog.usda", "--format", "obj", "--frames", "4", "-o", "out")
    assert one.output == "obj out/dog.0004.obj\n"


def test_the_stage_is_not_touched(cli, dog, tmp_path):
    before = {file: file.read_bytes() for file in tmp_path.rglob("*") if file.is_file()}
    assert cli("export", "dog", "--format", "xdmf", "-o", "out").exit_code == 0
    assert {file: file.read_bytes() for file in before} == before


@pytest.mark.parametrize(
    ("stage", "frames", "line"),
    [
        ("", "1", '"" is no stage, expected a USD file or a folder'),
        ("no.usda", "1", "no.usda is not a file"),
        ("note.usda", "1", "note.usda is not a USD file"),
        ("dog", "9", "dog/dog.usda has frames 1 to 4 only"),
        ("dog", "7:9", "dog/dog.usda has frames 1 to 4 only"),
    ],
)
def test_bad_input_ends_in_one_line(stage, frames, line, cli, dog, tmp_path):
    (tmp_path / "note.usda").write_text("#usda but not really")
    assert refused(cli("export", stage, "--format", "obj", "--frames", frames, "-o", "out")) == line


def test_a_format_that_is_not_known_is_refused_with_those_that_are(cli, dog):
    result = cli("export", "dog", "--format", "stl")
    assert result.exit_code == 2
    assert "'stl' is not one of 'obj', 'ply', 'vtu', 'xdmf'" in result.output


@pytest.mark.parametrize(("form", "name"), [("obj", "meshio"), ("xdmf", "h5py")])
def test_a_missing_library_is_named_with_its_remedy(form, name, cli, dog, tmp_path, monkeypatch, left):
    # First on the path of every process: as if it were not there.
    (tmp_path / f"{name}.py").write_text("raise ModuleNotFoundError")
    monkeypatch.syspath_prepend(tmp_path)
    line = refused(cli("export", "dog", "--format", form, "-o", "out"))
    assert line == f"{name} is not installed: pip install 'balloon-usd[mesh]'"
    assert left() == []


def test_a_folder_that_is_a_file_is_refused(cli, dog, tmp_path):
    (tmp_path / "out").write_text("")
    assert refused(cli("export", "dog", "--format", "obj", "-o", "out")).startswith("out: cannot write here")


def test_a_folder_in_the_way_of_a_file_ends_with_code_1(cli, dog, tmp_path):
    (tmp_path / "out" / "dog.xdmf").mkdir(parents=True)
    line = refused(cli("export", "dog", "--format", "xdmf", "-o", "out"), code=1)
    assert line == "out/dog.xdmf could not be written: a folder is in the way"
