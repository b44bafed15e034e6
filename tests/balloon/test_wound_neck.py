"""Wound necks: the rubber that turns draw in, and their torque."""

from __future__ import annotations

import math

import numpy as np
import pytest

from balloon_usd.balloon.rubber import rubber_named
from balloon_usd.balloon.sizes import size_named
from balloon_usd.balloon.wound_neck import (
    PACKING_TURNS,
    drawing_torque,
    drawn_in_a_turn,
    drawn_rubber,
    holding_friction,
    strand_force,
    wound_rigidity,
)

MM = 1e-3
LATEX = rubber_named()


@pytest.mark.parametrize("name", ["160", "260", "646"])
def test_a_rope_is_as_long_as_takes_the_least_energy(name):
    size, angle = size_named(name), 12.0
    lengths = np.linspace(0.2, 40.0, 200_001) * MM
    energy = wound_rigidity(size, LATEX) * angle**2 / (2.0 * lengths) + strand_force(size, LATEX) * lengths
    least = int(energy.argmin())
    assert drawn_in_a_turn(size, LATEX) * angle / (2.0 * math.pi) == pytest.approx(lengths[least], rel=1e-3)
    torque = wound_rigidity(size, LATEX) * angle / lengths[least]
    assert drawing_torque(size, LATEX) == pytest.approx(torque, rel=1e-3)


def test_the_strands_of_a_260_pull_with_some_newtons_and_a_turn_draws_a_millimetre():
    assert strand_force(size_named("260"), LATEX) == pytest.approx(6.8, abs=0.1)
    assert drawn_in_a_turn(size_named("260"), LATEX) == pytest.approx(1.09 * MM, rel=0.01)


def test_turns_that_pack_a_neck_draw_nothing_and_every_further_one_of_either_sense_as_much():
    size = size_named("260")
    assert drawn_rubber(size, LATEX, 0.5) == drawn_rubber(size, LATEX, PACKING_TURNS) == 0.0
    for turns in (PACKING_TURNS + 2.0, -PACKING_TURNS - 2.0):
        assert drawn_rubber(size, LATEX, turns) == pytest.approx(2.0 * drawn_in_a_turn(size, LATEX))


def test_the_more_turns_hold_a_neck_the_less_friction_it_needs_as_of_a_rope_round_a_bollard():
    assert holding_friction(0.5) == math.inf
    ratios = [math.exp(2.0 * math.pi * holding_friction(turns) * (turns - 0.5)) for turns in (1.0, 2.0, 5.0)]
    assert ratios == pytest.approx([ratios[0]] * 3)
    assert 0.05 < holding_friction(3.0) < holding_friction(2.0) < 0.3
