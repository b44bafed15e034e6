"""Stages with flipped bits and without their ends, through every command: one line, exit code 2, nothing left.

A flip may also do no harm, or show as a fault.
"""

from __future__ import annotations

import json
import random
import shutil

import pytest
from pxr import Sdf

from balloon_usd.cli import child_memory
from balloon_usd.stage import write_stage
from tests.stage.tubes import frames, sculpture

FLIPS = {
    "usdz": (1538, 1106, 1114, 1083, 1000, 1007, 1034, 1087, 1200),
    "usdc": (1194, 1484, 1480, 1624, 1014, 1071, 1094, 1440, 1602),
    "usda": range(1000, 1008),
}
"""Seeds by kind of file; the first usdz and usdc are some that crash OpenUSD, that claim gigabytes, and that hold
values of a wrong type or size."""
ENDS = (0.02, 0.5, 0.97)
"""Shares at which files are cut off."""
EACH = [
    ("usdz", 1114),
    ("usdc", 1194),
    *(pytest.param(*one, marks=pytest.mark.long) for one in (("usdz", 1106), ("usdz", 1538), ("usdc", 1484))),
]
"""Those that every command opens."""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The dog as a package, as a binary file and as text, by kind. Only to be read."""
    folder = tmp_path_factory.mktemp("whole")
    write_stage(sculpture(), frames(3), folder)
    write_stage(sculpture(), frames(3), folder, flat=True)
    write_stage(sculpture(), frames(3), folder, usdz=True)
    Sdf.Layer.FindOrOpen(str(folder / "dog.usdc")).Export(str(folder / "dog.usda"))
    return {kind: folder / f"dog.{kind}" for kind in FLIPS}


@pytest.fixture
def flipped(whole, tmp_path):
    """Write a stage of a kind with some flipped bits, by seed."""

    def write(kind, seed):
        chance = random.Random(f"{kind}{seed}")
        data = bytearray(whole[kind].read_bytes())
        for _ in range(chance.choice([1, 1, 2, 5])):
            place = chance.randrange(len(data))
            data[place] ^= 1 << chance.randrange(8)
        file = tmp_path / f"{kind}{seed}.{kind}"
        file.write_bytes(data)
        return file

    return write


@pytest.fixture
def temporary(tmp_path_factory, monkeypatch):
    """The folder for temporary files; children have less memory, so that they fill it sooner."""
    folder = tmp_path_factory.mktemp("temporary")
    monkeypatch.setenv("TMPDIR", str(folder))
    monkeypatch.setattr(child_memory, "LEAST", 512 << 20)
    return folder


def told(result, files, fine=(0, 1)):
    """The lines on the error stream: one that begins with a file for a damaged one, else none."""
    assert result.exit_code in (*fine, 2), result.output
    assert result.exception is None or isinstance(result.exception, SystemExit)
    lines = result.stderr.splitlines()
    assert (result.exit_code == 2) == bool(lines), result.output
    assert all(any(line.startswith(f"{file}") for file in files) for line in lines), result.stderr
    return lines


def test_all_of_many_damaged_stages_are_checked(cli, whole, flipped, temporary, capfd, tmp_path):
    files = [flipped(kind, seed) for kind, seeds in FLIPS.items() for seed in seeds]
    for kind, file in whole.items():
        data = file.read_bytes()
        for share in ENDS:
            files.append(tmp_path / f"end{share}.{kind}")
            files[-1].write_bytes(data[: int(share * len(data))])
    names = [file.name for file in files]
    result = cli("check", "--no-nvidia", *names, whole["usdc"])
    assert result.exit_code == 2
    lines = told(result, names)
    heads = [line for line in result.stdout.splitlines() if not line.startswith(" ")]
    assert len({line.split(":")[0] for line in [*lines, *heads]}) == len(lines) + len(heads) == len(files) + 1
    assert heads[-1].startswith(f"{whole['usdc']}: fine")
    assert sum(": damaged: " in line for line in lines) >= 4
    assert len(lines) >= 15
    assert sorted(tmp_path.iterdir()) == sorted(files)
    assert [*temporary.iterdir()] == []
    assert capfd.readouterr() == ("", "")


def test_json_tells_a_damaged_stage_beside_a_sound_one(cli, whole, flipped, temporary):
    file = flipped("usdz", 1538)
    result = cli("check", "--no-nvidia", "--json", file, whole["usdz"])
    assert (result.exit_code, result.stderr) == (2, "")
    damaged, sound = json.loads(result.stdout)["stages"]
    assert (damaged["result"], sound["result"]) == ("unreadable", "fine")
    assert damaged["unreadable"].startswith(f"{file}: damaged: ")
    assert damaged["stage"] == str(file)


@pytest.mark.parametrize(("kind", "seed"), EACH)
def test_every_command_tells_a_damaged_stage_in_a_line(
    kind, seed, cli, whole, flipped, temporary, capfd, tmp_path
):
    file = flipped(kind, seed)
    stages = (whole[kind], file.name) if seed % 2 else (file.name, whole[kind])
    told(cli("diff", "--variants", *stages), [file.name])
    size = ("--size", 48, 32, "--device", "cpu")
    drawn = cli("preview", file.name, "--frames", "1,3", *size, "-o", "sheet.png")
    told(drawn, [file.name, "/dog"], fine=(0,))
    exported = cli("export", file.name, "--format", "ply", "-o", "out")
    told(exported, [file.name, "/dog"], fine=(0,))
    assert (tmp_path / "sheet.png").exists() == (drawn.exit_code == 0)
    assert (tmp_path / "out").exists() == (exported.exit_code == 0)
    expected = {file, *([tmp_path / "sheet.png"] * (not drawn.exit_code))}
    assert {path for path in tmp_path.iterdir() if path.name != "out"} == expected
    assert [*temporary.iterdir()] == []
    assert capfd.readouterr() == ("", "")


def test_a_damaged_golden_stage_is_told_and_the_others_are_looked_at(
    cli, solver, write_recipe, whole, flipped, temporary, monkeypatch, tmp_path
):
    monkeypatch.setattr("balloon_usd.solver.performance.simulate_many", solver)
    recipes = write_recipe("one"), write_recipe("two")
    assert cli("golden", "update", *recipes).exit_code == 0
    shutil.rmtree(tmp_path / "stages" / "one")
    (tmp_path / "stages" / "one").mkdir()
    flipped("usdc", 1484).rename(tmp_path / "stages" / "one" / "one.usdc")
    (tmp_path / "stages" / "one" / "one.usda").write_text("#usda 1.0\n(\n    subLayers = [@./one.usdc@]\n)\n")
    before = sorted(tmp_path.rglob("*"))
    result = cli("golden", "verify", *recipes)
    assert (result.exit_code, result.stdout) == (2, "two: the same\n")
    (line,) = result.stderr.splitlines()
    assert line.startswith(f"{recipes[0]}: stages/one: damaged: ")
    assert sorted(tmp_path.rglob("*")) == before
    assert cli("golden", "update", *recipes).stdout == "one: written\ntwo: kept, it is the same\n"
    assert [*temporary.iterdir()] == []
