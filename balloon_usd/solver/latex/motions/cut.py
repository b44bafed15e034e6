"""Cutting an end of a balloon off."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.solver.latex.tearing import cut_off
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.severed import Stub

if TYPE_CHECKING:
    from balloon_usd.operations import moves
    from balloon_usd.solver.latex.sculpture import LatexSculpture


class Cut(Motion):
    """Scissors at the joint on which an end of a balloon hangs."""

    def __init__(self, move: moves.Cut, sculpture: LatexSculpture) -> None:
        """Cut it off."""
        scene, hands = sculpture.scene, sculpture.hands
        start, end = sculpture.plan.table.ends(move.bubble)
        ring, side = (start, 1) if end is None else (end, -1)
        body = sculpture.body[sculpture.plan.table.rings[ring].balloon]
        before = int(scene.vertex_start[body])
        first, around = (int(values[sculpture.joints[ring]]) for values in hands.rings)
        stub = Stub.at(scene.bodies[body], first - before, around, side)
        own = np.zeros(len(hands.places), dtype=bool)
        own[before + np.r_[stub.vertices, stub.neck]] = True
        corners = scene.quads.numpy()
        walls = sculpture.vertices
        # Other sculptures of a batch lie in the same space.
        corners = corners[(corners[:, 0] >= walls.start) & (corners[:, 0] < walls.stop)]
        others = hands.places[corners[~own[corners].any(axis=1)]].mean(axis=1, dtype=np.float64)
        balloon = hands.places[scene.vertices_of(body)]
        cut_off(move.bubble, body, stub.clear_of(balloon, others), sculpture)
