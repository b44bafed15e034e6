from __future__ import annotations

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

import balloon_usd
from tests import interruptible

ROOT = Path(balloon_usd.__file__).parents[1]


def start(*words, env_extra=None, **options):
    environment = {
        **os.environ,
        "PYTHONPATH": os.pathsep.join([*sys.path[:1], str(ROOT)]),
        **(env_extra or {}),
    }
    return interruptible.start([sys.executable, *map(str, words)], env=environment, **options)


def test_the_module_is_the_command():
    process = start("-m", "balloon_usd", "--version")
    out, _ = process.communicate(timeout=30)
    assert process.returncode == 0
    assert out.strip() == f"balloon-usd, version {balloon_usd.__version__}"


def test_help_loads_nothing_heavy():
    heavy = "warp pxr numpy networkx PIL pydantic rich yaml"
    code = f"import sys, balloon_usd.cli; print([name for name in '{heavy}'.split() if name in sys.modules])"
    out, _ = start("-c", code).communicate(timeout=30)
    assert out.strip() == "[]"


def test_a_wrong_recipe_ends_without_a_traceback(tmp_path):
    (tmp_path / "bad.yaml").write_text("format: 1\nname: bad\nsteps: []\n")
    process = start("-m", "balloon_usd", "run", "bad.yaml", cwd=tmp_path)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 2
    assert out == ""
    assert err.startswith("bad.yaml:")
    assert "Traceback" not in err
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bad.yaml"]


def test_a_missing_device_is_told_in_one_line(write_recipe, tmp_path):
    process = start("-m", "balloon_usd", "run", write_recipe(), "--device", "cuda:99", cwd=tmp_path)
    out, err = process.communicate(timeout=60)
    assert process.returncode == 2
    assert out == ""
    assert len(err.splitlines()) == 1
    assert 'no device "cuda:99", only cpu' in err


@pytest.mark.parametrize(
    ("ending", "code", "word"),
    [
        (signal.SIGINT, 130, "interrupted"),
        (signal.SIGTERM, 143, "terminated"),
        (signal.SIGHUP, 143, "terminated"),
    ],
)
def test_ctrl_c_sigterm_and_a_closed_terminal_have_their_exit_codes_and_leave_nothing(
    solver, write_recipe, tmp_path, ending, code, word
):
    solver.trouble = {"snake": "sleep"}
    process = start("-m", "balloon_usd", "run", write_recipe(), "-o", "out", cwd=tmp_path)
    assert process.stdout.readline().strip() == "asleep"
    process.send_signal(ending)
    _, err = process.communicate(timeout=30)
    assert process.returncode == code
    assert "Traceback" not in err
    assert err.splitlines()[-1] == f"{word}, nothing half-written is left"
    assert list((tmp_path / "out").iterdir()) == []


def test_a_command_that_outlives_its_terminal_heeds_no_hangup(solver, write_recipe, tmp_path):
    solver.trouble = {"snake": "sleep"}
    process = start(
        *("-m", "balloon_usd", "run", write_recipe(), "-o", "out"),
        cwd=tmp_path,
        ignoring=(signal.SIGHUP,),
    )
    assert process.stdout.readline().strip() == "asleep"
    process.send_signal(signal.SIGHUP)
    with pytest.raises(subprocess.TimeoutExpired):
        process.wait(timeout=1.0)
    process.send_signal(signal.SIGTERM)
    process.communicate(timeout=30)
    assert process.returncode == 143


@pytest.mark.parametrize("closed", [">&-", "2>&-", "<&-", "<&- >&- 2>&-"])
@pytest.mark.parametrize("command", ["run snake.yaml -o out --no-preview --no-report", "check stage"])
def test_commands_do_their_work_without_standard_streams(solver, write_recipe, tmp_path, closed, command):
    write_recipe()
    run = f"{sys.executable} -m balloon_usd"
    if "check" in command:
        first = f"{run} run snake.yaml -o made --no-preview --no-report && mv made/snake stage && mv stage/snake.usda stage/stage.usda"
        assert (
            start(*("-c", f"import os; raise SystemExit(os.system('{first}'))"), cwd=tmp_path).wait(120) == 0
        )
    process = start(
        "-c", f"import os; raise SystemExit(os.system('{run} {command} {closed}') >> 8)", cwd=tmp_path
    )
    _, err = process.communicate(timeout=120)
    assert process.returncode == 0, err
    assert "Traceback" not in err
    assert (tmp_path / "stage" / "stage.usda").exists() or (
        tmp_path / "out" / "snake" / "snake.usda"
    ).exists()


@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_what_a_full_disk_does_not_take_is_not_lost_without_a_word(tmp_path, unbuffered):
    code = f"import os; raise SystemExit(os.system('ulimit -f 1; {sys.executable} -m balloon_usd schema > s.json') >> 8)"
    environment = {**os.environ, "PYTHONUNBUFFERED": unbuffered, "PYTHONPATH": str(ROOT)}
    process = interruptible.start([sys.executable, "-c", code], env=environment, cwd=tmp_path)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 2
    assert err == "nothing more can be said: File too large\n"


@pytest.mark.parametrize("words", [["schema"], ["--help"]])
def test_a_closed_pipe_has_its_own_exit_code(words):
    process = start("-m", "balloon_usd", *words, env_extra={"PYTHONUNBUFFERED": "1"})
    process.stdout.close()
    assert process.wait(timeout=60) == 141
    assert process.stderr.read() == ""


def test_a_recipe_is_planned_from_a_folder_that_is_gone(write_recipe, tmp_path):
    recipe, gone = write_recipe(), tmp_path / "gone"
    code = f"import os; os.mkdir('{gone}'); os.chdir('{gone}'); os.rmdir('{gone}')\nfrom balloon_usd.cli import main; main(['plan', '{recipe}'])"
    process = start("-c", code)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 0, err
