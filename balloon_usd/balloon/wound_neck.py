"""The rubber that turns draw into a wound neck.

A closed neck is a bundle of strands, a rod of the wall's cross-section. Turns wind up what the neck hides,
until its torsion energy rises by more with every turn than it costs to draw fresh rubber out of the
bubbles, whose strands pull at it (a configurational force, Eshelby 1975, The elastic energy-momentum tensor).
From then on the rope grows by the same length with every turn, at the same torque.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from balloon_usd.balloon.bubble_shape import strand_stress
from balloon_usd.balloon.tube_theory import maxwell_state

if TYPE_CHECKING:
    from balloon_usd.balloon.rubber import Rubber
    from balloon_usd.balloon.sizes import BalloonSize

PACKING_TURNS = 3.0
"""Turns that only pack a neck and draw nothing in. Calibrated: recipes that state their tail leave 0.5 to
1.1 cm for a twist of the usual three turns (a crown 0.7, a teddy 0.75, two poodles 0.77, the dog of Kosaka
2008 1.1), and the round ends of the bubbles alone take 0.92; makers say that further turns use up the tail.
Drawing from the second turn on, such a twist would take 1.15 cm, and a crown of 54 ears would not fit.
"""
CLOSING_TURNS = 0.5
"""Turns that close a neck: only those beyond hold it."""
HELD_RATIO = 15.0
"""How much harder the strands of bubbles pull at a wound neck than its end is held. Judged: so that three
turns slip at a friction of 0.05, as of wet latex, and hold from 0.17 on, two from 0.29 on.
"""


def rope_radius(size: BalloonSize) -> float:
    """Return the radius (m) of an unstressed rod of the wall's cross-section."""
    return math.sqrt(2.0 * size.radius * size.thickness)


def rope_stretch(rubber: Rubber) -> float:
    """Return the stretch of a wound neck along its axis: that of the tube beside it.

    Raises:
        ValueError: the rubber has no bulged phase.
    """
    return maxwell_state(rubber).bulged.b


def wound_rigidity(size: BalloonSize, rubber: Rubber) -> float:
    """Return the torque (N m) of a wound neck for each radian on each metre of its unstressed rubber, N m2.

    pi mu A^4 / (2 stretch), of a neo-Hookean cylinder of unstressed radius A (Rivlin 1949, Large elastic
    deformations of isotropic materials VI).
    """
    return math.pi * rubber.shear_modulus * rope_radius(size) ** 4 / (2.0 * rope_stretch(rubber))


def strand_force(size: BalloonSize, rubber: Rubber) -> float:
    """Return the force (N) with which the strands of a long bubble's wall pull at its neck.

    Raises:
        ValueError: the rubber cannot hold a bubble.
    """
    return 2.0 * math.pi * size.radius * size.thickness * strand_stress(rubber)


def drawn_in_a_turn(size: BalloonSize, rubber: Rubber) -> float:
    """Return the unstressed rubber (m) that each turn draws into a packed neck: 2 pi times the square
    root of wound rigidity / (2 force of the strands).

    Raises:
        ValueError: the rubber cannot hold a bubble.
    """
    return 2.0 * math.pi * math.sqrt(wound_rigidity(size, rubber) / (2.0 * strand_force(size, rubber)))


def drawing_torque(size: BalloonSize, rubber: Rubber) -> float:
    """Return the torque (N m) at which a wound neck draws rubber in, its highest: the square root of twice
    the wound rigidity times the force of the strands.

    Raises:
        ValueError: the rubber cannot hold a bubble.
    """
    return math.sqrt(2.0 * wound_rigidity(size, rubber) * strand_force(size, rubber))


def holding_friction(turns: float) -> float:
    """Return the least friction at which a neck that is wound about others by so many turns holds; infinite
    where they only close it.

    The tension of a rope wound about another falls by exp(2 pi friction turns) along it (Euler's capstan).
    """
    holding = turns - CLOSING_TURNS
    return math.log(HELD_RATIO) / (2.0 * math.pi * holding) if holding > 0.0 else math.inf


def drawn_rubber(size: BalloonSize, rubber: Rubber, turns: float) -> float:
    """Return the unstressed rubber (m) that so many full turns of either sense draw into a neck, half of it
    from each side.

    Raises:
        ValueError: the rubber cannot hold a bubble.
    """
    return max(abs(turns) - PACKING_TURNS, 0.0) * drawn_in_a_turn(size, rubber)
