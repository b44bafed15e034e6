"""What is printed as a remedy, taken literally, makes the recipe work: the problem or the caution is gone."""

from __future__ import annotations

import copy
import re
from typing import TYPE_CHECKING, Any

import pytest
import yaml

from balloon_usd.plan import plan
from balloon_usd.recipe import Recipe, RecipeError

if TYPE_CHECKING:
    from pathlib import Path

HEAD = "format: 1\nname: figure\nunits: cm\n"
CORNERS = """\
v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1
"""
FACES = """\
f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8
"""
CUBE = CORNERS + FACES
Cure = dict[str, str | None]
"""What is written at which places; None: the entry is left out. `{1}` is what the first group told."""

ONE = "balloons: {a: {size: 260, %s}}\nsteps: %s\n"
KOSAKA = "balloons: {a: {size: 260, capsule: 14}}\nsteps: [wait: 1]\nphysics: {model: kosaka, %s}\n"
LATEX = "balloons: {a: {size: %s, length: 12, tail: 3}}\nsteps: [wait: 1]\nphysics: {%s}\nfps: %s\n"
SEVERAL = """\
balloons: {a: {size: 160, capsule: 14}, b: {size: 646, capsule: 40}}
steps: [{lock: {joints: [a_rest.start, b_rest.start]}}]
physics: {model: kosaka, kosaka: {%s}}
"""


def told_of(data: dict[str, Any], file: str) -> list[str]:
    """All refusals of a recipe, or its cautions with their remedies."""
    try:
        found = plan(Recipe.parse(yaml.safe_dump(data, sort_keys=False, width=1000), file=file))
    except RecipeError as error:
        return [f"refused: {problem}" for problem in error.problems]
    return [f"caution: {caution.what} | {caution.remedy}" for caution in found.cautions]


def cured(data: dict[str, Any], cure: Cure, found: re.Match[str]) -> dict[str, Any]:
    """The recipe as a message says."""
    changed = copy.deepcopy(data)
    for path, value in cure.items():
        *way, key = path.split(".")
        at: Any = changed
        for part in way:
            at = at[int(part)] if isinstance(at, list) else at.setdefault(part, {})
        if value is None:
            del at[key]
            continue
        written = yaml.safe_load(re.sub(r"<(\d)>", lambda group: str(found[int(group[1])]), value))
        if key == "+":
            at.append(written)
        elif isinstance(at, list):
            at[int(key)] = written
        else:
            at[key] = written
    return changed


def check(body: str, told: str, cure: Cure, folder: Path | None = None) -> None:
    data = yaml.safe_load(HEAD + body)
    file = "figure.yaml" if folder is None else str(folder / "figure.yaml")
    matches = [found for line in told_of(data, file) if (found := re.search(told, line))]
    assert matches, told_of(data, file)
    left = told_of(cured(data, cure, matches[0]), file)
    if matches[0].string.startswith("caution"):
        what = matches[0].string.partition(" |")[0]
        assert [line for line in left if line.startswith(("refused", what))] == []
    else:
        assert [line for line in left if line.startswith("refused")] == []


def table(*rows: tuple[str, str, Cure]) -> pytest.MarkDecorator:
    return pytest.mark.parametrize(("body", "told", "cure"), rows)


# Cautions.


def loops(count: int, length: float, kind: str = "loop") -> str:
    return f"[{kind}: {{{', '.join(f'l{k}: {length}' for k in range(count))}}}]"


def parted(count: int, length: float, kind: str) -> str:
    """As `loops`, with a bubble in the middle, so that fewer meet in one joint."""
    first, middle, last = range(count // 2), count // 2, range(count // 2 + 1, count)
    sides = [f"{kind}: {{{', '.join(f'l{k}: {length}' for k in side)}}}" for side in (first, last)]
    return f"[{sides[0]}, bubbles: {{l{middle}: {length}}}, {sides[1]}]"


TAIL_OF_AT_LEAST = r"\| leave a tail of at least ([\d.]+ cm)$"
AT_MOST_INFLATED = r"\| write inflated: at most ([\d.]+ cm)$"
SHORTER = r"\| make the bubbles shorter by ([\d.]+) cm in all, and "


@table(
    (ONE % ("tail: 1.5", loops(2, 20)), f"runs out of tail.*{TAIL_OF_AT_LEAST}", {"balloons.a.tail": "<1>"}),
    (ONE % ("tail: 0", loops(4, 11)), f"runs out of tail.*{TAIL_OF_AT_LEAST}", {"balloons.a.tail": "<1>"}),
    (
        ONE % ("inflated: 150", loops(3, 12)),
        f"runs out of tail.*{AT_MOST_INFLATED}",
        {"balloons.a.inflated": "<1>"},
    ),
    (
        ONE % ("length: 12, inflated: 48", loops(2, 11)),
        f"runs out of tail.*{AT_MOST_INFLATED}",
        {"balloons.a.inflated": "<1>"},
    ),
    (
        "balloons: {a: {size: 160, inflated: 150}}\nsteps: "
        + loops(5, 6)
        + "\nphysics: {softening: false}\n",
        f"runs out of tail.*{AT_MOST_INFLATED}",
        {"balloons.a.inflated": "<1>"},
    ),
    (
        "balloons: {a: {size: 350, length: 30, tail: 1}}\nsteps: "
        + loops(2, 16)
        + "\nphysics: {model: kosaka}\n",
        f"runs out of tail.*{TAIL_OF_AT_LEAST}",
        {"balloons.a.tail": "<1>"},
    ),
    (
        ONE % ("tail: 2", "[{bubbles: {b: 8}, turns: 1}]"),
        r"may unwind \| (turns: 3)",
        {"steps.0.turns": "3"},
    ),
    (
        ONE % ("tail: 2", "[{bubbles: {b: 8}, turns: 8}]"),
        r"strains its neck \| (turns: 3)",
        {"steps.0.turns": "3"},
    ),
    (
        ONE % ("tail: 2", "[{bubbles: {b: 1.5}}]"),
        r"hard little ball \| make it ([\d.]+ cm) or longer",
        {"steps.0.bubbles.b": "<1>"},
    ),
    (
        "balloons: {a: {size: 646, tail: 2}}\nsteps: [ear: {b: 3}]\n",
        r"hard little ball \| make it ([\d.]+ cm) or longer",
        {"steps.0.ear.b": "<1>"},
    ),
    (
        ONE % ("tail: 2", "[loop: {b: 6}]"),
        r"too short for a loop \| ear instead of loop, or at least ([\d.]+ cm)",
        {"steps.0.loop.b": "<1>"},
    ),
    (
        ONE % ("tail: 2", "[loop: {b: 6}]"),
        r"too short for a loop \| ear instead of loop",
        {"steps.0": "{ear: {b: 6}}"},
    ),
    (
        ONE % ("tail: 8", "[{bubbles: {b: 10, c: 7.5}}, {lock: [b, c]}]"),
        r"unequal pair \| make both ([\d.]+ cm) long",
        {"steps.0.bubbles.b": "<1>", "steps.0.bubbles.c": "<1>"},
    ),
    (
        ONE % ("tail: 8", "[loop: {b: 20}]\nphysics: {softening: false}"),
        r"bleed into their necks \| softening: (true)",
        {"physics.softening": "<1>"},
    ),
    (
        ONE % ("tail: 8", "[bubbles: {b: 9, c: 9}]"),
        r"between b and c will unwind \| lock it to another joint",
        {"steps.+": "{lock: {joints: [b.end, c.end]}}"},
    ),
    (
        ONE % ("tail: 8", "[{bubbles: {b: 9, c: 3}}]"),
        r"between b and c will unwind \| .*, or make one of its neighbours an ear",
        {"steps.0": "{bubbles: {b: 9}}", "steps.+": "{ear: {c: 3}}"},
    ),
)
def test_a_caution_is_gone_once_its_remedy_is_taken(body: str, told: str, cure: Cure) -> None:
    check(body, told, cure)


@pytest.mark.parametrize(("filling", "written"), [("tail: 0", "leave a tail"), ("inflated: 150", "inflated")])
@pytest.mark.parametrize(
    ("kind", "count", "length", "what"),
    [("loop", 21, 6, "may burst"), ("bubbles", 17, 7.5, "runs out of tail")],
)
def test_bubbles_that_leave_room_for_no_tail_are_to_be_shorter(filling, written, kind, count, length, what):
    share = re.compile(rf"{what}.*{SHORTER}(?:leave a tail of at least|write inflated: at most) ([\d.]+ cm)$")
    data = yaml.safe_load(HEAD + ONE % (filling, parted(count, length, kind)))
    (found,) = [match for line in told_of(data, "f.yaml") if (match := share.search(line))]
    assert written in found.string
    shorter = length - float(found[1]) / count
    cure: Cure = {f"balloons.a.{filling.partition(':')[0]}": "<2>"}
    left = told_of(cured(data, cure | {"steps": parted(count, shorter, kind)}, found), "f.yaml")
    assert [line for line in left if "runs out" in line or "burst" in line or "refused" in line] == []


JOINED = r"are not all joined: the sculpture has \d pieces \| "


@table(
    (
        "balloons: {a: {size: 260, tail: 9}, b: {size: 260, tail: 9}}\n"
        "steps: [{loop: {c: 20}, balloon: a}, {loop: {d: 20}, balloon: b}]\n",
        rf"{JOINED}(lock: .*)$",
        {"steps.+": "{<1>}"},
    ),
    (
        "balloons: {a: {size: 260, tail: 9}, b: {size: 260, tail: 9}, c: {size: 160, tail: 9}}\n"
        "steps: [{bubbles: {d: 9}, balloon: a}, {bubbles: {e: 9}, balloon: b}, {ear: {f: 4}, balloon: c}, "
        "{lock: {joints: [d.end, e.end]}}]\n",
        rf"{JOINED}(lock: .*)$",
        {"steps.+": "{<1>}"},
    ),
    (
        "balloons: {a: {size: 260, tail: 9}, b: {size: 260, tail: 9}}\nsteps: [{bubbles: {c: 9}, balloon: a}]\n",
        rf"{JOINED}({{rest: .*}}), then (lock: .*)$",
        {"steps.+": "<1>", "steps.++": None},
    ),
)
def test_pieces_are_joined_by_the_steps_that_are_told(body: str, told: str, cure: Cure) -> None:
    if "steps.++" in cure:
        data = yaml.safe_load(HEAD + body)
        (found,) = [match for line in told_of(data, "f.yaml") if (match := re.search(told, line))]
        data = cured(cured(data, {"steps.+": "<1>"}, found), {"steps.+": "{<2>}"}, found)
        assert [line for line in told_of(data, "f.yaml") if "refused" in line or "joined" in line] == []
    else:
        check(body, told, cure)


# Refusals: balloons and bubbles.


def chain(size: str, filling: str, lengths: list[float]) -> str:
    bubbles = ", ".join(f"b{k}: {length:.3f}" for k, length in enumerate(lengths))
    return f"balloons: {{main: {{size: {size}, {filling}}}}}\nsteps: [bubbles: {{{bubbles}}}]\n"


@pytest.mark.parametrize(
    ("size", "filling", "lengths"),
    [
        ("260", "tail: 17", 11 * [10.0]),
        ("260", "tail: 25", 6 * [10.0]),
        ("260", "tail: 1", 15 * [10.0]),
        ("260", "tail: 1", 16 * [10.0]),
        ("260", "inflated: 70", 4 * [22.0]),
        ("260", "inflated: 120", 14 * [10.0]),
        ("260", "inflated: 120", 20 * [10.0]),
        ("160", "tail: 5", [30.0, 3.0, 90.0, 40.0]),
        ("350", "inflated: 50", 24 * [3.0]),
        ("646", "length: 20, tail: 2", 3 * [40.0]),
        ("350", "length: 12, inflated: 2", [3.8, 2.4, 3.0, 3.2, 4.9, 20.0, 20.0]),
        ("260", "tail: 40", 3 * [9.0]),
    ],
)
def test_bubbles_that_do_not_fit_do_so_as_is_told(size: str, filling: str, lengths: list[float]) -> None:
    data = yaml.safe_load(HEAD + chain(size, filling, lengths))
    (line,) = told_of(data, "f.yaml")
    ways = 0
    if found := re.search(
        r"shorter by ([\d.]+) cm in all, and (?:inflated: at least|a tail of at most) (.* cm)$", line
    ):
        key = "inflated" if "inflated" in filling else "tail"
        filling = re.sub(rf"{key}: [\d.]+", f"{key}: {found[2]}", filling)
    for told, key in (
        (r"expected (?:a tail of )?at most ([\d.]+ cm)$", "tail"),
        (r"expected inflated: at least ([\d.]+ cm)$", "inflated"),
        (r", or a balloon with length: at least ([\d.]+ cm)$", "length"),
    ):
        if found := re.search(told, line):
            ways += 1
            left = told_of(cured(data, {f"balloons.main.{key}": "<1>"}, found), "f.yaml")
            assert [each for each in left if "refused" in each] == []
    if found := re.search(r"bubbles shorter by ([\d.]+) cm in all", line):
        ways += 1
        share = 1.0 - float(found[1]) / sum(lengths)
        shorter = yaml.safe_load(HEAD + chain(size, filling, [share * length for length in lengths]))
        assert [each for each in told_of(shorter, "f.yaml") if "refused" in each] == []
    assert ways > 0, line


def test_a_balloon_told_by_its_inflated_length_is_answered_so() -> None:
    with pytest.raises(RecipeError, match=r"expected inflated: at least [\d.]+ cm$"):
        plan(Recipe.parse(HEAD + chain("260", "inflated: 120", 14 * [10.0])))


CAPSULE = "balloons: {a: {size: 260, capsule: %s}}\nsteps: [bubbles: {%s}]\nphysics: {model: kosaka}\n"


@table(
    (
        ONE % ("tail: 40", "[wait: 1]"),
        r"leaves nothing.*expected at most ([\d.]+ cm)$",
        {"balloons.a.tail": "<1>"},
    ),
    (
        ONE % ("tail: 36.6", "[wait: 1]"),
        r"leaves nothing.*expected at most ([\d.]+ cm)$",
        {"balloons.a.tail": "<1>"},
    ),
    (
        ONE % ("inflated: 300", "[wait: 1]"),
        r"more than a full 260, expected at most ([\d.]+ cm)$",
        {"balloons.a.inflated": "<1>"},
    ),
    (
        ONE % ("tail: 3", "[wait: 1]\nphysics: {rubber: neo-hooke}"),
        r"expected one of (\w+), ([\w-]+), (\w+)$",
        {"physics.rubber": "<2>"},
    ),
    (
        CAPSULE % (300, "b: 5"),
        r"more than a full 260, expected at most ([\d.]+ cm)$",
        {"balloons.a.capsule": "<1>"},
    ),
    (
        "balloons: {a: {size: 260, capsule: 4}}\nsteps: [wait: 1]\nphysics: {model: kosaka}\n",
        r"shorter than a 260 is wide, expected at least ([\d.]+ cm)$",
        {"balloons.a.capsule": "<1>"},
    ),
    (CAPSULE % (30, "b: 1"), r"too short.*expected at least ([\d.]+ cm)$", {"steps.0.bubbles.b": "<1>"}),
    (CAPSULE % (14, "b: 13"), r"does not fit.*expected at most ([\d.]+ cm)", {"steps.0.bubbles.b": "<1>"}),
    (
        CAPSULE % (14, "b: 13"),
        r"does not fit.*a capsule of at least ([\d.]+ cm)",
        {"balloons.a.capsule": "<1>"},
    ),
    (
        ONE % ("tail: 3", "[{bubbles: {b: 6.96}}, {press: {bubble: b, depth: 1, at: 8}}]"),
        r"does not lie inside b, expected less than ([\d.]+) cm",
        {"steps.1.press.at": "<1>9 mm"},
    ),
    (
        ONE % ("tail: 3", "[{bubbles: {b: 7}}, {press: {bubble: b, depth: 9}}]"),
        r"goes through a 260, expected less than ([\d.]+ cm)",
        {"steps.1.press.depth": "<1>"},
    ),
    (
        ONE % ("tail: 3", "[{bubbles: {b: 7, c: 7}}, {rest: d}, {lock: {joints: [b.end, d.end]}}]"),
        r"d.end is the tip of its balloon.*expected another joint",
        {"steps.2.lock.joints": "[b.end, d.start]"},
    ),
    (
        ONE % ("tail: 3", "[{bubbles: {b: 7, c: 7, d: 7}}, {lock: [d, b]}]"),
        r"no neighbours.*expected (\[.*\]) or (lock: .*)$",
        {"steps.1.lock": "<1>"},
    ),
    (
        ONE % ("tail: 3", "[{bubbles: {b: 7, c: 7, d: 7}}, {lock: [d, b]}]"),
        r"no neighbours.*expected (\[.*\]) or (lock: .*)$",
        {"steps.1": "{<2>}"},
    ),
    (
        ONE % ("tail: 3", "[{bubbles: {b: 7, c: 7, d: 7}}, {lock: [d, c]}]"),
        r"not in the order of the balloon, expected (\[.*\])$",
        {"steps.1.lock": "<1>"},
    ),
    (
        "balloons: {a: {size: 260, tail: 9}, b: {size: 260, tail: 9}}\n"
        "steps: [{bubbles: {c: 9}, balloon: a}, {bubbles: {d: 9}, balloon: b}, {lock: [c, d]}]\n",
        r"of different balloons \(a, b\), expected (lock: .*)$",
        {"steps.2": "{<1>}"},
    ),
)
def test_a_balloon_or_a_bubble_is_planned_as_is_told(body: str, told: str, cure: Cure) -> None:
    check(body, told, cure)


@pytest.mark.parametrize("lengths", [[6, 6, 6], [4, 9, 3], [12, 2, 2]])
def test_bubbles_of_a_capsule_are_planned_once_they_are_shorter_in_all_as_is_told(lengths):
    text = ", ".join(f"b{k}: {length}" for k, length in enumerate(lengths))
    data = yaml.safe_load(HEAD + CAPSULE % (16, text))
    (line,) = told_of(data, "f.yaml")
    if found := re.search(r"bubbles shorter by ([\d.]+) cm in all", line):
        share = 1.0 - float(found[1]) / sum(lengths)
        text = ", ".join(f"b{k}: {share * length}" for k, length in enumerate(lengths))
        assert told_of(yaml.safe_load(HEAD + CAPSULE % (16, text)), "f.yaml") == []
    found = re.search(r"a capsule of at least ([\d.]+ cm)", line)
    assert found is not None
    assert told_of(cured(data, {"balloons.a.capsule": "<1>"}, found), "f.yaml") == []


def test_so_many_joints_are_twisted_into_one_as_is_told():
    bubbles = ", ".join(f"b{k}: 12" for k in range(40))
    steps = "[{bubbles: {%s}}, {lock: {joints: [%s]}}]"

    def recipe(count: int) -> dict[str, Any]:
        joints = ", ".join(f"b{k}.end" for k in range(count))
        return yaml.safe_load(HEAD + ONE % ("length: 200, tail: 45", steps % (bubbles, joints)))

    (line,) = told_of(recipe(36), "f.yaml")
    found = re.search(r"36 joints would be twisted into one, expected at most (\d+)$", line)
    assert found is not None
    assert not [each for each in told_of(recipe(int(found[1])), "f.yaml") if "refused" in each]


# Refusals: shapes.

SHAPES = "balloons: {%s}\nsteps: [wait: 1]\n"


@table(
    (
        SHAPES % "a: {mesh: cube.obj, thickness: 2 mm}",
        r"expected at most ([\d.]+ mm)$",
        {"balloons.a.thickness": "<1>"},
    ),
    (SHAPES % "a: {mesh: cube.obj, swell: 0.6}", r"expected at least ([\d.]+)$", {"balloons.a.swell": "<1>"}),
    (SHAPES % "a: {mesh: cube.obj, unit: mm}", r"is its unit (\w+)\?$", {"balloons.a.unit": "<1>"}),
    (
        SHAPES % "a: {mesh: cube.obj}, b: {mesh: cube.obj, at: [1, 0.5, 0]}",
        r"such as at: (\[.*\])$",
        {"balloons.b.at": "<1>"},
    ),
)
def test_a_shape_is_planned_as_is_told(body: str, told: str, cure: Cure, tmp_path: Path) -> None:
    (tmp_path / "cube.obj").write_text(CUBE)
    check(body, told, cure, tmp_path)


def test_a_long_shape_does_not_bulge_with_the_swell_that_is_told(tmp_path):
    (tmp_path / "bar.obj").write_text(re.sub(r"(-?1)$", r"\g<1>0", CORNERS, flags=re.MULTILINE) + FACES)
    check(
        SHAPES % "a: {mesh: bar.obj, swell: 2.5}",
        r"may bulge at one place \| swell: ([\d.]+)$",
        {"balloons.a.swell": "<1>"},
        tmp_path,
    )


def test_several_shapes_in_one_place_are_planned_at_those_that_are_told(tmp_path):
    (tmp_path / "cube.obj").write_text(CUBE)
    file = str(tmp_path / "figure.yaml")
    shapes = ", ".join(f"s{k}: {{mesh: cube.obj, at: [0, {k / 10}, 0]}}" for k in range(4))
    data = yaml.safe_load(HEAD + SHAPES % shapes)
    lines = told_of(data, file)
    assert len(lines) == 3
    for line in lines:
        found = re.search(r"balloons\.(s\d): .* such as at: (\[.*\])$", line)
        assert found is not None
        data = cured(data, {f"balloons.{found[1]}.at": "<2>"}, found)
    assert [line for line in told_of(data, file) if "refused" in line] == []


# Refusals: physics.


@table(
    (LATEX % ("260", "substeps: 20", 8), r"expected at least (\d+)$", {"physics.substeps": "<1>"}),
    (
        LATEX % ("260", "mass_scaling: none", 24),
        r"expected substeps: (\d+) or more",
        {"physics.substeps": "<1>"},
    ),
    (
        LATEX % ("260", "mass_scaling: none", 24),
        r", or mass_scaling: (\w+)$",
        {"physics.mass_scaling": "<1>"},
    ),
    (
        LATEX % ("260", "mass_scaling: none, substeps: 20", 12),
        r"expected mass_scaling: (\w+) and substeps: (\d+), or",
        {"physics.mass_scaling": "<1>", "physics.substeps": "<2>"},
    ),
    (
        LATEX % ("260", "mass_scaling: none, substeps: 20", 12),
        r"or fps: (\d+) and substeps: (\d+)$",
        {"fps": "<1>", "physics.substeps": "<2>"},
    ),
    (
        LATEX % ("160", "mass_scaling: none", 24),
        r"or fps: (\d+) and substeps: (\d+)$",
        {"fps": "<1>", "physics.substeps": "<2>"},
    ),
    (LATEX % ("260", "leak: 5 days", 24), r"expected hold: (\d+),", {"physics.hold": "<1>"}),
    (LATEX % ("260", "leak: 30 days", 24), r"expected hold: (\d+),", {"physics.hold": "<1>"}),
    (LATEX % ("260", "leak: 5 days, hold: 0.7", 24), r"or leak: (.*)$", {"physics.leak": "<1>"}),
    (LATEX % ("260", "hold: 1", 1), r"expected at least (\d+) frames/s$", {"fps": "<1>"}),
    (
        ONE % ("length: 9, tail: 2, thickness: 3 mm", "[wait: 1]"),
        r"expected at most ([\d.]+ mm)$",
        {"balloons.a.thickness": "<1>"},
    ),
    (
        ONE % ("length: 9, tail: 2, radius: 1 mm, thickness: 0.4 mm", "[wait: 1]"),
        r"expected at most ([\d.]+ mm)$",
        {"balloons.a.thickness": "<1>"},
    ),
)
def test_a_setting_of_latex_is_planned_as_is_told(body: str, told: str, cure: Cure) -> None:
    check(body, told, cure)


NO_SUCH_LINE = r"no such line"


def kosaka(entries: str) -> str:
    return KOSAKA % f"kosaka: {{{entries}}}"


def constant(key: str, told: str, more: str = "") -> list[tuple[str, str, Cure]]:
    """Both ways out of a constant that cannot work: another value, and none."""
    name = key.partition(":")[0]
    return [
        (kosaka(key + more), told, {f"physics.kosaka.{name}": "<1>"}),
        (
            kosaka(key + more),
            rf"{name}: .*{NO_SUCH_LINE}: the model chooses",
            {f"physics.kosaka.{name}": None},
        ),
    ]


AT_MOST, AT_LEAST = r"expected at most ([\d.]+(?: mm)?),", r"expected at least ([\d.]+(?: mm)?)(?:,| and)"


@table(
    (
        KOSAKA % "substeps: 100",
        r"expected at most (\d+),",
        {"physics.substeps": "<1>"},
    ),
    (KOSAKA % "substeps: 100", NO_SUCH_LINE, {"physics.substeps": None}),
    (KOSAKA % "substeps: 20" + "fps: 2\n", r"expected at least (\d+),", {"physics.substeps": "<1>"}),
    (KOSAKA % "substeps: 20" + "fps: 120\n", NO_SUCH_LINE, {"physics.substeps": None}),
    (KOSAKA % "gravity: 9.8", r"expected at most ([\d.]+)$", {"physics.gravity": "<1>"}),
    (
        "balloons: {a: {size: 260, tail: 20}}\nsteps: [wait: 1]\nphysics: {model: kosaka, gravity: 9.8}\n",
        r"expected at most [\d.]+, or model: (latex)$",
        {"physics.model": "<1>"},
    ),
    *constant("ks: 8e3", AT_MOST),
    *constant("kd: 60", AT_MOST),
    *constant("calming: 50", AT_MOST),
    *constant("drag: 1.0e+3", AT_MOST),
    (kosaka("alpha: 0"), r"more than 0", {"physics.kosaka.alpha": "0.01"}),
    (kosaka("beta: 0"), r"more than 0", {"physics.kosaka.beta": "0.01"}),
    (kosaka("push: 0"), NO_SUCH_LINE, {"physics.kosaka.push": None}),
    *constant("elongation_limit: 0.5", AT_LEAST),
    *constant("elongation_limit: 0.5", AT_LEAST, ", natural: 0.37"),
    (
        kosaka("elongation_limit: 5, natural: 0.05"),
        r"expected no such line$",
        {"physics.kosaka.elongation_limit": None},
    ),
    (kosaka("re: 5 mm"), r"re of more than ([\d.]+) mm", {"physics.kosaka.re": "<1>01 mm"}),
    (kosaka("re: 9 cm"), r"and at most ([\d.]+ mm),", {"physics.kosaka.re": "<1>"}),
    (kosaka("re: 9 cm"), NO_SUCH_LINE, {"physics.kosaka.re": None}),
    (kosaka("spacing: 2 cm"), r"and less than ([\d.]+ mm),", {"physics.kosaka.spacing": "<1>"}),
    *constant("spacing: 2 mm", AT_LEAST),
    *constant("air_offset: 0.1 mm", r"expected at least ([\d.]+ mm),"),
    *constant("air_offset: 5 cm", AT_MOST),
    *constant("leak_offset: 5 cm", AT_MOST),
    *constant("contact_offset: 5 cm", AT_MOST),
    *constant("gamma: 5 cm", AT_MOST),
)
def test_a_setting_of_model_kosaka_is_planned_as_is_told(body: str, told: str, cure: Cure) -> None:
    check(body, told, cure)


@pytest.mark.parametrize(
    "entry", ["re: 20 mm", "re: 5 mm", "spacing: 2 mm", "spacing: 4 mm", "spacing: 9 cm"]
)
def test_what_suits_no_two_balloons_of_model_kosaka_is_left_to_it(entry):
    key = entry.partition(":")[0]
    balloons = "balloons: {a: {size: 160, capsule: 14}, b: {size: 646, capsule: 40}}\nsteps: [wait: 1]\n"
    body = f"{balloons}physics: {{model: kosaka, kosaka: {{{entry}}}}}\n"
    check(body, NO_SUCH_LINE, {f"physics.kosaka.{key}": None})


@pytest.mark.parametrize("sizes", [("160", "260"), ("260", "350"), ("260", "360"), ("350", "646")])
@pytest.mark.parametrize(
    "entry", ["re: 1 mm", "re: 9 cm", "spacing: 1 mm", "spacing: 9 cm", "air_offset: 9 cm"]
)
def test_one_constant_for_balloons_of_two_sizes_is_told_one_range_that_suits_both(sizes, entry):
    key, one, two = entry.partition(":")[0], *sizes
    balloons = f"balloons: {{a: {{size: {one}, capsule: 20}}, b: {{size: {two}, capsule: 30}}}}\n"
    body = f"{balloons}steps: [wait: 1]\nphysics: {{model: kosaka, kosaka: {{{entry}}}}}\n"
    data = yaml.safe_load(HEAD + body)
    (line,) = told_of(data, "f.yaml")
    if found := re.search(r"(?:at most|at least) ([\d.]+ mm),", line):
        check(
            body,
            re.escape(found[0]).replace(re.escape(found[1]), r"([\d.]+ mm)"),
            {f"physics.kosaka.{key}": "<1>"},
        )
    else:
        check(body, NO_SUCH_LINE, {f"physics.kosaka.{key}": None})
