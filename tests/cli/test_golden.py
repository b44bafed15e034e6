"""`balloon-usd golden`, as a user types it; a solver without physics stands in."""

from __future__ import annotations

import pytest

LIST = """\
format: 1
stages:
  snake:
    recipe: ../snake.yaml
    {more}
"""


@pytest.fixture
def solver(solver, monkeypatch):
    monkeypatch.setattr("balloon_usd.solver.performance.simulate_many", solver)
    return solver


@pytest.fixture
def kept(cli, solver, write_recipe, tmp_path):
    """The golden stage of a snake, with a list beside it; returns a function that writes the list."""
    recipe = write_recipe()
    result = cli("golden", "update", recipe)
    assert (result.exit_code, result.stdout) == (0, "snake: written\n"), result.output

    def write_list(more="rms: 0"):
        (tmp_path / "stages" / "golden.yaml").write_text(LIST.format(more=more))

    write_list()
    return write_list


def lift(solver, by):
    """Let the solver give everything so much higher (m)."""
    import numpy as np  # noqa: PLC0415

    def lifted(plans, detail="draft", device="cpu"):
        simulation = solver(plans, detail=detail, device=device)
        frame = simulation._frame

        def one(world, code):
            found = frame(world, code)
            for points in found.points:
                points[:, 2] += np.float32(by)
            return found

        simulation._frame = one
        return simulation

    return lifted


def contents(folder):
    return {str(p.relative_to(folder)): p.read_bytes() for p in sorted(folder.rglob("*")) if p.is_file()}


def test_what_is_as_it_was_is_verified(cli, kept, tmp_path):
    before = contents(tmp_path / "stages")
    result = cli("golden", "verify")
    assert (result.exit_code, result.stdout) == (0, "snake: the same\n"), result.output
    assert cli("golden", "verify", "snake.yaml", "--stages", "stages").exit_code == 0
    assert contents(tmp_path / "stages") == before


def test_what_differs_is_told_and_kept_on_demand(cli, kept, solver, tmp_path, monkeypatch):
    monkeypatch.setattr("balloon_usd.solver.performance.simulate_many", lift(solver, 0.002))
    before = contents(tmp_path / "stages")
    result = cli("golden", "verify")
    assert result.exit_code == 1
    assert result.stdout.startswith("snake: different\n")
    assert "main moved 2 mm at 1 (largest, vertex " in result.stdout
    assert contents(tmp_path / "stages") == before
    result = cli("golden", "update")
    assert (result.exit_code, result.stdout.splitlines()[0]) == (0, "snake: written")
    assert "main moved 2 mm at 1 (largest, vertex " in result.stdout
    assert cli("golden", "verify").exit_code == 0
    assert sorted(path.name for path in (tmp_path / "stages").iterdir()) == ["golden.yaml", "snake"]


def test_what_is_the_same_is_not_written_unless_all_are(cli, kept, tmp_path):
    payload = tmp_path / "stages" / "snake" / "payload"
    before = payload.stat().st_ino
    assert cli("golden", "update").stdout == "snake: kept, it is the same\n"
    assert payload.stat().st_ino == before
    assert cli("golden", "update", "--all").stdout == "snake: written\n  no difference\n"
    assert payload.stat().st_ino != before


@pytest.mark.parametrize(
    ("more", "options"),
    [
        ("tolerances: {points: 3e-3, extent: 3e-3, extentsHint: 3e-3}", ()),
        ("abs: 3e-3", ()),
        ("rms: 1", ("--abs", "3e-3")),
        ("tolerances: {points: 3e-3}", ("--tol", "extent=3e-3", "--tol", "extentsHint=3e-3")),
    ],
)
def test_tolerances_of_the_list_and_of_the_command_add_up(cli, kept, solver, monkeypatch, more, options):
    monkeypatch.setattr("balloon_usd.solver.performance.simulate_many", lift(solver, 0.002))
    kept(more)
    result = cli("golden", "verify", *options)
    assert result.exit_code == 0, result.output


def test_the_first_frames_alone_can_be_held(cli, solver, write_recipe, tmp_path):
    recipe = write_recipe()
    assert cli("golden", "update", recipe, "--frames", "2").exit_code == 0
    (tmp_path / "stages" / "golden.yaml").write_text(LIST.format(more="frames: 2"))
    assert cli("golden", "verify").exit_code == 0
    result = cli("golden", "verify", "--frames", "3")
    assert result.exit_code == 1
    assert "endTimeCode: 2 and 3" in result.stdout


def test_a_failed_simulation_has_its_own_exit_code_and_leaves_the_stage(cli, kept, solver, tmp_path):
    before = contents(tmp_path / "stages")
    solver.trouble = {"snake": ("pinch: nose", 0.1, "the wall is torn", 3)}
    for command in ("verify", "update"):
        result = cli("golden", command)
        assert result.exit_code == 3
        (line,) = result.stderr.strip().splitlines()
        assert "snake.yaml: simulation failed at 0.10 s (frame 3), pinch: nose: the wall is torn" in line
        assert contents(tmp_path / "stages") == before


def test_a_golden_stage_that_is_missing_or_not_whole_is_told(cli, kept, tmp_path):
    samples = tmp_path / "stages" / "snake" / "payload" / "draft_sim.usdc"
    samples.write_bytes(samples.read_bytes()[:100])
    result = cli("golden", "verify")
    assert result.exit_code == 2
    (line,) = result.stderr.strip().splitlines()
    assert "stages/snake/snake.usda is not whole" in line
    assert cli("golden", "update").stdout == "snake: written\n"
    assert cli("golden", "verify").exit_code == 0
    (tmp_path / "stages" / "snake" / "snake.usda").unlink()
    result = cli("golden", "verify")
    assert result.exit_code == 2
    assert "snake.usda is not a file" in result.stderr


def test_a_full_disk_leaves_the_earlier_stage(cli, kept, solver, tmp_path, monkeypatch):
    monkeypatch.setattr("balloon_usd.solver.performance.simulate_many", lift(solver, 0.002))
    before = contents(tmp_path / "stages")

    def full(self, beside=()):
        from balloon_usd.stage import StageError  # noqa: PLC0415

        raise StageError(f"{self.final} could not be written: No space left on device")

    monkeypatch.setattr("balloon_usd.stage.workspace.Workspace.publish", full)
    result = cli("golden", "update")
    assert result.exit_code == 1
    assert "could not be written: No space left on device" in result.stderr
    assert contents(tmp_path / "stages") == before
    assert sorted(path.name for path in (tmp_path / "stages").iterdir()) == ["golden.yaml", "snake"]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "golden.yaml:1:1: nothing stands here, expected format: 1 and stages"),
        ("format: 2\nstages: {}\n", "golden.yaml:1:9: format: expected format: 1"),
        ("format: 1\nstages: 3\n", "golden.yaml:2:9: stages: expected key: value"),
        (
            "format: 1\nstages: {a: {recpie: x}}\n",
            'stages.a.recpie: unknown key "recpie", did you mean "recipe"?',
        ),
        ("format: 1\nstages: {a: {recipe: x, frames: 0}}\n", "stages.a.frames: 0 is no number of frames"),
        ("format: 1\nstages: {a: {recipe: x, rms: -1}}\n", 'stages.a.rms: "-1" is no tolerance'),
        (
            "format: 1\nstages: {a: {recipe: x, tolerances: {points: much}}}\n",
            'stages.a.tolerances.points: "much" is no tolerance',
        ),
        ("format: 1\nstages: [", "golden.yaml:3:1: not valid YAML"),
        ("format: 1\nstages: {a: {recipe: none.yaml}}\n", "none.yaml:1:1: cannot be read"),
        ("format: 1\nstages: {a: {recipe: ../snake.yaml}}\n", 'snake.yaml is not called "a"'),
        ("format: 1\nstages: {}\n", "golden.yaml lists no stages: name the recipes"),
    ],
)
def test_a_wrong_list_is_refused_with_its_place(cli, solver, write_recipe, tmp_path, text, said):
    write_recipe()
    (tmp_path / "stages").mkdir()
    (tmp_path / "stages" / "golden.yaml").write_text(text)
    result = cli("golden", "verify")
    assert result.exit_code == 2, result.output
    assert isinstance(result.exception, SystemExit)
    assert said in result.stderr
    assert solver.calls == []


def test_a_tolerance_for_nothing_is_refused(cli, kept):
    result = cli("golden", "verify", "--tol", "pionts=1")
    assert result.exit_code == 2
    assert 'unknown attribute "pionts", did you mean "points"?' in result.stderr


def test_a_stage_that_is_new_is_entered_into_the_list(cli, solver, write_recipe, tmp_path):
    recipe, entries = write_recipe(), tmp_path / "stages" / "golden.yaml"
    assert cli("golden", "update", recipe, "--frames", 3).exit_code == 0
    assert entries.read_text() == "format: 1\nstages:\n  snake:\n    recipe: ../snake.yaml\n    frames: 3\n"
    assert cli("golden", "verify").stdout == "snake: the same\n"
    entries.write_text(f"# Mine.\n{entries.read_text()}".replace("snake", "other"))
    (tmp_path / "other.yaml").write_text("")
    assert cli("golden", "update", recipe).stderr == ""
    assert entries.read_text().startswith("# Mine.\nformat: 1\nstages:\n  other:\n")
    assert entries.read_text().endswith("  snake:\n    recipe: ../snake.yaml\n")


def test_a_list_of_another_form_is_left_alone_and_that_is_said(cli, solver, write_recipe, tmp_path):
    recipe, entries = write_recipe(), tmp_path / "stages" / "golden.yaml"
    entries.parent.mkdir()
    entries.write_text(text := "{format: 1, stages: {other: {recipe: ../other.yaml}}}\n")
    result = cli("golden", "update", recipe)
    assert (result.exit_code, result.stderr) == (
        0,
        "stages/golden.yaml: enter snake by hand, below the others\n",
    )
    assert entries.read_text() == text


def test_without_a_list_recipes_are_to_be_named(cli, tmp_path):
    result = cli("golden", "verify")
    assert (result.exit_code, result.stderr) == (2, "stages/golden.yaml is not there: name the recipes\n")
