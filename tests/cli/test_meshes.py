"""Recipes with mesh files on the command line."""

from __future__ import annotations

import os

from tests.mesh_file.shapes import cube, write_obj

RECIPE = (
    "format: 1\nname: box\nunits: cm\nballoons:\n  box: {mesh: box.obj, swell: 1.3}\nsteps:\n  - wait: 0.2\n"
)
SHORT = "physics: {hold: 0.1, substeps: 20}\n"


def refused(result):
    """The one line with which a command ended as bad input, without a traceback."""
    assert result.exit_code == 2, result.output
    assert isinstance(result.exception, SystemExit)
    (line,) = result.stderr.strip().splitlines()
    return line


def test_a_mesh_beside_its_recipe_is_blown_up(cli, write_recipe, left):
    recipe = write_recipe(file="recipes/box.yaml", text=RECIPE + SHORT)
    write_obj(recipe.with_name("box.obj"), 5.0 * cube()[0], cube()[1])
    result = cli("run", recipe, "-o", "out", "--no-preview")
    assert result.exit_code == 0, result.output
    assert "box/box.usda" in left()
    assert "box.report.json" in left()


def test_a_mesh_that_is_missing_ends_in_one_line_with_its_place(cli, write_recipe, left, tmp_path):
    line = refused(cli("run", write_recipe(file="box.yaml", text=RECIPE), "-o", "out"))
    assert line.endswith(
        f"box.yaml:5:15: balloons.box.mesh: {tmp_path}/box.obj: cannot be read (No such file or directory)"
    )
    assert left() == []


def test_a_mesh_that_is_a_pipe_is_not_waited_for(cli, write_recipe, left, tmp_path):
    os.mkfifo(tmp_path / "box.obj")
    line = refused(cli("plan", write_recipe(file="box.yaml", text=RECIPE)))
    assert line.endswith("is no file but a folder, a pipe or a device, expected a mesh file")


def test_a_mesh_with_a_hole_ends_in_one_line_with_its_remedy(cli, write_recipe, tmp_path):
    points, faces = cube()
    write_obj(tmp_path / "box.obj", 5.0 * points, faces[1:])
    line = refused(cli("plan", write_recipe(file="box.yaml", text=RECIPE)))
    assert "box.obj: not closed: 4 edges have one face only" in line
    assert line.endswith("fill its holes")
