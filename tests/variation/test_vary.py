from __future__ import annotations

import errno
import hashlib
import os
import tempfile
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from balloon_usd import Recipe, VariationError, plan_recipe, vary_recipe
from balloon_usd.language.yaml_reader import read_yaml
from balloon_usd.variation import VariationNotWrittenError

ROOT = Path(__file__).parents[2]
DOG = ROOT / "recipes" / "dog.yaml"
HEART = ROOT / "recipes" / "meshes" / "heart.yaml"
TAIL = "balloons.main.tail"
COLOR = "balloons.main.color"


def contents(folder):
    return {file.name: file.read_bytes() for file in folder.iterdir()}


def refused(*arguments, **options):
    """The lines with which a call ends."""
    with pytest.raises(VariationError) as raised:
        vary_recipe(*arguments, **options)
    return str(raised.value).splitlines()


SETTINGS = st.fixed_dictionaries(
    {},
    optional={
        TAIL: st.sampled_from(["8..18/5", "10,90", '"4 in",12', "9..16", "12"]),
        COLOR: st.sampled_from(["red,blue", "[1,0,0],[0,1,0]", "#ff0000,redd"]),
        "steps.0.bubbles.nose": st.sampled_from(["8..12", "5,50"]),
        "physics.friction": st.sampled_from(["0.2..0.9", "0.5,9"]),
        "physics.softening": st.just("true,false"),
    },
).filter(bool)


@settings(max_examples=12, deadline=None)
@given(SETTINGS, st.integers(1, 6), st.integers(0, 99))
def test_every_recipe_that_is_written_can_be_run_and_has_what_was_set(settings_, draws, seed):
    with tempfile.TemporaryDirectory() as folder:
        try:
            made = vary_recipe(DOG, settings_, folder, draws=draws, seed=seed)
        except VariationError:
            assert list(Path(folder).iterdir()) == []
            return
        assert len(made.written) + len(made.left_out) == draws
        plans = [plan_recipe(Recipe.load(file)) for file in sorted(Path(folder).iterdir())]
        assert [plan.recipe.name for plan in plans] == [variation.name for variation in made.written]
        assert len({plan.recipe.name.lower() for plan in plans}) == len(plans)
        for variation in made.written:
            assert variation.file == Path(folder, f"{variation.name}.yaml")
            head = [line for line in variation.file.read_text().splitlines() if line.startswith("# ")]
            facts = read_yaml("\n".join(line[2:] for line in head), "").data
            assert facts == {
                "variation of": "dog.yaml",
                "sha256": hashlib.sha256(DOG.read_bytes()).hexdigest(),
                **variation.values,
            }


def test_a_sweep_has_every_combination_in_order_and_nothing_else_differs(tmp_path):
    made = vary_recipe(DOG, {COLOR: "red,light_blue", TAIL: "8..12/2"}, tmp_path)
    names = [f"dog_{color}_{tail}" for color in ("red", "light_blue") for tail in (8, 10, 12)]
    assert [variation.name for variation in made.written] == names
    text = (tmp_path / "dog_light_blue_12.yaml").read_text()
    body = DOG.read_text().replace("name: dog", "name: dog_light_blue_12")
    assert text.endswith(body.replace("color: red, tail: 10", "color: light_blue, tail: 12"))
    assert str(ROOT) not in text


def test_equal_seeds_give_equal_bytes_and_others_give_others(tmp_path):
    for folder, seed in (("a", 7), ("b", 7), ("c", 8), ("d", None), ("e", 0)):
        vary_recipe(DOG, {TAIL: "9..15", COLOR: "red,blue"}, tmp_path / folder, draws=5, seed=seed)
    found = {folder.name: contents(folder) for folder in tmp_path.iterdir()}
    assert found["a"] == found["b"] != found["c"]
    assert found["d"] == found["e"]
    assert len(found["a"]) == 5


def test_what_a_seed_draws_is_kept_for_ever(tmp_path):
    made = vary_recipe(DOG, {COLOR: "red,green,blue", TAIL: "9..15"}, tmp_path, draws=3, seed=7)
    assert [tuple(variation.values.values()) for variation in made.written] == [
        ("red", 9.905),
        ("green", 9.434),
        ("green", 11.194),
    ]


def test_a_crowd_larger_than_its_values_repeats_them_as_little_as_it_can(tmp_path):
    made = vary_recipe(DOG, {COLOR: "red,green,blue"}, tmp_path, draws=7)
    colors = [variation.values[COLOR] for variation in made.written]
    assert sorted(map(colors.count, set(colors))) == [2, 2, 3]


def test_values_of_python_are_taken_as_they_are(tmp_path):
    made = vary_recipe(DOG, {COLOR: [(1, 0, 0), "blue"], "title": ["8..14/2"]}, tmp_path)
    assert [variation.name for variation in made.written] == ["dog_1_0_0", "dog_blue"]
    assert Recipe.load(made.written[0].file).title == "8..14/2"


def test_what_cannot_be_made_is_left_out_and_said(tmp_path):
    made = vary_recipe(DOG, {TAIL: [10, 60, 90], "physics.friction": [0.5]}, tmp_path)
    assert list(contents(tmp_path)) == ["dog_10.yaml"]
    assert [left.values[TAIL] for left in made.left_out] == [60, 90]
    assert made.left_out[0].problem.path == TAIL
    assert made.left_out[0].problem.text.startswith("a tail of 60 cm leaves nothing of a 260")


def test_where_nothing_can_be_made_nothing_is_written(tmp_path):
    lines = refused(DOG, {TAIL: "60,90", COLOR: "red,reed"}, tmp_path / "new" / "folder")
    assert lines[0] == f"{DOG}: none of 4 variations can be made, nothing is written"
    assert lines[1].startswith(
        "2 left out, such as dog_60_red (balloons.main.tail 60, balloons.main.color red): "
    )
    assert lines[2].endswith(
        'balloons.main.color: unknown color "reed", did you mean "red"? ("#rrggbb" and [r, g, b] work too)'
    )
    assert list(tmp_path.iterdir()) == []


def test_a_variation_can_be_varied_and_tells_its_whole_descent(tmp_path):
    vary_recipe(DOG, {TAIL: "9"}, tmp_path)
    (made,) = vary_recipe(tmp_path / "dog_9.yaml", {COLOR: "blue"}, tmp_path / "again").written
    lines = made.file.read_text().splitlines()
    assert lines[0] == "# variation of: dog_9.yaml"
    assert lines[3] == "# variation of: dog.yaml"
    assert made.name == "dog_9_blue"


@pytest.mark.parametrize("folder", ["recipes/sweep", "elsewhere/sweep", "recipes", "link"])
def test_mesh_files_are_found_from_the_new_folder(folder, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name in ("recipes", "recipes/meshes", "elsewhere", "far", "far/away"):
        (tmp_path / name).mkdir()
    (tmp_path / "link").symlink_to("far/away")
    for name in ("heart.obj", "heart 2.obj"):
        (tmp_path / "recipes" / "meshes" / name).write_bytes(HEART.with_name("heart.obj").read_bytes())
    text = HEART.read_text().replace("mesh: heart.obj", "mesh: meshes/heart.obj")
    (tmp_path / "recipes" / "heart.yaml").write_text(text)
    made = vary_recipe("recipes/heart.yaml", {"balloons.heart.swell": "1.1"}, folder)
    made_of_others = vary_recipe(
        "recipes/heart.yaml", {"balloons.heart.mesh": "meshes/heart 2.obj", "fps": "30"}, folder
    )
    for variation in (*made.written, *made_of_others.written):
        assert plan_recipe(Recipe.load(variation.file)).strips["heart"].shape is not None
        assert str(tmp_path) not in variation.file.read_text()
    assert len(made.written) == len(made_of_others.written) == 1


def test_an_absolute_mesh_file_stays_where_it_is(tmp_path):
    heart = tmp_path / "heart.yaml"
    heart.write_text(HEART.read_text().replace("heart.obj", str(HEART.with_name("heart.obj"))))
    (made,) = vary_recipe(heart, {"balloons.heart.swell": "1.1"}, tmp_path / "out").written
    assert Recipe.load(made.file).balloons["heart"].mesh == str(HEART.with_name("heart.obj"))


def test_a_balloon_that_is_set_as_a_whole_brings_its_mesh(tmp_path):
    heart = HEART.with_name("heart.yaml")
    (made,) = vary_recipe(heart, {"balloons.heart": [{"mesh": "heart.obj", "swell": 1.3}]}, tmp_path).written
    assert plan_recipe(Recipe.load(made.file)).strips["heart"].shape.swell == 1.3


def test_files_that_are_there_and_differ_are_not_touched_unless_that_is_wished(tmp_path):
    vary_recipe(DOG, {TAIL: "8,9,10"}, tmp_path)
    before = contents(tmp_path)
    vary_recipe(DOG, {TAIL: "8,9,10"}, tmp_path)
    assert contents(tmp_path) == before
    (tmp_path / "dog_8.yaml").write_text("mine")
    (tmp_path / "dog_10.yaml").write_text("mine, too")
    lines = refused(DOG, {TAIL: "8,9,10,11"}, tmp_path)
    assert lines == [
        f"{tmp_path / name}: is there already and differs, expected another folder, or --force to replace it"
        for name in ("dog_8.yaml", "dog_10.yaml")
    ]
    assert sorted(contents(tmp_path)) == ["dog_10.yaml", "dog_8.yaml", "dog_9.yaml"]
    vary_recipe(DOG, {TAIL: "8,9,10"}, tmp_path, overwrite=True)
    assert contents(tmp_path) == before


def test_what_is_no_file_is_never_replaced(tmp_path):
    (tmp_path / "dog_8.yaml").mkdir()
    os.mkfifo(tmp_path / "dog_9.yaml")
    (tmp_path / "dog_10.yaml").symlink_to("nowhere")
    lines = refused(DOG, {TAIL: "8,9,10"}, tmp_path, overwrite=True)
    assert [line.partition(": ")[2] for line in lines] == ["something that is no file is in the way"] * 3


def test_the_recipe_itself_is_never_replaced(tmp_path):
    recipe = tmp_path / "dog_8.yaml"
    recipe.write_bytes(DOG.read_bytes())
    assert refused(recipe, {TAIL: "8,9"}, tmp_path, overwrite=True) == [
        f"{recipe}: is the recipe that is varied, expected another folder"
    ]
    assert contents(tmp_path) == {"dog_8.yaml": DOG.read_bytes()}


@pytest.mark.parametrize("moment", ["write_bytes", "replace"])
def test_a_full_disk_leaves_nothing(moment, tmp_path, monkeypatch):
    def full(self, *_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(f"pathlib.Path.{moment}", full)
    with pytest.raises(VariationNotWrittenError, match="cannot be written: No space left on device"):
        vary_recipe(DOG, {TAIL: "8,9"}, tmp_path / "new")
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_sweep_leaves_nothing(tmp_path):
    def interrupt(done, total):
        assert (done, total) == (1, 2)
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        vary_recipe(DOG, {TAIL: "8,9"}, tmp_path / "new", progress=interrupt)
    assert list(tmp_path.iterdir()) == []


def test_a_folder_that_cannot_be_made_is_told(tmp_path):
    (line,) = refused(DOG, {TAIL: "8,9"}, "/proc/none/of/this")
    assert line.startswith("/proc/none/of/this: cannot write here (")
    (line,) = refused(DOG, {TAIL: "8,9"}, tmp_path / ("x" * 300))
    assert line.endswith(": cannot write here (File name too long)")
    (line,) = refused(DOG, {TAIL: "8,9"}, tmp_path / "a\0b")
    assert "cannot write here (" in line
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("settings_", "options", "said"),
    [
        ({}, {}, "nothing is varied, expected a path and its values, such as balloons.main.tail=8..14/2"),
        ({TAIL: "8..14"}, {}, f"{TAIL}: 8..14 is a continuous range, from which only --random N draws; expected a step, such as 8..14/1"),
        ({TAIL: "8,9"}, {"seed": 1}, "a seed chooses among random variations, expected their number, too: --random N"),
        ({TAIL: "8,9"}, {"draws": 5, "seed": -1}, "-1 is no seed, expected 0 or more"),
        ({TAIL: "8,9"}, {"draws": 0}, "0 variations cannot be drawn, expected 1 to 100000"),
        ({TAIL: "8,9"}, {"draws": 10**30}, "1.00e+30 variations cannot be drawn, expected 1 to 100000"),
        ({TAIL: "1..9e4/1", "fps": "1..9e4/1"}, {}, "8100000000 variations are too many, expected at most 100000: fewer values, or --random N"),
        ([(TAIL, "8"), (TAIL, "9")], {}, f"{TAIL} is set twice, expected all its values in one list"),
        ({"steps.0": "1", "steps[0].turns": "2"}, {}, "steps[0].turns is set, and all of steps[0] is, too: expected one of them"),
        ({"": "1"}, {}, '"": no path, expected keys such as balloons.main.tail or steps[0].bubbles.nose'),
    ],
)  # fmt: skip
def test_a_wrong_wish_is_told_in_one_line(settings_, options, said, tmp_path):
    assert refused(DOG, settings_, tmp_path / "new", **options) == [said]
    assert list(tmp_path.iterdir()) == []


def test_all_problems_are_told_at_once(tmp_path):
    (tmp_path / "file").write_text("")
    lines = refused(DOG, {"balloons.man.tail": "8..", "fps": "24..30"}, tmp_path / "file" / "new", seed=3)
    assert lines == [
        'balloons.man.tail: "8.." is no range, expected one alone, such as 8..14/2',
        'balloons.man.tail: unknown balloon "man", did you mean "main"?',
        "a seed chooses among random variations, expected their number, too: --random N",
        "fps: 24..30 is a continuous range, from which only --random N draws; expected a step, such as 24..30/1",
        f"{tmp_path / 'file'}: a file is in the way of the folder",
    ]


def test_a_recipe_that_cannot_be_read_is_told_beside_wrong_values(tmp_path):
    bad = tmp_path / "bad.yaml"
    bad.write_text("format: 1\nname: bad\nsteps: []\n")
    lines = refused(bad, {TAIL: ""}, tmp_path / "new")
    assert [line.split(": ")[0] for line in lines] == [f"{bad}:1:1", f"{bad}:3:1", TAIL]
    assert refused(tmp_path, {TAIL: "8"}, tmp_path / "new")[0].endswith("is a folder, expected a recipe file")


def test_values_that_change_what_is_made_are_left_to_the_reader(tmp_path):
    bubbles = [{"nose": 9}, {"nose": 9, "left_ear": 8, "right_ear": 8}]
    made = vary_recipe(DOG, {"steps.0.bubbles": bubbles}, tmp_path)
    assert [variation.name for variation in made.written] == ["dog_2"]
    assert made.left_out[0].problem.text == 'unknown bubble "left_ear", expected nose'


def test_odd_words_stand_in_the_provenance_without_harm(tmp_path):
    recipe = tmp_path / "do\ng\udc80 #.yaml"
    recipe.write_bytes(DOG.read_bytes())
    (made,) = vary_recipe(recipe, {"title": ["a\nb: # \u202e"]}, tmp_path / "new").written
    lines = made.file.read_text(encoding="utf-8").splitlines()
    assert lines[0] == '# variation of: "do\\U0000000Ag\\U0000DC80 #.yaml"'
    assert lines[2] == '# title: "a\\U0000000Ab: # \\U0000202E"'
    assert Recipe.load(made.file).title == "a\nb: # \u202e"


def test_a_recipe_with_an_older_word_is_varied_by_the_new_one_and_keeps_its_text(tmp_path):
    recipe = tmp_path / "old.yaml"
    recipe.write_text(
        "format: 1\nname: old\nunits: cm\nballoons: {main: {size: 260, tail: 10}}\n"
        "steps:\n  - bubbles: {a: 10}\n  - push: {bubble: a, depth: 1}  # gently\n"
    )
    made = vary_recipe(recipe, {"steps.1.press.depth": "1,2"}, tmp_path / "out")
    assert [Recipe.load(each.file).steps[1].press.depth for each in made.written] == [0.01, 0.02]
    assert "  - push: {bubble: a, depth: 2}  # gently\n" in made.written[1].file.read_text()
    assert [str(notice)[-41:] for notice in made.notices] == [
        "7:5: push is called press now: press: {...}"[-41:]
    ]


def test_a_named_value_is_varied_wherever_formulas_use_it(tmp_path):
    file = tmp_path / "pair.yaml"
    file.write_text(
        "format: 1\nname: pair\nunits: cm\nlet: {ear: 3}  # both\nballoons: {main: {size: 260, tail: 10}}\n"
        "steps:\n- repeat: {k: 2}\n  steps: [{bubbles: {b_<k>: = 2 * ear}}, {ear: {e_<k>: = ear}}]\n"
    )
    made = vary_recipe(file, {"let.ear": [2.5, 4]}, tmp_path / "made")
    lengths = [list(Recipe.load(each.file).steps[2].lengths.values()) for each in made.written]
    assert lengths == [pytest.approx([0.05]), pytest.approx([0.08])]
    assert "let: {ear: 4}  # both" in made.written[1].file.read_text()
    assert refused(file, {"let.era": [1]}, tmp_path / "other") == [
        'let.era: unknown key "era", did you mean "ear"?'
    ]


def test_numbers_of_draws_are_whole_and_values_may_be_an_array(tmp_path):
    with pytest.raises(
        VariationError, match=r"1.5 variations with seed None cannot be drawn, expected whole"
    ):
        vary_recipe(DOG, {TAIL: "9..15"}, tmp_path, draws=1.5)
    assert len(vary_recipe(DOG, {TAIL: np.linspace(10.0, 12.0, 3)}, tmp_path / "a").written) == 3
    assert len(vary_recipe(DOG, {TAIL: "9..15"}, tmp_path / "b", draws=np.int64(2)).written) == 2
