"""The words of the particle model and of pressing: what they mean, and what does not go together."""

from __future__ import annotations

import pytest

from balloon_usd.recipe import Recipe, RecipeError

HEAD = "format: 1\nname: dog\nunits: cm\n"
CAPSULE = HEAD + "balloons:\n  main: {size: 260, capsule: 20}\nsteps:\n"
TUBE = HEAD + "balloons:\n  main: {size: 260, tail: 10}\nsteps:\n"
KOSAKA = "physics:\n  model: kosaka\n"
AB = "  - bubbles: {a: 5, b: 5}\n"


def messages(text: str) -> list[str]:
    with pytest.raises(RecipeError) as caught:
        Recipe.parse(text, file="dog.yaml")
    return str(caught.value).splitlines()


def press_of(written: str):
    return Recipe.parse(f"{TUBE}{AB}  - press: {written}\n").steps[1].press


def test_the_particle_model_is_read_with_its_constants_in_si_units() -> None:
    text = f"{CAPSULE}  - wait: 1\n{KOSAKA}  kosaka: {{ks: 2e4, gamma: 0.1, re: 1, contact_offset: 2 mm}}\n"
    physics = Recipe.parse(text).physics
    assert physics.model == "kosaka"
    assert (physics.kosaka.ks, physics.kosaka.kd, physics.kosaka.swell) == (2e4, None, 0.03)
    assert physics.kosaka.gamma == pytest.approx(0.001)
    assert (physics.kosaka.re, physics.kosaka.contact_offset) == (0.01, 0.002)


def test_what_goes_beyond_the_thesis_can_be_switched_off() -> None:
    off = "{grading: 0, calming: 0, drag: 0}"
    kosaka = Recipe.parse(f"{CAPSULE}  - wait: 1\n{KOSAKA}  kosaka: {off}\n").physics.kosaka
    assert (kosaka.grading, kosaka.calming, kosaka.drag) == (0.0, 0.0, 0.0)


def test_what_is_absent_is_left_to_the_model() -> None:
    kosaka = Recipe.parse(f"{CAPSULE}  - wait: 1\n{KOSAKA}").physics.kosaka
    assert {value for key, value in kosaka if key != "swell"} == {None}


def test_a_capsule_is_a_balloon_without_knot_and_tail() -> None:
    balloon = Recipe.parse(f"{CAPSULE}  - wait: 1\n{KOSAKA}").balloons["main"]
    assert (balloon.capsule, balloon.tail, balloon.inflated) == (0.2, None, None)


def test_a_press_has_a_place_and_a_depth_or_a_force() -> None:
    press = press_of("{bubble: a, at: 3, depth: 12 mm}")
    assert (press.bubble, press.at, press.depth, press.force) == ("a", 0.03, 0.012, None)


@pytest.mark.parametrize(
    ("written", "newton"), [("2", 2.0), ("0.5", 0.5), ("2 N", 2.0), ("500 mN", 0.5), ("'2N'", 2.0)]
)
def test_forces_are_newtons_unless_they_say_millinewtons(written: str, newton: float) -> None:
    assert press_of(f"{{bubble: a, force: {written}}}").force == newton


PRESSES = [
    ("{bubble: a}", "press: does not say how deep or how hard, expected one of depth, force"),
    (
        "{bubble: a, depth: 1, force: 2}",
        "press.force: stands beside depth, expected exactly one of depth, force",
    ),
    ("{depth: 1}", "press.bubble: is missing, expected the name of a bubble"),
    ("{bubble: c, depth: 1}", 'press.bubble: unknown bubble "c", expected one of a, b, main_rest'),
    ("{bubble: main_rset, depth: 1}", 'press.bubble: unknown bubble "main_rset", did you mean "main_rest"?'),
    ("{bubble: a, dept: 1, depth: 1}", 'press.dept: unknown key "dept", did you mean "depth"?'),
    ("{bubble: a, depth: 0}", "press.depth: 0 is out of range, expected more than 0 and at most 5 m"),
    (
        "{bubble: a, at: -1, depth: 1}",
        "press.at: -1 cm is out of range, expected more than 0 and at most 5 m",
    ),
    ("{bubble: a, force: 2 kg}", 'press.force: unknown force unit "kg", expected one of N, mN'),
    (
        "{bubble: a, force: 200}",
        "press.force: 200 N is out of range, expected more than 0 and at most 100 N",
    ),
    ("{bubble: a, force: hard}", 'press.force: "hard" is no force, expected 2 or "2 N"'),
    ("3", "press: 3 does not fit, expected entries such as key: value"),
]


@pytest.mark.parametrize(("written", "message"), PRESSES)
def test_a_wrong_press_gives_one_message_at_its_line(written: str, message: str) -> None:
    (found,) = messages(f"{TUBE}{AB}  - press: {written}\n")
    assert found.startswith("dog.yaml:8:")
    assert found.partition(" ")[2] == f"steps[1].{message}"


def test_springs_cannot_be_squeezed() -> None:
    (found,) = messages(f"{CAPSULE}  - squeeze: {{bubble: main_rest, by: 20}}\n{KOSAKA}")
    assert "steps[0].squeeze: makes no sense with model kosaka" in found
    assert found.endswith("expected press, or no such step")


def test_a_bubble_is_squeezed_by_a_share_of_its_width() -> None:
    (found,) = messages(f"{TUBE}{AB}  - squeeze: {{bubble: a, by: 80 %}}\n")
    assert "80 % is out of range, expected 1 to 60 %, the nearest is 60 %" in found
    (found,) = messages(f"{TUBE}{AB}  - squeeze: {{bubble: c, by: 20 %}}\n")
    assert 'unknown bubble "c"' in found


def test_turns_make_no_sense_beside_a_press() -> None:
    (found,) = messages(f"{TUBE}{AB}  - press: {{bubble: a, depth: 1}}\n    turns: 2\n")
    assert found.endswith(
        "steps[1].turns: makes no sense with press, expected one of balloon, point, seconds, note"
    )


def test_the_rest_that_no_step_names_can_be_pressed_and_bent() -> None:
    steps = Recipe.parse(
        f"{TUBE}{AB}  - press: {{bubble: main_rest, depth: 1}}\n  - bend: {{main_rest: 30}}\n"
    ).steps
    assert [step.word for step in steps] == ["bubbles", "press", "bend"]


def test_a_recipe_may_make_nothing_at_all() -> None:
    assert Recipe.parse(f"{TUBE}  - wait: 1\n  - bend: {{main_rest: 30}}\n").steps[1].word == "bend"


def test_the_unnamed_rest_exists_when_nothing_more_is_made_of_its_balloon() -> None:
    (found,) = messages(f"{TUBE}  - press: {{bubble: main_rest, depth: 1}}\n{AB}")
    assert found == (
        'dog.yaml:7:21: steps[0].press.bubble: bubble "main_rest" does not exist yet, steps[1] makes more of "main":'
        " expected this step after that one"
    )


def test_a_rest_with_a_name_has_no_other() -> None:
    (found,) = messages(f"{TUBE}  - rest: tail\n  - press: {{bubble: main_rest, depth: 1}}\n")
    assert 'unknown bubble "main_rest", expected tail' in found


def test_a_press_stays_on_the_balloon_that_it_names() -> None:
    two = TUBE.replace("steps:", "  other: {size: 160, tail: 5}\nsteps:")
    (found,) = messages(f"{two}  - press: {{bubble: other_rest, depth: 1}}\n    balloon: main\n")
    assert 'bubble "other_rest" is on balloon "other", expected no other balloon named' in found


@pytest.mark.parametrize(
    ("line", "reason"),
    [
        ("softening: true", "springs do not soften"),
        ("friction: 0.8", "rubber slides freely on rubber"),
        ("burst: stop", "springs do not burst"),
        ("leak: 6 h", "its air is fetched back where it leaks"),
        ("mass_scaling: none", "everything has unit mass"),
    ],
)
def test_what_only_latex_knows_is_refused_beside_the_particle_model(line: str, reason: str) -> None:
    key = line.partition(":")[0]
    assert messages(f"{CAPSULE}  - wait: 1\n{KOSAKA}  {line}\n") == [
        f"dog.yaml:10:{len(key) + 5}: physics.{key}: makes no sense with model kosaka: {reason}, expected no such line"
    ]


def test_gas_is_not_pressed_out_with_the_particle_model() -> None:
    assert messages(f"{CAPSULE}{AB}    burp: 20 %\n{KOSAKA}") == [
        "dog.yaml:8:11: steps[0].burp: makes no sense with model kosaka, whose bubbles keep the air particles"
        " that are in them, expected no burp"
    ]


def test_turns_are_refused_with_the_particle_model() -> None:
    assert messages(f"{CAPSULE}{AB}    turns: 3\n{KOSAKA}") == [
        "dog.yaml:8:12: steps[0].turns: makes no sense with model kosaka: its joints freeze and are not wound,"
        " expected no turns"
    ]


@pytest.mark.parametrize("model", ["", "  model: latex\n"])
def test_constants_of_the_particle_model_are_refused_with_latex(model: str) -> None:
    (found,) = messages(f"{TUBE}{AB}physics:\n{model}  kosaka: {{ks: 2e4}}\n")
    assert found.endswith(
        "physics.kosaka: stands beside model latex, which has no such constants, expected model: kosaka"
    )


def test_a_capsule_is_refused_with_latex() -> None:
    assert messages(f"{CAPSULE}  - wait: 1\n") == [
        "dog.yaml:5:30: balloons.main.capsule: a closed capsule has no knot to blow up from in model latex,"
        " expected inflated here, or physics: {model: kosaka}"
    ]


def test_a_capsule_stands_alone() -> None:
    text = CAPSULE.replace("capsule: 20", "inflated: 20, capsule: 20") + "  - wait: 1\n" + KOSAKA
    (found,) = messages(text)
    assert found.endswith(
        "capsule: stands beside inflated, expected exactly one of tail, inflated, filled, capsule"
    )


@pytest.mark.parametrize("entry", ["length: 30", "thickness: 0.2 mm"])
def test_a_capsule_has_no_dimensions_of_a_flat_tube(entry: str) -> None:
    text = CAPSULE.replace("capsule: 20", f"capsule: 20, {entry}") + "  - wait: 1\n" + KOSAKA
    (found,) = messages(text)
    assert found.endswith("makes no sense with capsule, which is no flat tube, expected no such entry")


CONSTANTS = [
    ("swell: 0", "0 is out of range, expected 0.001 to 0.5, the nearest is 0.001"),
    ("natural: 1.1", "1.1 is out of range, expected 0.05 to 1, the nearest is 1"),
    ("ks: 0", "0 is out of range, expected 1 to 1e+09 1/s2, the nearest is 1"),
    ("kd: .nan", "nan is no number, expected 0 to 1e+06 1/s"),
    ("grading: 1.5", "1.5 is out of range, expected 0 to 1, the nearest is 1"),
    ("grading: true", "true is no number, expected 0 to 1"),
    ("calming: -1", "-1 is out of range, expected 0 to 1e+06 1/s, the nearest is 0"),
    ("calming: 3 cm", '"3 cm" is no number, expected 0 to 1e+06 1/s'),
    ("gradin: 1", 'unknown key "gradin", did you mean "grading"?'),
    ("gamma: 20", "20 cm is out of range, expected more than 0 and at most 10 cm"),
    ("spacing: 0.01", "0.1 mm is out of range, expected at least 1 mm and at most 10 cm"),
    ("air_ofset: 1", 'unknown key "air_ofset", did you mean "air_offset"?'),
]


@pytest.mark.parametrize(("entry", "message"), CONSTANTS)
def test_a_wrong_constant_is_found_at_its_value(entry: str, message: str) -> None:
    (found,) = messages(f"{CAPSULE}  - wait: 1\n{KOSAKA}  kosaka: {{{entry}}}\n")
    assert found.startswith("dog.yaml:10:")
    assert found.endswith(f": physics.kosaka.{entry.partition(':')[0]}: {message}")


def test_names_that_cannot_be_printed_are_escaped_in_every_message() -> None:
    (found,) = [
        line
        for line in messages(f"{TUBE}  - bubbles: {{\u0378a: 5, b: 5, c: 5}}\n  - lock: [b, d]\n")
        if "lock" in line
    ]
    assert found.isprintable()
    assert "\\u0378a" in found


def test_springs_cannot_be_popped() -> None:
    found = messages(f"{CAPSULE}{AB}  - pop: a\n{KOSAKA}")
    assert any(
        "steps[1].pop: makes no sense with model kosaka, whose air particles stay in" in each
        for each in found
    )


EARS = "  - bubbles: {a: 5}\n  - ear: {one: 3}\n  - bubbles: {gap: 4}\n  - ear: {two: 3}\n  - rest: end\n"


@pytest.mark.parametrize(
    ("steps", "told"),
    [
        (f"{EARS}  - pop: gap\n", None),
        (f"{EARS}  - pop: end\n", None),
        (f"{EARS}  - pop: a\n", None),
        (f"{EARS}  - pop: gep\n", 'steps[5].pop: unknown bubble "gep", did you mean "gap"?'),
        (f"{EARS}  - pop: [gap]\n", "steps[5].pop: "),
        (f"{EARS}  - pop: gap\n  - pop: gap\n", 'steps[6].pop: bubble "gap" was popped at steps[5].pop'),
        (
            f"{EARS}  - pop: gap\n  - press: {{bubble: gap, depth: 1}}\n",
            'steps[6].press.bubble: bubble "gap" was popped at steps[5].pop, expected one that has its gas',
        ),
        (f"{EARS}  - pop: gap\n  - bend: {{gap: 20}}\n", 'steps[6].bend.gap: bubble "gap" was popped'),
        (
            f"{AB}  - bubbles: {{c: 5}}\n  - pop: b\n",
            'steps[2].pop: the twist between "b" and "a" would let the gas of both out, expected an ear or a lock'
            " there first",
        ),
        (f"  - pop: a\n{AB}", 'steps[0].pop: bubble "a" does not exist yet'),
        (
            "  - bubbles: {a: 6}\n  - pop: a\n",
            'steps[1].pop: the twist behind "a" would let the gas of both out',
        ),
        (
            "  - ear: {e: 3}\n  - bubbles: {a: 6}\n  - pop: a\n  - bubbles: {b: 5}\n",
            'steps[2].pop: the twist behind "a" would let the gas of both out',
        ),
        (
            "  - rest: all\n  - pop: all\n",
            'bubble "all" is all that there is of its balloon, expected another',
        ),
        ("  - ear: {e: 3}\n  - pop: e\n", "expected another, or this step after more is made of it"),
        (f"{EARS}  - pop: gap\n  - lock: {{joints: [gap.start, end.end]}}\n", None),
        (f"{EARS}  - pop: gap\n  - tie: {{end: a.start, to: gap.end}}\n", None),
        (
            f"{EARS}  - pop: a\n  - lock: {{joints: [a.start, end.start]}}\n",
            'steps[6].lock.joints: bubble "a" was popped at steps[5].pop, and nothing else hangs on a.start',
        ),
        (
            f"{EARS}  - pop: a\n  - tie: {{end: end.end, to: a.start}}\n",
            'steps[6].tie.to: bubble "a" was popped at steps[5].pop, and nothing else hangs on a.start',
        ),
        (
            f"{EARS}  - pop: gap\n  - lock: [a, end]\n",
            "(one, gap, two between them), expected lock: {joints: [a.start, end.end]}",
        ),
        (f"{AB}  - pop: main_rest\n", 'bubble "main_rest" has no name of its own yet'),
    ],
)
def test_only_what_is_shut_off_for_good_is_popped_and_only_once(steps: str, told: str | None) -> None:
    text = f"{TUBE}{steps}"
    if told is None:
        assert Recipe.parse(text).piece.popped
    else:
        assert any(told in each for each in messages(text))


REST = "  - bubbles: {a: 6, b: 6, c: 6}\n  - lock: [b, c]\n  - rest: tail\n"


def test_springs_have_no_strings() -> None:
    found = messages(f"{CAPSULE}{REST}  - tie: {{end: tail.end, to: tail.start}}\n{KOSAKA}")
    assert any(
        "tie: makes no sense with model kosaka, whose balloons have neither nozzle" in each for each in found
    )


def test_springs_have_no_tail_balls() -> None:
    found = messages(f"{CAPSULE}{REST}  - tail_ball: {{tail: 2.5}}\n{KOSAKA}")
    assert any(
        "tail_ball: makes no sense with model kosaka, whose springs do not soften" in each for each in found
    )


@pytest.mark.parametrize(
    ("steps", "told"),
    [
        (
            f"{REST}  - tail_ball: {{a: 2.5}}\n",
            'bubble "a" is not what is left of a balloon, expected its rest',
        ),
        (f"{REST}  - tail_ball: {{tial: 2.5}}\n", 'unknown bubble "tial", did you mean "tail"?'),
        (f"{REST}  - tail_ball: {{}}\n", "tail_ball: is empty"),
        (f"{REST}  - tail_ball: {{tail: -1}}\n", "out of range"),
        (f"{REST}  - pop: tail\n  - tail_ball: {{tail: 2.5}}\n", 'bubble "tail" was popped at steps[3].pop'),
        (
            f"{REST}  - tail_ball: {{tail: 2.5}}\n  - tail_ball: {{tail: 3}}\n",
            'the tip of "tail" was stretched at steps[3]',
        ),
        ("  - bubbles: {a: 6}\n  - tail_ball: {main_rest: 2.5}\n  - bubbles: {b: 5}\n", "main_rest"),
    ],
)
def test_only_what_is_left_of_a_balloon_has_a_tail_ball(steps: str, told: str) -> None:
    assert any(told in each for each in messages(f"{TUBE}{steps}"))


def test_no_net_of_springs_is_turned_inside_out() -> None:
    found = messages(f"{CAPSULE}  - tulip: {{flower: 6}}\n{KOSAKA}")
    told = "tulip: makes no sense with model kosaka, whose net is not turned inside out"
    assert any(told in each for each in found)


RING = "  - bubbles: {nose: 6, left: 7, right: 7}\n  - lock: [left, right]\n"


@pytest.mark.parametrize(
    "step",
    [
        "push: {bubble: nose, through: [left, right]}",
        "roll: {bubble: nose, between: [left, right]}",
        "tuck: {bubble: nose, between: [left, right]}",
        "thread: {bubble: nose, through: [left, right]}",
        "marriage: {bubbles: {a: 6, b: 6}, to: [left, right]}",
    ],
)
def test_springs_hold_nothing_in_a_ring(step: str) -> None:
    word = step.split(":", maxsplit=1)[0]
    found = messages(f"{CAPSULE}{RING}  - {step}\n{KOSAKA}")
    assert any(f"{word}: makes no sense with model kosaka, whose walls hardly rub" in each for each in found)


@pytest.mark.parametrize(
    ("step", "told"),
    [
        ("push: {bubble: nose, through: [left, right]}", None),
        ("push: {bubble: nose, through: [right, left]}", None),
        ("push: {bubble: nsoe, through: [left, right]}", 'unknown bubble "nsoe", did you mean "nose"?'),
        (
            "push: {bubble: nose, through: [left]}",
            "left is no closed ring by now, expected a loop, a fold, or all",
        ),
        ("push: {bubble: nose, through: [left, left]}", "names a bubble twice"),
        ("push: {bubble: left, through: [left, right]}", "names a bubble twice"),
        ("push: {bubble: nose, through: []}", "push.through: is empty"),
        ("push: {bubble: nose}", "through"),
        ("push: nose", "push"),
        ("roll: {bubble: nose, between: [left, right]}", "nothing hangs on nose.start, expected push"),
        ("roll: {bubble: nose, between: [left]}", "left is no closed ring by now"),
        (
            "bubbles: {neck: 5}\n  - push: {bubble: neck, through: [left, right]}",
            "what hangs on neck.end does not fit through, expected a bubble at the end of a balloon, or roll",
        ),
        ("bubbles: {neck: 6}\n  - roll: {bubble: neck, between: [left, right]}", None),
        (
            "bubbles: {neck: 5, body: 5}\n  - roll: {bubble: body, between: [left, right]}",
            "body does not begin at a joint of left and right",
        ),
        (
            "bubbles: {neck: 6}\n  - lock: {joints: [left.end, neck.end]}\n"
            "  - roll: {bubble: neck, between: [left, right]}",
            "neck hangs on left and right with both ends",
        ),
        (
            "push: {bubble: nose, through: [left, right]}\n  - push: {bubble: nose, through: [left, right]}",
            "nose is held by others already",
        ),
        (
            "rest: neck\n  - pop: neck\n  - roll: {bubble: neck, between: [left, right]}",
            'bubble "neck" was popped',
        ),
    ],
)
def test_only_a_bubble_beside_a_closed_ring_goes_into_it(step: str, told: str | None) -> None:
    text = f"{TUBE}{RING}  - {step}\n"
    if told is None:
        assert Recipe.parse(text).piece.gripped()
    else:
        assert any(told in each for each in messages(text)), messages(text)
