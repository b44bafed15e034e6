"""Rubber that is gone: a bubble tears in the middle, or an end of a balloon is cut off."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from balloon_usd.balloon.tube_mesh import TORN_ROWS
from balloon_usd.solver.severed import Severed
from balloon_usd.solver.torn import OpenBubble, Tear

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.solver.latex.scene import LatexScene
    from balloon_usd.solver.latex.sculpture import LatexSculpture
    from balloon_usd.solver.severed import Stub

    Ints = NDArray[np.int64]

ON_START, ON_END = [0, 1, 1, 0], [3, 2, 2, 3]
"""Corners of a face that is gone, by those that it had, if it lies on its first side now or on its third."""


def tear(bubble: str, segment: int, sculpture: LatexSculpture) -> None:
    """Tear a bubble in the middle: frames do not show what is gone of its wall.

    `segment`: that of the bubble, in the scene.
    """
    scene = sculpture.scene
    body, faces = sculpture.faces(bubble)
    torn = Tear.of(scene.bodies[body], faces)
    gone = torn.faces + int(scene.quad_start[body])
    quads, half = scene.quads.numpy(), (TORN_ROWS + 1) // 2
    rims = quads[gone[0]][:, ON_START], quads[gone[-1]][:, ON_END]
    sides = np.stack([rims[0]] * half + [rims[1]] * (TORN_ROWS - half))
    vertices = torn.rings[1:-1].ravel()
    take_away(scene, gone.ravel(), sides.reshape(-1, 4), vertices + int(scene.vertex_start[body]))
    sculpture.weigh_nothing(body, vertices)
    sculpture.severed[bubble] = Severed(body - sculpture.bodies[0], torn)
    _open(segment, sculpture)


def cut_off(bubble: str, body: int, stub: Stub, sculpture: LatexSculpture) -> None:
    """Cut an end of a balloon off, with knot and lip if they are there: frames show a lid on its neck.

    `stub`: all of the body that lies beyond the neck.
    """
    scene = sculpture.scene
    beyond = np.zeros(len(scene.bodies[body].points), dtype=bool)
    beyond[stub.vertices] = True
    gone = np.flatnonzero(beyond[scene.bodies[body].quads].any(axis=1))
    segments = np.unique(scene.quad_segment.numpy()[gone + int(scene.quad_start[body])])
    first, around = stub.neck.start, stub.neck.stop - stub.neck.start
    turn = np.arange(len(gone)) % around
    side = np.stack([turn, (turn + 1) % around], axis=1) + first + int(scene.vertex_start[body])
    vertices = stub.vertices + int(scene.vertex_start[body])
    take_away(scene, gone + int(scene.quad_start[body]), side[:, [0, 1, 1, 0]], vertices)
    sculpture.weigh_nothing(body, stub.vertices)
    sculpture.severed[bubble] = Severed(body - sculpture.bodies[0], stub)
    for segment in segments.tolist():
        # The knot had gas of its own.
        sculpture.hands.vent(segment, 0.0)
        _open(segment, sculpture)


def take_away(scene: LatexScene, faces: Ints, sides: Ints, vertices: Ints) -> None:
    """Take the rubber of some faces away, (F,), and leave them without area on sides of others, (F, 4), so
    that nothing touches them; vertices that are gone with them, (V,), stay where they are.
    """
    quads = scene.quads.numpy()
    quads[faces] = sides
    scene.quads.assign(quads)
    for array in (scene.rubber_volume, scene.hourglass):
        values = array.numpy()
        values[faces] = 0.0
        array.assign(values)
    speed = scene.v.numpy()
    speed[vertices] = 0.0
    scene.v.assign(speed)


def _open(segment: int, sculpture: LatexSculpture) -> None:
    own = np.flatnonzero(sculpture.scene.vertex_segment.numpy() == segment)
    sculpture.open_bubbles.append(OpenBubble(segment, own))
