"""The extension, installed into Blender: recipes arrive as figures, and mistakes with their place."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from importlib.util import find_spec
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from pxr import Usd

from balloon_usd.cli import main
from balloon_usd.stage import write_stage
from tests.stage.capsule import Capsule
from tests.stage.tubes import frames, sculpture

SOURCE = Path(__file__).parents[2] / "balloon_usd" / "blender"
COMMAND = f"{sys.executable} -m balloon_usd"
RECIPE = """\
format: 1
name: bud
units: cm
fps: 12.5
balloons:
  main: {size: 260, color: green, length: 6, tail: 2}
steps:
  - bubbles: {head: 5}
  - rest: stem
must_hold: planned
physics: {hold: 0.5}
"""


@pytest.fixture
def recipe(tmp_path):
    file = tmp_path / "bud.yaml"
    file.write_text(RECIPE)
    return file


@pytest.fixture(scope="session")
def archive(tmp_path_factory):
    folder = tmp_path_factory.mktemp("archive")
    done = CliRunner().invoke(main, ["blender-extension", "-o", str(folder)])
    return Path(done.output.splitlines()[0].removeprefix("extension "))


@pytest.fixture(scope="session")
def installed(blender, archive):
    """Blender with the extension."""
    assert blender("session:install", archive)
    return blender


@pytest.fixture
def program(tmp_path):
    """Write a program that stands in for balloon-usd; the command that runs it."""

    def write(text):
        file = tmp_path / "program.py"
        file.write_text(text)
        return f"{sys.executable} {file}"

    return write


def own_tool(*words):
    """Run Blender's own tool for extensions."""
    [home] = find_spec("bpy").submodule_search_locations
    [tool] = Path(home).glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py")
    subprocess.run([sys.executable, str(tool), *map(str, words)], check=True, capture_output=True)


def test_blenders_own_tool_finds_the_extension_valid(archive):
    own_tool("validate", SOURCE)
    own_tool("validate", archive)


def test_blenders_own_tool_builds_the_same_files(archive, tmp_path):
    built = tmp_path / archive.name
    own_tool("build", "--source-dir", SOURCE, "--output-dir", tmp_path)
    ours, theirs = ({n: z.read(n) for n in z.namelist()} for z in map(zipfile.ZipFile, (archive, built)))
    assert ours == theirs


def test_the_extension_stands_in_the_import_menu(installed):
    installed("session:begin", "")
    assert "bl_ext.user_default.balloon_usd" in installed("session:menu_entries")
    assert installed("session:default_command") == "balloon-usd"


def test_a_recipe_arrives_as_a_moving_figure(installed, recipe, tmp_path):
    seen = installed("session:import_recipes", COMMAND, recipe, folder=str(tmp_path / "stages"))
    stage = Usd.Stage.Open(str(tmp_path / "stages" / "bud" / "bud.usda"))
    points = stage.GetAttributeAtPath("/bud/geo/render/main.points")
    assert seen["range"] == (1, stage.GetEndTimeCode())
    assert seen["rate"] == pytest.approx(12.5)
    assert [*seen["things"]] == ["main"]
    main = seen["things"]["main"]
    assert np.array_equal(main.points, points.Get(stage.GetEndTimeCode()))
    assert not np.array_equal(main.points, points.Get(1))
    assert (main.levels, main.smooth, main.homes) == ([(1, 2)], True, ["Bud"])


def test_importing_an_edited_recipe_again_replaces_the_figure_where_it_stands(installed, recipe):
    edited = RECIPE.replace("color: green", "color: red").replace("head: 5", "head: 4.5")
    before, after = installed("session:import_edited", COMMAND, recipe, edited)
    assert [*after["things"]] == ["main"]
    assert after["files"] == ["bud.usda"]
    old, new = before["things"]["main"], after["things"]["main"]
    assert (new.homes, new.height) == (["Bud"], 0.5)
    assert (before["materials"], after["materials"]) == (["latex_green"], ["latex_red"])
    written = Usd.Stage.Open(str(recipe.with_name("bud") / "bud.usda"))
    assert np.array_equal(new.points, written.GetAttributeAtPath("/bud/geo/render/main.points").Get())
    assert new.points.shape != old.points.shape


def test_what_was_imported_by_hand_from_the_same_stage_follows(installed, tmp_path):
    first = write_stage(sculpture(), frames(4), tmp_path).files[0]
    changed = write_stage(sculpture(), frames(9, first=3), tmp_path / "changed").files[0]
    written = Usd.Stage.Open(str(changed))
    expected = np.array(written.GetAttributeAtPath("/dog/geo/render/main.points").Get(11))
    seen = installed("session:bring_in_again", first, changed)
    assert sorted(seen["things"]) == ["main", "main.001", "second", "second.001"]
    assert seen["range"] == (3, 11)
    for name in ("main", "main.001"):
        assert np.array_equal(seen["things"][name].points, expected), name


def test_air_arrives_in_its_colours(installed, tmp_path):
    air = Capsule()
    seen = installed("session:bring_in", write_stage(air.describe(), air.frames(4), tmp_path).files[0])
    assert seen["things"]["main_air"].colors == ["displayColor"]


def test_a_mistake_is_told_with_its_place_and_the_recipe_opens_there(installed, recipe):
    recipe.write_text(RECIPE.replace("rest: stem", "lock: [head, hed]"))
    seen = installed("session:import_recipes", COMMAND, recipe)
    assert 'bud.yaml:9:5: steps[1].lock: unknown bubble "hed", did you mean "head"?' in seen["error"]
    assert seen["cursor"] == {"bud.yaml": (9, 5)}
    assert seen["objects"] == 0
    assert [file.name for file in recipe.parent.iterdir()] == ["bud.yaml"]


def test_an_open_text_editor_shows_the_place(installed, recipe):
    recipe.write_text(RECIPE.replace("rest: stem", "lock: [head, hed]"))
    assert installed("session:mistake_beside_text_editor", COMMAND, recipe) == ("bud.yaml", 4)


def test_a_recipe_that_was_edited_elsewhere_is_shown_as_it_is(installed, recipe):
    wrong = RECIPE.replace("rest: stem", "lock: [head, hed]")
    edited = "# A bud.\n" + RECIPE.replace("color: green", "color: gren")
    assert installed("session:mistakes", COMMAND, recipe, wrong, edited) == (edited, 7)


def test_what_was_typed_into_a_recipe_in_blender_stays(installed, recipe):
    wrong = RECIPE.replace("rest: stem", "lock: [head, hed]")
    shown, _ = installed("session:mistakes", COMMAND, recipe, wrong, typed="# Mine.\n")
    assert shown == "# Mine.\n" + wrong
    twice = installed("session:mistakes", COMMAND, recipe, wrong, wrong, typed="# Mine.\n")
    assert twice[0] == "# Mine.\n# Mine.\n" + wrong


def test_a_missing_command_is_told_with_what_to_do(installed, recipe):
    seen = installed("session:import_recipes", "balloon-usdd", recipe)
    assert 'The command "balloon-usdd" is not found' in seen["error"]
    assert "Preferences > Add-ons > Balloon recipes > Command" in seen["error"]


@pytest.mark.parametrize("command", ["", '"balloon-usd'])
def test_a_command_of_no_words_or_half_a_quote_is_told(installed, recipe, command):
    assert f'The command "{command}" is not' in installed("session:import_recipes", command, recipe)["error"]


def test_a_missing_recipe_is_told(installed, tmp_path):
    seen = installed("session:import_recipes", COMMAND, tmp_path / "none.yaml")
    assert "none.yaml: no such file" in seen["error"]


def test_what_a_failing_command_says_is_told(installed, recipe, program):
    command = program("import sys\nsys.exit('bud.yaml: simulation failed in step 2')")
    assert (
        "bud.yaml: simulation failed in step 2"
        in installed("session:import_recipes", command, recipe)["error"]
    )


def test_a_command_that_says_nothing_and_writes_no_stage_is_told(installed, recipe, program):
    seen = installed("session:import_recipes", program("raise SystemExit(5)"), recipe)
    assert "the command ended with 5 and wrote no stage" in seen["error"]


def test_a_stage_that_blender_cannot_read_is_told(installed, recipe, program, tmp_path):
    (tmp_path / "bud.usda").write_text("framesPerSecond = 24")
    command = program(f"print('stage {tmp_path / 'bud.usda'}')")
    assert "bud.usda" in installed("session:import_recipes", command, recipe)["error"]


def test_the_command_does_not_see_blenders_python(installed, recipe, program, tmp_path):
    command = program(
        "import os, sys\nfrom pathlib import Path\n"
        f"Path(r'{tmp_path}', 'seen').write_text(' '.join(sorted(os.environ)))\n"
        "sys.exit(' '.join(sys.argv[1:]))"
    )
    foreign = dict.fromkeys(("PYTHONPATH", "PYTHONHOME", "LD_LIBRARY_PATH"), "/nowhere")
    told = installed("session:import_among", foreign, command, recipe, detail="preview", look="clay")["error"]
    words = (
        f"--progress lines --no-preview --no-report --detail preview -o {tmp_path} --look clay -- bud.yaml"
    )
    assert f"run {words}" in told
    seen = (tmp_path / "seen").read_text().split()
    assert not {*foreign} & {*seen}
    assert "PATH" in seen


def test_the_menu_asks_for_a_file_and_a_dropped_file_only_how_it_is_made(installed):
    assert installed("session:invoke", dropped=False) == ["a file browser"]
    assert installed("session:invoke", dropped=True) == ["bud.yaml"]
    expected = ("import_scene.balloon_recipe", ".yaml;.yml", [True, False, False])
    assert installed("session:takes_drops") == expected


def test_a_window_waits_for_the_figure(installed, recipe, tmp_path):
    seen = installed("session:watch_to_the_end", COMMAND, recipe, tmp_path / "begun")
    assert seen["outcome"] == {"FINISHED"}
    done, total, doing = seen["progress"]
    assert (done, doing) == (total, "comes undone: head.end")
    assert seen["reports"][-1] == ({"INFO"}, f"bud: {total} frames, 12.5 frames/s")
    assert any(kind == {"WARNING"} and "caution" in text for kind, text in seen["reports"])
    assert seen["timers"] == 0


def test_a_window_shows_the_progress(installed, recipe, program, tmp_path):
    command = program(
        "import sys, time\nfrom pathlib import Path\n"
        "print('progress 3/12 inflate: main', file=sys.stderr, flush=True)\n"
        f"while not Path(r'{tmp_path}', 'begun').exists(): time.sleep(0.01)\n"
    )
    seen = installed("session:watch_to_the_end", command, recipe, tmp_path / "begun")
    assert "bud.yaml: 25%, inflate: main (Esc stops it)" in seen["shown"]
    assert (seen["outcome"], seen["timers"]) == ({"CANCELLED"}, 0)


def test_escape_stops_the_command_and_what_it_has_started(installed, recipe, program, tmp_path):
    command = program(
        "import os, subprocess, sys, time\nfrom pathlib import Path\n"
        "other = subprocess.Popen([sys.executable, '-c', 'import time; time.sleep(60)'])\n"
        f"Path(r'{tmp_path}', 'pids').write_text(f'{{os.getpid()}} {{other.pid}}\\n')\n"
        "time.sleep(60)"
    )
    seen = installed("session:press_escape", command, recipe, tmp_path / "pids")
    assert seen["outcome"] == {"CANCELLED"}
    assert seen["alive"] == []
    assert seen["reports"] == [({"INFO"}, "Stopped, nothing is imported")]
    assert (seen["timers"], seen["objects"]) == (0, 0)


def test_escape_kills_a_command_that_does_not_listen(installed, recipe, program, tmp_path):
    command = program(
        "import os, signal, time\nfrom pathlib import Path\n"
        "signal.signal(signal.SIGINT, signal.SIG_IGN)\n"
        f"Path(r'{tmp_path}', 'pids').write_text(f'{{os.getpid()}}\\n')\n"
        "time.sleep(60)"
    )
    assert installed("session:press_escape", command, recipe, tmp_path / "pids")["alive"] == []


def test_stages_go_beside_the_blend_or_the_recipe_or_where_the_user_says(installed, tmp_path):
    places = installed("session:folders", tmp_path / "recipes" / "bud.yaml", tmp_path / "scene.blend")
    assert places == [str(tmp_path / "recipes"), str(tmp_path), str(tmp_path / "stages")]
