"""`balloon-usd blender-extension`, and the progress that the extension reads."""

import ast
import subprocess
import sys
import tomllib
import zipfile
from pathlib import Path

import balloon_usd


def test_the_extension_is_one_file_with_a_manifest_and_its_licence(cli, left):
    done = cli("blender-extension", "-o", "out")
    assert done.exit_code == 0
    [name] = left()
    assert done.output.splitlines()[0] == f"extension out/{name}"
    with zipfile.ZipFile(f"out/{name}") as archive:
        manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
        assert "GNU GENERAL PUBLIC LICENSE" in archive.read("LICENSE").decode()
        for file in set(archive.namelist()) - {"LICENSE"}:
            assert b"SPDX-License-Identifier: GPL-3.0-or-later" in archive.read(file), file
    assert name == f"balloon_usd-{manifest['version']}.zip"
    assert manifest["version"] == balloon_usd.__version__
    assert manifest["license"] == ["SPDX:GPL-3.0-or-later"]
    assert [*manifest["permissions"]] == ["files"]


def test_two_archives_have_the_same_bytes(cli, left, tmp_path):
    for folder in ("out", "again"):
        assert cli("blender-extension", "-o", folder).exit_code == 0
    [name] = left()
    assert (tmp_path / "out" / name).read_bytes() == (tmp_path / "again" / name).read_bytes()


def test_the_command_that_is_told_runs_this_package(cli):
    told = cli("blender-extension").output.splitlines()[1].removeprefix("command ")
    done = subprocess.run([*told.split(), "--version"], capture_output=True, text=True, check=True)
    assert told.startswith(sys.executable)
    assert balloon_usd.__version__ in done.stdout


def test_a_folder_in_the_way_of_the_archive_is_told(cli, left, tmp_path):
    name = f"balloon_usd-{balloon_usd.__version__}.zip"
    (tmp_path / "out" / name).mkdir(parents=True)
    done = cli("blender-extension", "-o", "out")
    assert (done.exit_code, done.output) == (2, f"out/{name}: a folder is in the way\n")
    assert left() == []


def test_progress_in_lines_begins_with_the_first_frame_and_ends_with_the_last(cli, solver, write_recipe):
    done = cli("run", write_recipe(), "-o", "out", "--no-preview", "--no-report", "--progress", "lines")
    assert done.exit_code == 0
    lines = [line for line in done.stderr.splitlines() if line.startswith("progress ")]
    # Frames after the first one travel together.
    assert lines == ["progress 0/6 getting ready", "progress 1/6 pinch: nose", "progress 6/6 pinch: nose"]


def imported_by(file):
    """Names of the modules that a file imports from outside its folder, and from within it."""
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield "." * node.level + (node.module or "")


def test_the_extension_and_the_package_share_no_code():
    package = Path(balloon_usd.__file__).parent
    extension = sorted((package / "blender").glob("*.py"))
    others = [file for file in package.rglob("*.py") if file not in extension]
    assert extension
    assert others
    for file in extension:
        assert not [n for n in imported_by(file) if n.startswith(("balloon_usd", ".."))], file
    for file in others:
        assert not [n for n in imported_by(file) if n.startswith("balloon_usd.blender")], file
