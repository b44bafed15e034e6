from __future__ import annotations

import json
import os

import pytest
import yaml
from openjd.model import decode_job_template

from balloon_usd.farm import JobTemplate
from balloon_usd.farm.job_template import MOST_BYTES

BAG = """\
format: 1
name: bag
balloons:
  bag: {mesh: ../meshes/bag.obj, unit: m, color: red}
steps:
  - wait: 1
"""
TETRAHEDRON = "v 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 0 0\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n"


def template(folder, file="job.yaml"):
    """Read a template as a farm does, which refuses what is against the specification."""
    document = yaml.safe_load((folder / file).read_text(encoding="utf-8"))
    decode_job_template(template=document)
    return document


def defaults(document):
    return {each["name"]: each.get("default") for each in document["parameterDefinitions"]}


def chunks(document):
    (step,) = document["steps"]
    (file,) = step["script"]["embeddedFiles"]
    return [json.loads(line) for line in file["data"].splitlines()]


@pytest.fixture
def three(write_recipe):
    return [write_recipe(f"recipes/{name}.yaml") for name in ("cat", "dog", "mouse")]


def test_a_folder_of_recipes_becomes_a_job_with_a_task_a_chunk(cli, folder, three):
    result = cli("farm-template", "recipes", "--chunk", 2, "-o", "job.yaml")
    assert (result.exit_code, result.output) == (0, "job template job.yaml: 2 tasks\n")
    document = template(folder)
    assert document["name"] == "cat and 2 more"
    assert chunks(document) == [["cat.yaml", "dog.yaml"], ["mouse.yaml"]]
    assert defaults(document) == {
        "Recipes": "recipes",
        "Output": "out",
        "Detail": "draft",
        "Command": "balloon-usd",
    }
    (chunk,) = document["steps"][0]["parameterSpace"]["taskParameterDefinitions"]
    assert chunk["range"] == "1-2"
    assert "hostRequirements" not in document["steps"][0]


def test_options_of_run_go_into_the_template_as_they_are_given(cli, folder, three):
    options = ["--flat", "--look", "clay", "--shot", "--frames", "2:9", "--no-preview", "--no-report"]
    result = cli("farm-template", "recipes", "-o", "job.yaml", "--detail", "full", *options)
    assert result.exit_code == 0, result.output
    document = template(folder)
    args = document["steps"][0]["script"]["actions"]["onRun"]["args"]
    given = args[args.index("--") + 1 :]
    assert given[:4] == ["--output", "{{Param.Output}}", "--detail", "{{Param.Detail}}"]
    assert sorted(given[4:]) == sorted(options)
    assert defaults(document)["Detail"] == "full"


@pytest.mark.parametrize(("device", "gpus"), [("cuda", 1), ("cuda:0", 1), ("cuda:1", 2)])
def test_a_job_for_gpus_goes_to_machines_that_have_them(cli, folder, three, device, gpus):
    assert cli("farm-template", "recipes", "-o", "job.yaml", "--device", device).exit_code == 0
    (step,) = template(folder)["steps"]
    assert step["hostRequirements"]["amounts"] == [{"name": "amount.worker.gpu", "min": gpus}]


def test_without_a_file_the_template_is_printed_and_nothing_is_written(cli, folder, three):
    result = cli("farm-template", "recipes")
    assert result.exit_code == 0
    decode_job_template(template=yaml.safe_load(result.stdout))
    assert [path.name for path in folder.iterdir()] == ["recipes"]


def test_json_says_the_same_as_yaml(cli, folder, three):
    for file in ("job.json", "job.yaml"):
        assert cli("farm-template", "recipes", "-o", file).exit_code == 0
    assert json.loads((folder / "job.json").read_text()) == template(folder)


def test_no_path_of_this_machine_is_in_the_template(cli, folder, three):
    for recipes, file in ((["recipes"], "job.yaml"), (three, "farm/job.yaml")):
        (folder / file).parent.mkdir(exist_ok=True)
        assert cli("farm-template", *recipes, "-o", file).exit_code == 0
        assert str(folder) not in (folder / file).read_text()


def test_folders_elsewhere_must_be_given_with_the_job_and_are_told(cli, folder, three):
    (folder / "farm").mkdir()
    result = cli("farm-template", "recipes", "-o", "farm/job.yaml")
    assert result.exit_code == 0
    assert [defaults(template(folder, "farm/job.yaml"))[name] for name in ("Recipes", "Output")] == [
        None,
        None,
    ]
    recipes, out = result.stderr.splitlines()
    assert recipes.startswith(
        f"caution: submit the job with Recipes={folder / 'recipes'}, which has no default"
    )
    assert out.startswith(f"caution: submit the job with Output={folder / 'out'}, which has no default")


def test_the_folder_of_the_recipes_holds_their_meshes_too(cli, folder):
    for file, text in (("recipes/bag.yaml", BAG), ("meshes/bag.obj", TETRAHEDRON)):
        (folder / file).parent.mkdir()
        (folder / file).write_text(text)
    result = cli("farm-template", "recipes", "-o", "job.yaml")
    assert result.exit_code == 0, result.output
    assert defaults(template(folder))["Recipes"] == "."
    assert chunks(template(folder)) == [["recipes/bag.yaml"]]


def test_all_wrong_recipes_are_told_and_nothing_is_written(cli, folder, three):
    for file in three[1:]:
        file.write_text(file.read_text().replace("nose", "9nose"))
    result = cli("farm-template", "recipes", "-o", "job.yaml")
    assert result.exit_code == 2
    assert [line.split(":")[0] for line in result.stderr.splitlines()] == [
        "recipes/dog.yaml",
        "recipes/mouse.yaml",
    ]
    assert not (folder / "job.yaml").exists()


@pytest.mark.parametrize(
    ("words", "problem"),
    [
        (["-o", "job.txt"], "job.txt: expected a file .yaml, .yml, .json"),
        (["-o", "recipes.yaml"], "recipes.yaml: a folder is in the way"),
        (["-o", "nowhere/job.yaml"], "nowhere/job.yaml: cannot be written (No such file or directory)"),
        (["--flat", "--usdz"], "--flat and --usdz: choose one of them"),
        (["--look", "clya"], 'unknown look "clya", did you mean "clay"?'),
    ],
)
def test_what_cannot_be_written_is_told_in_one_line(cli, folder, three, words, problem):
    (folder / "recipes.yaml").mkdir()
    result = cli("farm-template", "recipes", *words)
    (line,) = result.stderr.splitlines()
    assert problem in line
    assert result.exit_code == (1 if "nowhere" in problem else 2)
    assert sorted(path.name for path in folder.iterdir()) == ["recipes", "recipes.yaml"]


def test_recipes_whose_names_are_no_text_are_refused(cli, folder, write_recipe):
    write_recipe(os.fsdecode(b"recipes/\xff.yaml"), name="dog")
    result = cli("farm-template", "recipes", "-o", "job.yaml")
    assert result.exit_code == 2
    assert "the path is not UTF-8, which a job template needs" in result.stderr
    assert not (folder / "job.yaml").exists()


def test_a_hundred_thousand_recipes_become_several_steps_of_files_that_openjd_takes():
    line = json.dumps([f"figure_{number:03}.yaml" for number in range(50)]) + "\n"
    job = JobTemplate("many", line * 2000, "recipes", "out", "draft")
    document = job.document()
    decode_job_template(template=document)
    data = [step["script"]["embeddedFiles"][0]["data"] for step in document["steps"]]
    assert max(len(text.encode()) for text in data) <= MOST_BYTES
    assert "".join(data) == job.chunks
    ranges = [step["parameterSpace"]["taskParameterDefinitions"][0]["range"] for step in document["steps"]]
    assert ranges == [f"1-{text.count(chr(10))}" for text in data]
