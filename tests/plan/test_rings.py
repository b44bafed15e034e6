"""Where hands hold the bubbles of a balloon: every place has a ring of its own, and the mesh stays small."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import pytest

from balloon_usd.balloon.detail import DETAILS
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.plan.rings import LEAST_APART, guide_places

SHORT = """
balloons: {{a: {{size: 260, length: {length:.3f}, tail: 0.5}}}}
steps:
- bubbles: {{b: 15, c: 15}}
- rest: end
{bend}"""
BENDS = {"straight": "", "bent": "- bend: {end: 10, c: 30}\n"}


def strips(planned, bend):
    """Balloons of which ever more is left behind two bubbles: from 1.4 to 9 flat radii."""
    for length in np.arange(9.5, 12.9, 0.1):
        (strip,) = planned(SHORT.format(length=length, bend=BENDS[bend])).strips.values()
        yield strip


@pytest.mark.parametrize("bend", BENDS)
def test_every_place_at_which_a_short_rest_is_held_has_a_ring_of_its_own(planned, bend):
    for strip in strips(planned, bend):
        for detail in DETAILS.values():
            mesh, held = mesh_of(strip, detail), guide_places(strip)
            joints = [bubble.rest_end for bubble in strip.bubbles[:-1]]
            rings = [mesh.ring_at(place) for place in (0.0, *joints, *held)]
            assert len(set(rings)) == len(rings)


@pytest.mark.parametrize("bend", BENDS)
def test_places_lie_apart_so_that_no_mesh_grows_between_them(planned, bend):
    for strip in strips(planned, bend):
        held = [place for place in guide_places(strip) if place > strip.bubbles[-1].rest_start]
        assert held == sorted(held)
        assert all(b - a > (LEAST_APART - 1e-9) * strip.size.radius for a, b in pairwise(held))
        for detail in DETAILS.values():
            fewest = strip.size.length / (detail.axial * strip.size.radius)
            assert len(mesh_of(strip, detail).ring_along) < 2.0 * fewest


def test_a_loop_that_is_held_at_more_places_and_whose_round_ends_reach_them_needs_no_more_rings(planned):
    (strip,) = planned("""
        balloons: {a: {size: 260, tail: 10}}
        steps:
        - loop: {b: 20.4}
        - ear: {c: 3}
        - tuck: {bubble: c, between: [b]}
        """).strips.values()
    loop = strip.bubbles[0]
    assert len([place for place in guide_places(strip) if loop.rest_start < place < loop.rest_end]) >= 7
    assert len(mesh_of(strip, DETAILS["draft"]).ring_along) < 150


def test_hands_hold_a_bent_tube_without_flat_tail_up_to_where_it_is_round(planned):
    tube = "balloons: {a: {size: 260, length: 15, tail: 1}}\nsteps:\n- bubbles: {b: 15, c: 15}\n- rest: end\n"
    (strip,) = planned(f"{tube}- bend: {{end: 30}}\n").strips.values()
    rest = strip.bubbles[-1]
    round_end = strip.rest_place(rest, rest.length - strip.inflated_radius)
    assert max(guide_places(strip)) == pytest.approx(round_end, abs=0.2 * strip.size.radius)


def test_what_is_rolled_up_is_held_beyond_the_front_of_its_gas_too(planned):
    tube = "balloons: {a: {size: 160, length: 30, tail: 15}}\nsteps:\n- ear: {b: 2}\n- rest: end\n"
    (bent,) = planned(f"{tube}- bend: {{end: 30}}\n").strips.values()
    (curled,) = planned(f"{tube}- curl: {{end: 2}}\n").strips.values()
    front = curled.rest_place(curled.bubbles[-1], curled.bubbles[-1].length)
    tip = max(guide_places(curled))
    beyond = [place for place in guide_places(curled) if front < place < tip]
    assert len(beyond) > 3
    assert not [place for place in guide_places(bent) if front < place < tip]
