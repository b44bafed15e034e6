"""Moves of the hands: every operation is made of these, and only these reach the solver.

Seen by the maker the balloons lie along x with the knot at the far end: forward is -x, up is +z, left is -y.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

Vector = tuple[float, float, float]

Pose = Literal["as made", "stand", "hang", "hold", "drop", "throw"]
"""How a finished figure is shown: where it was made, on the ground, on a thread, held upright as it is, or
let go or thrown above the ground.
"""

LET_GO: tuple[Pose, ...] = ("drop", "throw")
"""Poses in which hands let go of it above the ground."""

Front = Literal["forward", "back", "left", "right", "up", "down"]
"""A side of a figure, as it was made."""

FRONTS: dict[Front, Vector] = {
    "forward": (-1.0, 0.0, 0.0),
    "back": (1.0, 0.0, 0.0),
    "left": (0.0, -1.0, 0.0),
    "right": (0.0, 1.0, 0.0),
    "up": (0.0, 0.0, 1.0),
    "down": (0.0, 0.0, -1.0),
}
"""Directions of these sides. Figures are shown with their front to -x, where what is made first lies."""

Facing = Front | tuple[str, ...]
"""A side of a figure as it was made, or the names of bubbles that lie on it."""

POINTS: dict[str, Vector] = {
    "up": (0.0, 0.0, 1.0),
    "down": (0.0, 0.0, -1.0),
    "left": (0.0, -1.0, 0.0),
    "right": (0.0, 1.0, 0.0),
    # Along the balloon nothing can fold; these lean between up and the way named.
    "forward": (-math.sqrt(0.5), 0.0, math.sqrt(0.5)),
    "back": (math.sqrt(0.5), 0.0, math.sqrt(0.5)),
}
"""Directions as seen by the maker."""

ACROSS: dict[str, Vector] = {
    point: POINTS["up" if point in ("left", "right") else "left"] for point in POINTS
}
"""Where the first bubble of a chain comes to lie that points somewhere: left of the others, or above them."""

OTHER_SIDE: dict[str, Front] = {"left": "right", "right": "left"}
"""Sides that a mirror exchanges, as front, as top or where something points."""

TIPPED: dict[Front, Front] = {"forward": "down", "back": "up"}
"""Fronts of figures whose top one of these ends is, where a recipe does not say: what then faces -x."""


def mirror_image(direction: Vector) -> Vector:
    """Return a direction with left and right exchanged."""
    x, y, z = direction
    return x, -y, z


@dataclass(frozen=True)
class Move:
    """One move of the hands."""

    start: float
    """Time at which it begins, s."""
    seconds: float
    """Time that it takes, s; 0 for an instant."""
    step: int
    """Step of the recipe that it belongs to; -1 before the first."""
    text: str
    """What the hands do, for people."""

    @property
    def end(self) -> float:
        """Time at which it ends, s."""
        return self.start + self.seconds


PUSHING = 0.7
"""Share of a stroke in which the piston of a pump is pushed in; then it is drawn back."""


@dataclass(frozen=True)
class Inflate(Move):
    """Blow up a balloon with a pump, its knot held."""

    balloon: str = ""
    strokes: int | None = None
    """Of a hand pump; None for a steady flow."""


@dataclass(frozen=True)
class LetDown(Move):
    """Let air out of a balloon that was blown up farther than it will be, its knot held."""

    balloon: str = ""


@dataclass(frozen=True)
class BringInside(Move):
    """Bring what lies in a balloon on to where it will be blown up."""

    balloon: str = ""


@dataclass(frozen=True)
class Pop(Move):
    """Prick a bubble: its gas is gone at once."""

    bubble: str = ""


@dataclass(frozen=True)
class Cut(Move):
    """Cut an end of a balloon off, which is limp: it is gone."""

    bubble: str = ""


@dataclass(frozen=True)
class StretchTip(Move):
    """Stretch the end of the flat tail of what is left of a balloon, so that it gives way to the gas."""

    bubble: str = ""
    length: float = 0.0
    """Flat rubber that is stretched, m."""


@dataclass(frozen=True)
class Pinch(Move):
    """Close the neck at a ring between two fingers."""

    ring: int = 0


@dataclass(frozen=True)
class Halve(Move):
    """Close a neck in the middle of gas that is shut in already, whose two parts share it."""

    ring: int = 0


@dataclass(frozen=True)
class Spin(Move):
    """Turn the balloon beyond a closed ring about its own axis."""

    ring: int = 0
    turns: float = 0.0


@dataclass(frozen=True)
class Gather(Move):
    """Bring the first ring of a chain to its last, which is held, and lead what is between to a side."""

    corners: tuple[int, ...] = ()
    """Rings of the chain from the moving one to the held one."""
    cheeks: tuple[tuple[int, int], ...] = ()
    """Guide rings in the middle of sides that are pressed outwards, with the index of the side."""
    point: Vector = (0.0, 0.0, 1.0)
    """Unit direction to which the chain rises."""
    pulled: float = 0.0
    """How far a bubble is pulled out between its ends, m; 0 where the chain is turned across the balloon."""
    across: Vector = (0.0, -1.0, 0.0)
    """Unit direction, across the balloon, in which the first bubble of the chain lies in the end."""


@dataclass(frozen=True)
class Wrap(Gather):
    """Lay a row of bubbles back beside a chain, a neck of it where the hole will be, and close the chain."""

    bubble: str = ""
    """The bubble behind that neck."""
    led: tuple[int, ...] = ()
    """Rings of the row and of that bubble, away from the held ring of the chain."""
    row: int = 0
    """How many of these, the first ones, are of the row: the last of them is that of the neck."""
    tube: float = 0.0
    """How wide the chain is, m."""
    behind: float = 1.0
    """Side of the closed chain on which the row lies, along the balloon: 1 that of the tip, -1 the other."""

    @property
    def neck(self) -> int:
        """Ring of the neck round which the chain is closed."""
        return self.led[self.row - 1]


@dataclass(frozen=True)
class LeadIn(Move):
    """Lead a balloon in from where it lay, with all that is joined to it, until a ring of it is beside a ring
    of the figure, which is held still.
    """

    ring: int = 0
    to: int = 0
    rings: tuple[int, ...] = ()
    """Rings of the net that the figure is part of, so far as it is made; none where it is no net."""
    places: tuple[Vector, ...] = ()
    """Where they lie in the net, m."""
    toward: Vector = (0.0, 0.0, 0.0)
    """Where in the net, from the held ring, what comes in will lie, m."""


@dataclass(frozen=True)
class Bring(Move):
    """Bring a ring of one balloon to a ring of another, which is held."""

    ring: int = 0
    to: int = 0
    carried: bool = False
    """Whether hands lead what hangs on the ring along if it goes far; else it follows by its own rubber."""


@dataclass(frozen=True)
class SetNet(Move):
    """Lead all joints of a net, as far as it is made, to their places in space, and so bring a ring to
    another.
    """

    rings: tuple[int, ...] = ()
    """Rings of its joints; the last one is held where it is."""
    places: tuple[Vector, ...] = ()
    """Where they lie in the net, m."""
    sides: tuple[tuple[int, int], ...] = ()
    """Bubbles, by the indices of the rings at their ends."""
    moving: int | None = None
    """Ring that is brought to the last one; None where the net is done."""
    onward: Vector | None = None
    """Where the next joint of the last ring's balloon will lie, m: what is left of that balloon begins at
    this ring and shall stand off the net. None where nothing is left there.
    """


@dataclass(frozen=True)
class Curve(Move):
    """Lead the rings of a bubble onto a curve, held at the end on which more hangs."""

    rings: tuple[int, ...] = ()
    """From its start to its end, or to the flat tail."""
    point: Vector = (0.0, 0.0, 1.0)
    """Unit direction in which the end goes that is not held, of a coil along its axis."""
    flat: int = 0
    """How many of the last rings lie on the flat tail, which goes on straight."""
    again: bool = False
    """Whether it lies on another curve before."""


@dataclass(frozen=True)
class Bend(Curve):
    """Bend a bubble by leading its rings onto an arc."""

    angle: float = 0.0
    """Angle between the directions of its ends, radians."""


@dataclass(frozen=True)
class Curl(Curve):
    """Roll a bubble up into a coil, from the end that is not held."""

    turns: float = 0.0
    """Right-handed, left-handed below 0."""
    asked: float = 0.0
    """How many shall stay when hands let go."""
    rise: float = 0.0
    """How far it goes on along its axis with each turn, m."""
    growth: float = 0.0
    """How much farther from its axis each turn lies than the one within, m; 0 of a coil that goes on."""


@dataclass(frozen=True)
class Aim(Move):
    """Turn a bubble, with all that hangs on it, about the joint at which it hangs on the figure."""

    bubble: str = ""
    toward: Vector = (0.0, 0.0, 1.0)
    """Unit direction in which it points in the end, away from that joint."""
    spin: float = 0.0
    """How far it is turned about itself meanwhile, right-handed about that direction, rad."""


@dataclass(frozen=True)
class Tuck(Move):
    """Set a limb between two bubbles, or into the hole of one, which are spread meanwhile."""

    bubble: str = ""
    """One of the limb."""
    between: tuple[str, ...] = ()
    width: float = 0.0
    """How wide the bubble is, m."""
    tube: float = 0.0
    """How wide those are between which it is set, m."""
    point: Vector | None = None
    """Unit direction in which it points in the end; None for towards their middles."""


@dataclass(frozen=True)
class Press(Move):
    """Press a finger into a wall, hold it there, and take it away, while the other hand holds some rings."""

    balloon: str = ""
    along: float = 0.0
    """Place of the finger: unstressed distance from the knot, m."""
    point: Vector = (0.0, 0.0, -1.0)
    """Unit direction in which the finger moves."""
    force: float = 0.0
    """How hard it presses, N; 0 where depth is given."""
    depth: float = 0.0
    """How deep it presses, m; 0 where force is given."""
    holds: tuple[int, ...] = ()
    """Rings that the other hand holds."""
    flat: bool = False
    """Whether the palms of both hands press in place of a finger, each half as deep."""


@dataclass(frozen=True)
class PassThrough(Move):
    """Swing a bubble about its held end through a closed ring of others, which fingers spread meanwhile, and
    turn both back until it points where it shall.
    """

    bubble: str = ""
    base: int = 0
    """Ring of its held end, which lies in the ring of others."""
    led: tuple[int, ...] = ()
    """Its other rings, away from the base: the last is, or is next to, its other end."""
    row: int = 0
    """How many of these, the first ones, are of a row of bubbles between the base and it."""
    opening: tuple[int, ...] = ()
    """Rings of those that it passes, in order round them."""
    width: float = 0.0
    """How wide it is, m."""
    tube: float = 0.0
    """How wide those are that it passes, m."""
    beyond: float = 0.0
    """How far its other end swings beyond the plane of the ring, rad."""
    dip: float = 0.0
    """How far its middle is pressed beyond that plane, m, where its other end stays in it."""
    point: Vector | None = None
    """Unit direction in which it points in the end; None for where it pointed before."""

    @property
    def watched(self) -> int:
        """Ring of the bubble for which it is asked whether it has gone through: nearest its middle."""
        return self.led[self.row + (len(self.led) - self.row - 1) // 2]


@dataclass(frozen=True)
class Thread(PassThrough):
    """Bend what is left of a balloon round, and pull it through a closed ring of others."""

    flat: int = 0
    """How many of the last rings lie on the flat tail."""
    more: int = 0
    """How many of the last rings are of what is made later, behind the bubble."""

    @property
    def watched(self) -> int:
        """Ring for which it is asked whether it has gone through: nearest the middle of the bubble, or that
        of the round end of the tube where more is made of it, for short bubbles lie beside the ring.
        """
        return self.led[-1 - self.flat] if self.more else super().watched


@dataclass(frozen=True)
class WindRound(Move):
    """Wind bubbles that lie side by side round each other, by turning the joint at one end of all."""

    bubbles: tuple[str, ...] = ()
    strands: tuple[tuple[int, ...], ...] = ()
    """Rings of each strand, from the joint at one end of all to the place at the other."""
    turns: float = 0.0
    """Right-handed, left-handed below 0."""
    asked: float = 0.0
    """How many shall stay when hands let go, with those that were there before."""
    radius: float = 0.0
    """How far from the axis each strand lies once it is wound, m."""


@dataclass(frozen=True)
class Plait(Move):
    """Lay three bubbles that hang on one joint over each other in turns, and bring their ends together."""

    bubbles: tuple[str, ...] = ()
    strands: tuple[tuple[int, ...], ...] = ()
    """Rings of each strand, from the joint on which all hang."""
    crossings: int = 0
    width: float = 0.0
    """Of the widest of them, m."""


@dataclass(frozen=True)
class Invert(Move):
    """Press the knot of a balloon through its first bubble, whose wall is turned inside, to its other end."""

    knot: int = 0
    """Ring of the knot."""
    to: int = 0
    """Ring at the other end, which is held."""


@dataclass(frozen=True)
class Link(Move):
    """Move two balloons by their knots."""

    knot: int = 0
    """Ring of the knot of the balloon whose wall is turned inside."""
    neck: int = 0
    """Ring at the other end of its first bubble."""
    other: int = 0
    """Ring of the other balloon's knot."""
    moved: int = 0
    """Which of both knots was led in: its balloon is moved, and the other one held."""


@dataclass(frozen=True)
class FaceKnot(Link):
    """Turn one balloon, with all that hangs on it, and bring it before the knot of the other, so that both
    lie in one line, knot to knot.
    """


@dataclass(frozen=True)
class PressIn(Link):
    """Press the end of one balloon into the first bubble of the other, behind its knot."""


@dataclass(frozen=True)
class Weld(Move):
    """Twist joints that lie together into one."""

    rings: tuple[int, ...] = ()
    turns: float = 0.0


@dataclass(frozen=True)
class TurnFold(Move):
    """Turn what is folded between two joints about the one joint that they have become."""

    rings: tuple[int, ...] = ()
    turns: float = 0.0


@dataclass(frozen=True)
class LetGo(Move):
    """Take the hands away."""

    for_good: bool = False
    """Whether nothing is made any more: until then makers hold by hand what would come undone."""


@dataclass(frozen=True)
class Loosen(Move):
    """Loosen the grip of all hands until they hold nothing any more."""


@dataclass(frozen=True)
class Hold(Move):
    """Put the finished sculpture down and look at it."""


@dataclass(frozen=True)
class Straighten(Move):
    """Set the finished figure straight: twins come to be mirror images of each other, and what lies between
    them its own.
    """

    twins: tuple[tuple[str, str], ...] = ()
    """One on its left and one on its right each."""
    between: tuple[str, ...] = ()
    """Other bubbles, which are set straight if they nearly are."""


@dataclass(frozen=True)
class Level(Move):
    """Bend the legs of the finished figure until all its feet stand on one plane."""

    front: Facing = "forward"
    """The side that will be turned to face -x."""
    top: Facing | None = None
    """The side that will be turned up; None for as little turned as needed."""


@dataclass(frozen=True)
class SetDown(Move):
    """Carry the finished figure as it is to where it stays."""

    pose: Pose = "stand"
    front: Facing = "forward"
    """The side that is turned to face -x."""
    top: Facing | None = None
    """The side that is turned up; None for as little turned as needed."""
    height: float = 0.0
    """How far above the ground its lowest point comes, m."""
    gravity: float = 0.0
    """Under which it has to stand, m/s2; 0 where it floats."""


@dataclass(frozen=True)
class Sink(Move):
    """Let what lies in other balloons sink to what will be their lowest place once the figure is posed."""

    pose: SetDown | None = None
    """How that will be done; None where it stays as it was made."""


@dataclass(frozen=True)
class Fall(Move):
    """Let the finished figure fall as it is, as a rigid body of its true weight."""

    gravity: float = 0.0
    """m/s2"""
    velocity: Vector = (0.0, 0.0, 0.0)
    """With which it is thrown, m/s."""
    spin: Vector = (0.0, 0.0, 0.0)
    """With which hands let go of it, rad/s."""
    ground: bool = True
    """Whether the plane z = 0 is there to fall on."""


@dataclass(frozen=True)
class Choreography:
    """All moves of a sculpture in time."""

    moves: tuple[Move, ...]
    seconds: float
    """Length of the animation, s."""
    mirrored: bool = False
    """Whether hands make the mirror image of what the recipe says, which frames show mirrored back."""

    @property
    def let_go(self) -> float:
        """When the hands let go for good, s: at once, and as the last of what they make."""
        return next(move.start for move in self.moves if isinstance(move, LetGo) and move.for_good)

    @property
    def taken_up(self) -> float:
        """When hands take up again what they have let go of, or let it fall, s; the end if they do not."""
        after = (move.start for move in self.moves if isinstance(move, (Straighten, Level, SetDown, Fall)))
        return next(after, self.seconds)
