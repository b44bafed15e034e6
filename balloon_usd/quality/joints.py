"""Joints of a finished figure: which were meant to hold, and which do."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from balloon_usd.quality.ring_corners import RingCorners
from balloon_usd.recipe.held_words import EVERY, PLANNED

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from balloon_usd.balloon.tube_mesh import BalloonMesh
    from balloon_usd.language.joint import Joint
    from balloon_usd.operations.workpiece import Workpiece
    from balloon_usd.plan import Plan
    from balloon_usd.solver.frame import Frame

    Floats = NDArray[np.float64]

OPEN_NECK = 0.25
"""Radius from which on a neck is open, in radii of the blown-up balloon: a closed one has a tenth."""
APART = 0.5
"""Distance to the next neck from which on a neck has left its joint, in the same; many lie side by side."""


SLIPPED = " = "
"""Stands between the necks of a lock that has slipped, where it is told what has come undone."""


class PlannedJoint(NamedTuple):
    """A place where ends of bubbles meet when the hands have let go."""

    name: str
    """Its first end, as in a recipe: `nose.end`."""
    rings: tuple[int, ...]
    """Necks, as rings of the plan."""
    holds: bool
    """Whether it is meant to: several bubbles meet in it, and it does not untwist."""
    ends: tuple[Joint, ...]
    """All ends of bubbles that meet in it."""


def joints_of(plan: Plan) -> list[PlannedJoint]:
    """Return all joints of a plan, without those that are meant to slip; tips have none."""
    return _joints(plan, plan.piece_let_go)


def made_joints(plan: Plan) -> list[PlannedJoint]:
    """Return all joints that a recipe makes, also those that are meant to slip; tips have none."""
    return _joints(plan, plan.recipe.piece)


def _joints(plan: Plan, piece: Workpiece) -> list[PlannedJoint]:
    loose = {loose.end for loose in plan.loose}
    found = []
    for ends in piece.joints:
        shaped = any(plan.strips[piece.bubbles[end.bubble].balloon].shape is not None for end in ends)
        rings = () if shaped else sorted({r for end in ends if (r := plan.table.joint(end)) is not None})
        if rings:
            holds = len(ends) > 1 and loose.isdisjoint(ends)
            found.append(PlannedJoint(str(ends[0]), tuple(rings), holds, tuple(ends)))
    return found


def lost_joints(plan: Plan, meshes: Sequence[BalloonMesh], frame: Frame) -> tuple[int, list[str]]:
    """Return how many joints were meant to hold, and the names of those that have come undone in a frame.

    One has if the simulation says so, a neck of it is open, or its necks lie apart.
    """
    meant = [joint for joint in joints_of(plan) if joint.holds]
    # Locks that slip as planned are no joints of these.
    undone = {told for told in frame.undone if SLIPPED not in told}
    return len(meant), [joint.name for joint in meant if _lost(plan, meshes, frame, joint, undone)]


def unkept_joints(plan: Plan, meshes: Sequence[BalloonMesh], frame: Frame) -> list[tuple[str, list[str]]]:
    """Return the joints that must hold by the recipe and do not in a frame, by a name and all their ends."""
    wanted = plan.recipe.must_hold
    undone = {told for told in frame.undone if SLIPPED not in told}
    if wanted == PLANNED:
        asked = [(joint.name, joint) for joint in joints_of(plan) if joint.holds]
    else:
        undone |= {name for told in frame.undone for name in told.split(SLIPPED)}
        joints = made_joints(plan)
        asked = [(name, joint) for joint in joints if (name := _named(joint, wanted))]
    return [
        (name, [str(end) for end in joint.ends])
        for name, joint in asked
        if _lost(plan, meshes, frame, joint, undone)
    ]


def _named(joint: PlannedJoint, wanted: str | tuple[Joint, ...]) -> str | None:
    """Return how a joint that is wanted is called: as a recipe does; None for others."""
    if isinstance(wanted, str):
        return joint.name if wanted == EVERY and len(joint.ends) > 1 else None
    return next((str(end) for end in wanted if end in joint.ends), None)


def _lost(
    plan: Plan, meshes: Sequence[BalloonMesh], frame: Frame, joint: PlannedJoint, undone: set[str]
) -> bool:
    if not undone.isdisjoint(map(str, joint.ends)):
        return True
    return not together(plan, meshes, frame, joint)


def together(plan: Plan, meshes: Sequence[BalloonMesh], frame: Frame, joint: PlannedJoint) -> bool:
    """Tell whether the necks of a joint are closed in a frame, and lie together."""
    middles, wide = [], []
    for index in joint.rings:
        radius = plan.strips[plan.table.rings[index].balloon].inflated_radius
        corners = RingCorners.of(plan, meshes, index).places(frame)
        middles.append(corners.mean(axis=0))
        if np.linalg.norm(corners - middles[-1], axis=1).mean() > OPEN_NECK * radius:
            return False
        wide.append(radius)
    return hang_together(np.array(middles), APART * max(wide))


def hang_together(places: Floats, reach: float) -> bool:
    """Tell whether one comes from each of some places, (N, 3) m, to all others in steps of a reach (m)."""
    near = np.linalg.norm(places[:, None] - places[None], axis=2) <= reach
    found = near[0]
    for _ in places:
        found = near[found].any(axis=0)
    return bool(found.all())
