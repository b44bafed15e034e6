"""Cautions: each is given where it is due, and not otherwise."""

from __future__ import annotations

import pytest


def whats(figure) -> list[str]:
    return [caution.what for caution in figure.cautions]


def test_the_thesis_dog_is_above_reproach(dog):
    assert dog.cautions == ()


def test_a_twist_that_nothing_holds_is_named(planned):
    figure = planned("balloons: {a: {size: 260, tail: 10}}\nsteps: [{bubbles: {b: 8, c: 8}}, {ear: {d: 4}}]")
    assert whats(figure) == ["the twist between b and c will unwind"]
    assert figure.cautions[0].step == 0
    assert "free to spin" in figure.cautions[0].why


@pytest.mark.parametrize(
    ("turns", "said"),
    [
        (1, ["a twist of 1 turn may unwind"]),
        (2, []),
        (3, []),
        (5, []),
        (8, ["a twist of 8 turns strains its neck"]),
    ],
)
def test_too_few_and_too_many_turns_are_named(planned, turns, said):
    figure = planned(
        f"balloons: {{a: {{size: 260, tail: 10}}}}\nsteps: [{{loop: {{b: 20}}, turns: {turns}}}]"
    )
    assert whats(figure) == said


@pytest.mark.parametrize(("second", "count"), [(10, 0), (10.9, 0), (11.5, 1)])
def test_an_unequal_pair_is_named(planned, second, count):
    figure = planned(f"""
        balloons: {{a: {{size: 260, tail: 10}}}}
        steps: [{{bubbles: {{b: 10, c: {second}}}}}, {{lock: [b, c]}}]
        """)
    assert len(figure.cautions) == count
    assert all("unequal pair" in what for what in whats(figure))


def test_three_unequal_bubbles_in_a_lock_are_a_design(planned):
    figure = planned("""
        balloons: {a: {size: 260, tail: 10}}
        steps: [{bubbles: {b: 10, c: 5, d: 10}}, {lock: [b, c, d]}]
        """)
    assert figure.cautions == ()


def test_running_out_of_tail_is_named_at_its_step(planned):
    figure = planned("""
        balloons: {a: {size: 260, tail: 1.5}}
        steps: [{loop: {b: 20}}, {loop: {c: 20}}]
        """)
    (caution,) = figure.cautions
    assert caution.what == "a runs out of tail at the twist that ends c"
    assert caution.step == 1
    assert caution.remedy == "leave a tail of at least 1.9 cm"


def test_a_remaining_stub_blown_too_hard_may_burst(planned):
    loops = ", ".join(f"l{at}: 8" for at in range(16))
    figure = planned(f"balloons: {{a: {{size: 260, tail: 0}}}}\nsteps: [{{loop: {{{loops}}}}}]")
    assert any("may burst" in what for what in whats(figure))
    assert figure.budgets["a"].twists[-1].hoop_stretch > 7.0


def test_bubbles_too_short_to_be_soft_are_named(planned):
    figure = planned("balloons: {a: {size: 260, tail: 10}}\nsteps: [{ear: {b: 1.5}}, {ear: {c: 2}}]")
    assert whats(figure) == ["b (1.5 cm) will be a hard little ball"]
    assert "9.5 kPa" in figure.cautions[0].why


def test_bubbles_too_short_for_a_ball_are_named(planned):
    figure = planned("balloons: {a: {size: 260, tail: 10}}\nsteps: [{ear: {b: 0.9}}]")
    (caution,) = figure.cautions
    assert caution.what == "b (0.9 cm) is too short for a ball"
    assert caution.remedy == "make it 1 cm or longer"


def test_rubber_that_does_not_soften_is_named(planned):
    figure = planned("""
        balloons: {a: {size: 260, tail: 10}}
        steps: [{loop: {b: 20}}]
        physics: {softening: false}
        """)
    assert whats(figure) == ["bubbles will bleed into their necks"]
    assert figure.cautions[0].step is None


def test_pieces_that_are_not_joined_are_named(planned):
    figure = planned("""
        balloons: {a: {size: 260, tail: 10}, b: {size: 260, tail: 10}}
        steps: [{loop: {c: 20}, balloon: a}, {loop: {d: 20}, balloon: b}]
        """)
    assert whats(figure) == ["a, b are not all joined: the sculpture has 2 pieces"]
    assert figure.cautions[0].remedy == "lock: {joints: [c.start, d.start]}"


def test_cautions_come_in_the_order_of_the_steps(planned):
    figure = planned("""
        balloons: {a: {size: 260, tail: 1.5}}
        steps: [{bubbles: {b: 8, c: 8}}, {bubbles: {d: 8, e: 1}, turns: 1}]
        physics: {softening: false}
        """)
    steps = [caution.step for caution in figure.cautions]
    assert steps[-1] is None
    assert steps[:-1] == sorted(steps[:-1])


def test_locks_of_slippery_rubber_are_named_with_the_friction_that_they_need(planned):
    text = """
        physics: {{friction: {}}}
        balloons: {{a: {{size: 260, tail: 10}}}}
        steps: [{{bubbles: {{b: 10, c: 10}}}}, {{lock: [b, c]}}, {{loop: {{d: 20}}, turns: 2}}]
        """
    assert whats(planned(text.format(0.3))) == []
    (one,) = planned(text.format(0.2)).cautions
    assert (one.what, one.remedy) == (
        "1 of 2 locks, loops and ears slip when the hands let go",
        "physics: friction: 0.29",
    )
    (both,) = planned(text.format(0.05)).cautions
    assert both.what.startswith("2 of 2 locks")
    assert whats(planned(text.format(0.29))) == []


@pytest.mark.parametrize(("length", "told"), [(36, False), (50, False), (55, True)])
def test_a_tube_longer_than_any_that_is_sold_is_named(planned, length, told):
    figure = planned(
        f"balloons: {{a: {{size: 260, length: {length}, tail: 10}}}}\nsteps: [{{loop: {{b: 20}}}}]"
    )
    named = [caution for caution in figure.cautions if "no 260 is as long" in caution.what]
    assert bool(named) is told
    assert all("length: 36.7 cm, or inflated" in caution.remedy for caution in named)
