"""Settings with which no run can work are refused at their place, with a value that works."""

from __future__ import annotations

import re

import pytest

from balloon_usd.plan import plan
from balloon_usd.plan.settings_kosaka import REACH, USUAL_RATE
from balloon_usd.recipe import Recipe, RecipeError
from balloon_usd.solver.kosaka.parameters import NATURAL, RE, SUBSTEPS
from balloon_usd.solver.simulation import NOMINAL_RATE

TUBE = "format: 1\nname: t\nunits: cm\n{head}balloons: {{main: {{{balloon}}}}}\nsteps: [wait: 1]\nphysics: {{{physics}}}\n"


def messages(physics="", balloon="size: 260, length: 9, tail: 2", head=""):
    try:
        plan(Recipe.parse(TUBE.format(physics=physics, balloon=balloon, head=head), file="t.yaml"))
    except RecipeError as error:
        return str(error).splitlines()
    return []


def constants(entries, more="", balloon="size: 260, capsule: 14"):
    return messages(f"model: kosaka, kosaka: {{{entries}}}{more}", balloon)


LATEX = [
    (
        "mass_scaling: none",
        "physics.mass_scaling: the usual time steps are too long",
        "substeps: 1900 or more",
    ),
    ("mass_scaling: none, substeps: 1000", "physics.substeps: 1000 substeps are too long", "selective"),
]


@pytest.mark.parametrize(("physics", "what", "remedy"), LATEX)
def test_true_masses_need_short_time_steps(physics, what, remedy):
    (line,) = messages(physics)
    assert line.startswith(f"t.yaml:6:{13 + len(physics.rpartition(': ')[0])}: {what}")
    assert remedy in line
    assert messages("mass_scaling: none, substeps: 1900") == []


def test_true_masses_of_a_thin_tube_are_told_the_frame_rate_that_works():
    (line,) = messages("mass_scaling: none", "size: 160, length: 9, tail: 2")
    assert line.endswith("expected mass_scaling: selective, or fps: 45 and substeps: 2000")
    thin = messages("mass_scaling: none, substeps: 2000", "size: 160, length: 9, tail: 2", "fps: 45\n")
    assert thin == []


def test_few_substeps_at_a_low_frame_rate_are_refused():
    (line,) = messages("substeps: 20", head="fps: 8\n")
    assert line.endswith("substeps: 20 at 8 frames/s are too few to follow the hands, expected at least 50")
    assert messages("substeps: 50", head="fps: 8\n") == []


def test_a_wall_as_thick_as_its_tube_is_refused():
    (line,) = messages(balloon="size: 260, length: 9, tail: 2, thickness: 3 mm")
    assert line == (
        "t.yaml:4:61: balloons.main.thickness: a wall of 3 mm is no thin skin round a tube of 4.5 mm radius,"
        " expected at most 1.12 mm"
    )
    assert messages(balloon="size: 260, length: 9, tail: 2, thickness: 1.12 mm") == []


def test_a_tube_narrower_than_its_own_wall_allows_is_refused_by_its_radius():
    (line,) = messages(balloon="size: 646, length: 9, tail: 2, radius: 0.99 mm")
    assert "balloons.main.radius: 0.99 mm is out of range, expected at least 1 mm" in line


def test_too_few_frames_to_blow_up_in_are_refused():
    (line,) = messages(head="fps: 1\n")
    assert line == (
        "t.yaml:4:6: fps: 1 frames/s leave 3 for the 3.0 s in which a balloon is blown up,"
        " expected at least 2 frames/s"
    )
    assert messages(head="fps: 2\n") == []


def test_all_problems_are_told_at_once():
    lines = messages("mass_scaling: none", "size: 260, length: 9, tail: 12, thickness: 3 mm")
    assert [re.sub(r"^t.yaml:\d+:\d+: ", "", line).split(":")[0] for line in lines] == [
        "balloons.main.tail",
        "balloons.main.thickness",
        "physics.mass_scaling",
    ]


@pytest.mark.parametrize(
    ("wrong", "right"),
    [
        ("ks: 8e3", "ks: 6200"),
        ("kd: 60", "kd: 36"),
        ("calming: 50", "calming: 28"),
        ("drag: 1e3", "drag: 140"),
        ("alpha: 0", "alpha: 1"),
        ("beta: 0", "beta: 1"),
        ("push: 0", "push: 1"),
        ("re: 5 mm", "re: 7.9 mm"),
        ("re: 10 cm", "re: 31 mm"),
        ("spacing: 2 cm", "spacing: 9.9 mm"),
        ("spacing: 2 mm", "spacing: 3.2 mm"),
        ("air_offset: 0.1 mm", "air_offset: 1.3 mm"),
        ("air_offset: 5 cm", "air_offset: 25.4 mm"),
        ("leak_offset: 5 cm", "leak_offset: 25.4 mm"),
        ("contact_offset: 5 cm", "contact_offset: 25.4 mm"),
        ("gamma: 5 cm", "gamma: 25.4 mm"),
        ("elongation_limit: 0.5", "elongation_limit: 1.06"),
        ("elongation_limit: 0.5, natural: 0.6", "elongation_limit: 0.72, natural: 0.6"),
    ],
)
def test_a_constant_that_cannot_work_is_refused_with_one_that_does(wrong, right):
    (line,) = constants(wrong)
    key, value = right.split(", ")[0].split(": ")
    assert f": physics.kosaka.{key}: " in line
    assert "expected" in line
    assert value in line or "more than" in line
    assert constants(right) == []


def test_stiffer_springs_are_borne_by_shorter_time_steps():
    assert constants("ks: 2e4, kd: 100", more=", substeps: 20") == []


@pytest.mark.parametrize(
    "balloon", ["size: 160, capsule: 10", "size: 260, capsule: 20", "size: 646, capsule: 60"]
)
def test_what_the_rule_chooses_is_never_refused(balloon):
    assert messages("model: kosaka", balloon) == []


def test_the_models_own_time_steps_are_those_that_are_assumed():
    assert USUAL_RATE == SUBSTEPS * NOMINAL_RATE
    assert (RE, NATURAL) == (REACH, 0.5)


@pytest.mark.parametrize(
    ("physics", "head", "what"),
    [
        ("substeps: 100", "", "substeps: 2400 time steps/s make springs so stiff that the balloon collapses"),
        (
            "substeps: 20",
            "fps: 2\n",
            "substeps: 40 time steps/s are too few for its springs, expected at least 50",
        ),
        ("substeps: 20", "fps: 120\n", "expected no such line: the model chooses them"),
        ("gravity: 9.81", "", "runs out through its wall, expected at most 0.5"),
    ],
)
def test_what_springs_and_particles_cannot_do_is_refused(physics, head, what):
    (line,) = messages(f"model: kosaka, {physics}", "size: 260, capsule: 14", head)
    assert what in line


def test_problems_of_constants_and_of_lengths_are_told_together():
    lines = constants("ks: 1e6, re: 10 cm", balloon="size: 260, capsule: 2")
    assert len(lines) == 3


@pytest.mark.parametrize(
    ("entries", "remedy"),
    [
        ("leak: 5 days", "5 days in a hold of 2 s are too fast to follow, expected hold: 5, or leak: 2 days"),
        ("leak: 1 h, hold: 0", "1 h in a hold of 0 s are too fast to follow, expected hold: 1"),
    ],
)
def test_a_leak_that_no_wall_could_follow_is_told_the_hold_that_it_needs(entries, remedy):
    (line,) = messages(entries)
    assert line.startswith("t.yaml:6:")
    assert line.endswith(f"physics.leak: {remedy}")
    assert messages("leak: 5 days, hold: 5") == []
    assert messages("leak: 2 days") == []
