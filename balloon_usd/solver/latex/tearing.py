"""Rubber that is gone: a bubble tears in the middle, or an end of a balloon is cut off."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.tube_mesh import TORN_ROWS
from balloon_usd.solver.severed import Severed
from balloon_usd.solver.torn import OpenBubble, Tear

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.solver.latex.sculpture import LatexSculpture
    from balloon_usd.solver.severed import Stub

    Ints = NDArray[np.int64]

ON_START, ON_END = [0, 1, 1, 0], [3, 2, 2, 3]
"""Corners of a face that is gone, by those that it had, if it lies on its first side now or on its third."""


def tear(bubble: str, sculpture: LatexSculpture) -> None:
    """Tear a bubble in the middle: frames do not show what is gone of its wall."""
    body, faces = sculpture.faces(bubble)
    torn = Tear.of(sculpture.scene.bodies[body], faces)
    corners, half = sculpture.scene.bodies[body].quads[torn.faces], (TORN_ROWS + 1) // 2
    rims = corners[0][:, ON_START], corners[-1][:, ON_END]
    sides = np.concatenate([rims[0]] * half + [rims[1]] * (TORN_ROWS - half))
    sculpture.severed[bubble] = Severed(body - sculpture.bodies[0], torn)
    _take_away(sculpture, body, torn.faces.ravel(), sides, torn.rings[1:-1].ravel())


def cut_off(bubble: str, body: int, stub: Stub, sculpture: LatexSculpture) -> None:
    """Cut an end of a balloon off, with knot and lip if they are there: frames show a lid on its neck.

    `stub`: all of the body that lies beyond the neck.
    """
    quads = sculpture.scene.bodies[body].quads
    gone = np.flatnonzero(np.isin(quads, stub.vertices).any(axis=1))
    first, around = stub.neck.start, stub.neck.stop - stub.neck.start
    turn = np.arange(len(gone)) % around
    side = np.stack([turn, (turn + 1) % around], axis=1) + first
    sculpture.severed[bubble] = Severed(body - sculpture.bodies[0], stub)
    _take_away(sculpture, body, gone, side[:, [0, 1, 1, 0]], stub.vertices)


def _take_away(sculpture: LatexSculpture, body: int, faces: Ints, sides: Ints, vertices: Ints) -> None:
    """Take the rubber of some faces of a body away, (F,), and leave them without area on sides of others,
    (F, 4), so that nothing touches them; vertices that are gone with them, (V,), stay where they are.

    Bubbles of which they were hold no gas any more: nor does a knot that is cut off.
    """
    scene = sculpture.scene
    first = int(scene.vertex_start[body])
    gone = faces + int(scene.quad_start[body])
    quads = scene.quads.numpy()
    quads[gone] = sides + first
    scene.quads.assign(quads)
    for array in (scene.rubber_volume, scene.hourglass):
        values = array.numpy()
        values[gone] = 0.0
        array.assign(values)
    speed = scene.v.numpy()
    speed[vertices + first] = 0.0
    scene.v.assign(speed)
    sculpture.weigh_nothing(body, vertices)
    segment_of = scene.vertex_segment.numpy()
    for segment in np.unique(scene.quad_segment.numpy()[gone]).tolist():
        sculpture.hands.vent(segment, 0.0)
        sculpture.open_bubbles.append(OpenBubble(segment, np.flatnonzero(segment_of == segment)))
