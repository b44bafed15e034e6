"""What the bubbles of a finished figure hold of the gas that the plan gives them."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

from balloon_usd.balloon.air import ATMOSPHERE
from balloon_usd.balloon.ringed_faces import polygon_share

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.plan import Plan
    from balloon_usd.plan.strip import PlannedBubble
    from balloon_usd.solver.frame import Frame


def shares_of_planned_gas(plan: Plan, meshes: Sequence[BalloonMesh], frame: Frame) -> dict[str, float]:
    """Return the gas of each bubble, in shares of the planned, by name: its pressure times its volume, and of
    one for which no pressure is planned the volume alone. Not of those that share their gas across a joint
    that has come undone, nor of limp ones.
    """
    # The plan counts round tubes.
    polygon = {
        name: polygon_share(mesh.around) if strip.has_tail or strip.is_round else 1.0
        for (name, strip), mesh in zip(plan.strips.items(), meshes, strict=True)
    }
    found: dict[str, float] = {}
    for bubble, volume, pressure in _tight(plan, frame):
        share = volume / (polygon[bubble.balloon] * bubble.volume)
        found[bubble.name] = share * (1.0 if bubble.pressure is None else _density(pressure, bubble.pressure))
    return found


def squeezed(plan: Plan, frame: Frame) -> dict[str, float]:
    """Return by which share of its volume each bubble is squeezed, by name: so much its pressure is above the
    planned. Not those without a planned pressure, nor those that `shares_of_planned_gas` leaves out.
    """
    return {
        bubble.name: max(0.0, 1.0 - 1.0 / _density(pressure, bubble.pressure))
        for bubble, _, pressure in _tight(plan, frame)
        if bubble.pressure is not None
    }


def _density(pressure: float, planned: float) -> float:
    """Return how many times as dense gas is at a gauge pressure as at the planned one, Pa (isothermal)."""
    return (ATMOSPHERE + pressure) / (ATMOSPHERE + planned)


def _tight(plan: Plan, frame: Frame) -> Iterator[tuple[PlannedBubble, float, float]]:
    """Yield the bubbles that have gas of their own, with its volume (m3) and gauge pressure (Pa): not those
    beside a joint that has come undone, nor limp ones.
    """
    sharing = {
        bubble.name
        for strip in plan.strips.values()
        for before, behind in pairwise(strip.bubbles)
        if f"{before.name}.end" in frame.undone
        for bubble in (before, behind)
    }
    for bubble, volume, pressure in zip(plan.bubbles, frame.volume, frame.pressure, strict=True):
        if bubble.volume > 0.0 and bubble.name not in sharing | plan.limp:
            yield bubble, float(volume), float(pressure)
