"""Motions alone: the goals that each sets for the hands, on sculptures in which nothing is simulated."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from balloon_usd.balloon.detail import detail_named
from balloon_usd.operations import moves
from balloon_usd.plan import plan as plan_of
from balloon_usd.plan.meshing import mesh_of
from balloon_usd.recipe import Recipe
from balloon_usd.solver.kernels.physics.joints import GRIP_MODE, LEAD_MODE
from balloon_usd.solver.kosaka.motions.draw import CLOSED_EARLY, Draw
from balloon_usd.solver.kosaka.motions.table import KOSAKA_MOTIONS
from balloon_usd.solver.latex.motions.ball import amount_of
from balloon_usd.solver.latex.motions.closing_neck import SHUT
from balloon_usd.solver.latex.motions.loosen import Loosen
from balloon_usd.solver.latex.motions.pinch import Pinch
from balloon_usd.solver.latex.motions.spin import Spin
from balloon_usd.solver.latex.motions.table import LATEX_MOTIONS
from balloon_usd.solver.motions.bring import Bring
from balloon_usd.solver.motions.gather import Gather
from balloon_usd.solver.motions.motion import Motion
from balloon_usd.solver.motions.press import press_profile
from balloon_usd.solver.motions.wait import Wait
from balloon_usd.solver.performer import Performer
from balloon_usd.solver.sculpture import ALONG, ComingFrame
from balloon_usd.solver.simulation import NOMINAL_RATE, model_named

RECIPE = """
format: 1
name: three
units: cm
balloons:
  red: {{size: 260, {long}}}
  blue: {{size: 260, {long}}}
  green: {{size: 260, {long}}}
steps:
  - {{bubbles: {{nose: 4, left: 6, right: 6}}, balloon: red}}
  - {{bubbles: {{arm: 4}}, balloon: blue}}
  - {{bubbles: {{hand: 4}}, balloon: green}}
  - {{rest: red_rest, balloon: red}}
  - {{rest: blue_rest, balloon: blue}}
  - {{rest: green_rest, balloon: green}}
physics: {{model: {model}}}
"""
LONG = {"latex": "length: 15, tail: 5", "kosaka": "capsule: 30"}
BESIDE = {"red": 0.0, "blue": 0.1, "green": 0.2}
"""How far to the side each balloon lies, m."""
DONE = {"start": 0.0, "seconds": 2.0, "step": 0, "text": "moved"}


@cache
def plan_in(model):
    return plan_of(Recipe.parse(RECIPE.format(model=model, long=LONG[model])))


class Room:
    """Three straight balloons side by side, whose rings lie where they are said to."""

    def __init__(self, model="latex"):
        self.plan = plan_in(model)
        meshes = [mesh_of(strip, detail_named("draft")) for strip in self.plan.strips.values()]
        self.model = model_named(model)([self.plan], [meshes], NOMINAL_RATE, 12, "cpu")
        self.sculpture, self.hands = self.model.performers[0].sculpture, self.model.hands
        self.hands.volume = np.ones(int(self.model.scene.segment_start[-1]), dtype=np.float32)
        self.middle = np.zeros((len(self.hands.mode), 3), dtype=np.float32)
        for ring, joint in zip(self.plan.table.rings, self.sculpture.joints, strict=True):
            self.middle[joint] = 4.0 * ring.along, BESIDE[ring.balloon], 0.0
        self.sculpture.frame = ComingFrame(0.0, 1.0 / 24.0, self.middle)

    def ring(self, name):
        return next(k for k, ring in enumerate(self.plan.table.rings) if ring.name == name)

    def joint(self, name):
        return self.sculpture.joints[self.ring(name)]

    def turning(self, balloon):
        """Which vertices of a balloon turn in the coming frame."""
        self.hands.spins.settle()
        first = self.model.scene.vertex_start[(body := self.sculpture.body[balloon])]
        return self.hands.spins.of_vertex[first : self.model.scene.vertex_start[body + 1]] > 0

    def weld(self, *names):
        self.hands.weld(tuple(self.joint(name) for name in names))

    def moved(self, name):
        """How far a ring is brought from where it was, m."""
        self.hands.settle()
        joint = self.joint(name)
        return self.hands.goal[joint].astype(float) - self.middle[joint]

    def gather(self):
        """A chain of two bubbles that is closed."""
        corners = tuple(self.ring(f"{name}.end") for name in ("nose", "left", "right"))
        return Gather(moves.Gather(**DONE, corners=corners), self.sculpture)

    def lead_in(self, name, to, motions=LATEX_MOTIONS):
        return motions[moves.LeadIn](
            moves.LeadIn(**DONE, ring=self.ring(name), to=self.ring(to)), self.sculpture
        )

    def bring(self, name, to, *, carried=False):
        move = moves.Bring(**DONE, ring=self.ring(name), to=self.ring(to), carried=carried)
        return Bring(move, self.sculpture)


def kinds_of_moves():
    kinds = {kind for kind in vars(moves).values() if isinstance(kind, type) and issubclass(kind, moves.Move)}
    # What bends and curls share, and what links do, is no move by itself.
    return kinds - {moves.Curve, moves.Link}


@pytest.mark.parametrize("motions", [LATEX_MOTIONS, KOSAKA_MOTIONS], ids=["latex", "kosaka"])
def test_every_move_of_a_plan_has_a_motion(motions):
    assert set(motions) == kinds_of_moves()
    assert len(motions) > 9


def test_hands_wait_while_nothing_moves_and_in_model_kosaka_where_nothing_is_blown_up_wound_popped_bent_or_falls():
    assert [kind for kind, motion in LATEX_MOTIONS.items() if motion is Wait] == [moves.Move]
    waits = {kind for kind, motion in KOSAKA_MOTIONS.items() if motion is Wait}
    unmoved = {
        moves.LetDown,
        moves.BringInside,
        moves.Sink,
        moves.Halve,
        moves.Inflate,
        moves.Spin,
        moves.TurnFold,
        moves.Loosen,
        moves.Hold,
        moves.Fall,
        moves.Pop,
        moves.Cut,
        moves.StretchTip,
        moves.Curl,
        moves.Aim,
        moves.Tuck,
        moves.PassThrough,
        moves.Thread,
        moves.WindRound,
        moves.Plait,
        moves.Wrap,
        moves.Invert,
        moves.FaceKnot,
        moves.PressIn,
        moves.Straighten,
        moves.Level,
    }
    assert waits == {moves.Move, *unmoved}


def test_a_chain_begins_to_close_where_it_is():
    room = Room()
    room.gather().advance(0.0)
    for name in ("nose.end", "left.end", "right.end", "red.knot"):
        assert room.moved(name) == pytest.approx(np.zeros(3), abs=1e-5)


def test_a_closed_chain_has_its_ends_together_and_what_hangs_on_the_first_went_along():
    room = Room()
    room.gather().advance(1.0)
    apart = (
        room.moved("nose.end") + room.middle[room.joint("nose.end")] - room.middle[room.joint("right.end")]
    )
    assert np.linalg.norm(apart) < 3.0 * room.hands.neck[room.joint("right.end")]
    assert room.moved("red.knot") == pytest.approx(room.moved("nose.end"), abs=1e-6)
    assert room.moved("right.end") == pytest.approx(np.zeros(3), abs=1e-6)


def test_what_is_welded_to_the_moving_end_of_a_chain_is_carried_with_all_that_hangs_on_it():
    room = Room()
    room.weld("nose.end", "arm.end")
    room.weld("blue.knot", "hand.end")
    room.gather().advance(0.7)
    assert np.linalg.norm(room.moved("nose.end")) > 0.02
    for name in ("arm.end", "blue.knot", "blue_rest.1", "green.knot", "hand.end", "green_rest.1"):
        assert room.hands.mode[room.joint(name)] == LEAD_MODE
        assert room.moved(name) == pytest.approx(room.moved("nose.end"), abs=1e-6)


def test_what_is_welded_inside_a_chain_is_carried_by_its_corner():
    room = Room()
    room.weld("left.end", "arm.end")
    room.gather().advance(0.7)
    assert room.moved("left.end")[2] > 0.02
    for name in ("arm.end", "blue.knot", "blue_rest.0"):
        assert room.moved(name) == pytest.approx(room.moved("left.end"), abs=1e-6)


def test_what_is_welded_to_the_held_end_of_a_chain_is_kept_where_it_is():
    room = Room()
    room.weld("right.end", "arm.end")
    room.gather().advance(0.7)
    for name in ("arm.end", "blue.knot", "blue_rest.1", "red_rest.1"):
        assert room.hands.mode[room.joint(name)] == LEAD_MODE
        assert room.moved(name) == pytest.approx(np.zeros(3), abs=1e-6)


def test_a_balloon_that_hangs_on_nothing_is_left_alone():
    room = Room()
    room.gather().advance(0.7)
    assert not room.hands.mode[[room.joint("arm.end"), room.joint("blue_rest.1")]].any()


def test_a_joint_is_brought_to_that_of_another_balloon_and_all_else_follows_by_itself():
    room = Room()
    room.bring("arm.end", "nose.end").advance(1.0)
    gap = 2.0 * room.hands.neck[room.joint("nose.end")]
    reached = room.middle[room.joint("arm.end")] + room.moved("arm.end")
    assert np.linalg.norm(reached - room.middle[room.joint("nose.end")]) == pytest.approx(gap, rel=1e-4)
    assert room.moved("nose.end") == pytest.approx(np.zeros(3), abs=1e-6)
    assert all(room.hands.mode[room.joint(name)] == GRIP_MODE for name in ("arm.end", "nose.end"))
    others = ("blue.knot", "blue_rest.0", "blue_rest.1", "red.knot", "left.end", "red_rest.1")
    assert not room.hands.mode[[room.joint(name) for name in others]].any()


@pytest.mark.parametrize("model", ["latex", "kosaka"])
def test_a_balloon_that_is_carried_far_to_a_net_comes_along_and_the_net_stays(model):
    room = Room(model)
    room.weld("nose.end", "hand.end")
    for name in ("blue.knot", "arm.end", "blue_rest.0", "blue_rest.1"):
        room.middle[room.joint(name)] += 0.0, 2.0, 0.0
    room.bring("blue.knot", "nose.end", carried=True).advance(0.6)
    assert np.linalg.norm(room.moved("blue.knot")) > 0.02
    for name in ("arm.end", "blue_rest.0", "blue_rest.1"):
        assert room.moved(name) == pytest.approx(room.moved("blue.knot"), abs=1e-6)
    for name in ("nose.end", "red.knot", "hand.end", "green_rest.1"):
        assert room.moved(name) == pytest.approx(np.zeros(3), abs=1e-6)


def test_a_balloon_that_is_brought_over_a_short_way_follows_by_itself():
    room = Room()
    room.bring("blue.knot", "red.knot", carried=True).advance(0.6)
    assert np.linalg.norm(room.moved("blue.knot")) > 0.02
    assert not room.hands.mode[[room.joint(name) for name in ("arm.end", "blue_rest.1", "nose.end")]].any()


def away_from_each_other(model="latex"):
    """Balloons 0.1 m apart, now 0.5 m."""
    room = Room(model)
    room.middle[:, 1] *= 5.0
    return room


def test_a_balloon_is_led_in_as_it_is_with_what_is_joined_to_it_while_hands_hold_the_figure():
    room = away_from_each_other()
    room.weld("arm.end", "hand.end")
    leading = room.lead_in("blue.knot", "nose.end")
    leading.advance(0.5)
    assert room.turning("blue").all()
    assert room.turning("green").all()
    assert not room.turning("red").any()
    for name in ("red.knot", "nose.end", "left.end", "red_rest.1"):
        assert room.hands.mode[room.joint(name)] in (GRIP_MODE, LEAD_MODE)
        assert room.moved(name) == pytest.approx(np.zeros(3), abs=1e-6)


def test_a_balloon_of_model_kosaka_is_led_in_by_its_closed_joints_alone():
    room = away_from_each_other("kosaka")
    room.hands.radius_goal[room.joint("blue.knot")] = 0.01
    room.lead_in("arm.end", "nose.end", KOSAKA_MOTIONS).advance(0.999)
    beside = room.moved("arm.end") + room.middle[room.joint("arm.end")] - room.middle[room.joint("nose.end")]
    assert np.linalg.norm(beside) == pytest.approx(0.12, abs=1e-3)
    assert room.moved("blue.knot") == pytest.approx(room.moved("arm.end"), abs=1e-6)
    assert not room.hands.mode[room.joint("blue_rest.1")]


@pytest.mark.parametrize(("model", "motions"), [("latex", LATEX_MOTIONS), ("kosaka", KOSAKA_MOTIONS)])
def test_all_but_the_two_joints_give_way_once_a_balloon_is_led_in(model, motions):
    room = away_from_each_other(model)
    room.lead_in("arm.end", "nose.end", motions).advance(1.0)
    held = {room.joint("nose.end")} | ({room.joint("arm.end")} if model == "kosaka" else set())
    assert set(np.flatnonzero(room.hands.mode)) == held


@pytest.mark.parametrize(("model", "motions"), [("latex", LATEX_MOTIONS), ("kosaka", KOSAKA_MOTIONS)])
def test_a_net_that_is_set_has_its_shape_and_what_is_left_of_its_balloon_lies_straight(model, motions):
    room = Room(model)
    room.weld("left.end", "arm.end")
    names = ("red.knot", "nose.end", "left.end", "right.end")
    places = ((0.0, 0.0, 0.0), (0.1, 0.0, 0.0), (0.0, 0.1, 0.0), (0.0, 0.0, 0.1))
    room.middle[room.joint("red_rest.1")] += 0.0, 0.05, 0.02
    rings = tuple(map(room.ring, names))
    sides = ((0, 1), (1, 2), (2, 3))
    how = {"moving": rings[0], "onward": (0.2, 0.0, 0.1)}
    move = moves.SetNet(**DONE, rings=rings, places=places, sides=sides, **how)
    setting = motions[moves.SetNet](move, room.sculpture)
    setting.advance(1.0)
    reached = room.hands.goal[[room.joint(name) for name in names]]
    assert np.linalg.norm(np.diff(reached[1:], axis=0), axis=1) == pytest.approx(0.1 * 2.0**0.5, abs=1e-6)
    assert room.moved("arm.end") == pytest.approx(room.moved("left.end"), abs=1e-6)
    rest = room.hands.goal[room.joint("red_rest.1")] - room.hands.goal[room.joint("right.end")]
    assert rest[0] > 0.0
    assert rest[1:] == pytest.approx(np.zeros(2), abs=1e-6)
    assert not room.hands.mode[room.joint("hand.end")]


@pytest.mark.parametrize(("model", "motions"), [("latex", LATEX_MOTIONS), ("kosaka", KOSAKA_MOTIONS)])
def test_a_bent_bubble_takes_a_balloon_along_that_hangs_on_its_lighter_end(model, motions):
    room = Room(model)
    room.weld("red.knot", "arm.end")
    room.weld("right.end", "hand.end")
    rings = tuple(room.ring(name) for name in ("nose.end", "left.0", "left.end"))
    bend = motions[moves.Bend](moves.Bend(**DONE, rings=rings, angle=1.5), room.sculpture)
    bend.advance(0.9)
    assert room.moved("nose.end")[2] > 0.01
    for name in ("red.knot", "arm.end", "blue.knot", "blue_rest.1"):
        assert room.moved(name) == pytest.approx(room.moved("nose.end"), abs=1e-6)
    assert room.moved("red_rest.1") == pytest.approx(np.zeros(3), abs=1e-6)


def bend_fully(room, point, *names, flat=0):
    """Bend the bubble that has these rings by 80 degrees."""
    rings = tuple(room.ring(name) for name in names)
    move = moves.Bend(**DONE, rings=rings, angle=np.radians(80.0), point=moves.POINTS[point], flat=flat)
    bend = LATEX_MOTIONS[moves.Bend](move, room.sculpture)
    bend.set_bend = lambda _: None
    bend.advance(1.0)


def test_a_bubble_that_is_bent_again_is_led_from_where_it_lies():
    room = Room()
    rings = tuple(room.ring(name) for name in ("right.end", "red_rest.0", "red_rest.1"))
    room.middle[[room.joint(name) for name in ("red_rest.0", "red_rest.1")]] += [0.0, 0.01, 0.03]
    move = moves.Bend(**DONE, rings=rings, angle=1.0, again=True)
    bend = LATEX_MOTIONS[moves.Bend](move, room.sculpture)
    bend.advance(0.0)
    for name in ("right.end", "red_rest.0", "red_rest.1"):
        assert room.moved(name) == pytest.approx(np.zeros(3), abs=1e-6)


@pytest.mark.parametrize("point", ["up", "down", "left", "right"])
@pytest.mark.parametrize(
    ("rings", "goes", "stays"),
    [
        (("red.knot", "nose.0", "nose.end"), "red.knot", "red_rest.1"),
        (("nose.end", "left.0", "left.end"), "red.knot", "red_rest.1"),
        (("right.end", "red_rest.0", "red_rest.1"), "red_rest.1", "red.knot"),
    ],
    ids=["first", "middle", "last"],
)
def test_the_lighter_side_of_a_bent_bubble_goes_to_the_point_and_the_rest_of_the_figure_stays(
    point, rings, goes, stays
):
    room = Room()
    bend_fully(room, point, *rings)
    assert room.moved(goes) @ moves.POINTS[point] > 0.02
    assert room.moved(stays) == pytest.approx(np.zeros(3), abs=1e-6)


def test_the_flat_tail_of_a_bent_rest_goes_on_in_the_direction_of_its_front():
    room = Room()
    bend_fully(room, "up", "right.end", "red_rest.0", "red_rest.1", flat=1)
    places = [
        room.middle[room.joint(name)] + room.moved(name) for name in ("right.end", "red_rest.0", "red_rest.1")
    ]
    angles = [np.degrees(np.arctan2(side[2], side[0])) for side in np.diff(places, axis=0)]
    assert angles == pytest.approx([40.0, 80.0], abs=0.1)


def test_hands_hold_a_rest_that_is_bent_up_to_its_front_and_one_that_is_not_at_two_places():
    text = RECIPE.format(model="latex", long="length: 18, tail: 5")
    bends = text.replace("physics:", "  - {bend: {red_rest: 60}, point: up}\nphysics:")
    table, straight = plan_of(Recipe.parse(bends)).table, plan_of(Recipe.parse(text)).table
    flat = [table.rings[k].flat for k in table.guides("red_rest")]
    assert flat == [False] * (len(flat) - 1) + [True]
    assert len(flat) >= 3
    assert len(straight.guides("red_rest")) == len(table.guides("blue_rest")) == 2


def test_a_pinched_neck_closes_and_all_that_hangs_on_its_knots_side_is_steadied():
    room = Room()
    room.weld("nose.end", "arm.end")
    joint = room.joint("left.end")
    pinch = Pinch(moves.Pinch(**DONE, ring=room.ring("left.end")), room.sculpture)
    radii = []
    for share in (0.0, 0.5, 1.0):
        pinch.advance(share)
        radii.append(float(room.hands.radius_goal[joint]))
    assert radii[0] > radii[1] > radii[2] == pytest.approx(room.hands.neck[joint])
    assert room.hands.passage_goal[joint] == pytest.approx(0.0, abs=1e-12)
    for name in ("nose.end", "red.knot", "arm.end", "blue.knot"):
        assert room.hands.mode[room.joint(name)] == LEAD_MODE
        assert room.hands.free[room.joint(name)] == pytest.approx(ALONG)
    assert not room.hands.mode[room.joint("right.end")]


def pinched(room):
    """Fingers on the neck of a bubble, its joint, the segment before it, and what gas it is to keep."""
    room.hands.passage[room.joint("nose.end")] = 0.0
    pinch = Pinch(moves.Pinch(**DONE, ring=room.ring("left.end")), room.sculpture)
    joint = room.joint("left.end")
    (bubble,) = [b for b in room.plan.bubbles if b.name == "left"]
    before = room.hands.beside[joint, 0]
    room.hands.amount[:before] = 0.0
    return pinch, joint, before, amount_of(room.sculpture, bubble)


@pytest.mark.parametrize(("left", "shut"), [(1.5, False), (0.95, False), (0.5, True)])
def test_fingers_shut_a_neck_early_once_its_bubble_has_less_gas_than_it_has_to_keep(left, shut):
    room = Room()
    pinch, joint, before, enough = pinched(room)
    room.hands.amount[before] = enough
    pinch.advance(0.2)
    assert room.hands.passage[joint] > 0.0
    room.hands.amount[before] = left * enough
    pinch.advance(0.4)
    assert (room.hands.passage[joint] == room.hands.passage_goal[joint] == 0.0) == shut
    pressed_in = -room.hands.neck_flow[joint] / 24.0
    # A quarter of the time that was left has passed.
    assert pressed_in == pytest.approx(0.25 * (1.0 - left) * enough if shut else 0.0)


@pytest.mark.parametrize("had", [1.3, 1.0, 0.95])
def test_fingers_press_gas_through_a_shut_neck_until_its_bubble_has_what_it_is_to_keep(had):
    room = Room()
    pinch, joint, before, enough = pinched(room)
    gas = had * enough
    for share in (0.2, 0.6, 0.8, 0.9, 1.0):
        room.hands.amount[before] = gas
        pinch.advance(share)
        assert (room.hands.passage_goal[joint] == 0.0) == (share > SHUT)
        gas -= room.hands.neck_flow[joint] / 24.0
        assert (gas == pytest.approx(had * enough)) == (share <= SHUT or had == 1.0)
    assert gas == pytest.approx(enough)


def test_a_pump_starts_and_stops_gently_and_is_taken_off_in_the_end():
    room = Room()
    body, hands = room.sculpture.body["red"], room.hands
    inflate = moves.Inflate(**{**DONE, "seconds": 7.0}, balloon="red")
    pump = LATEX_MOTIONS[moves.Inflate](inflate, room.sculpture)
    assert (hands.drag[body], hands.softening[body]) == (0.0, 0.0)
    flows = []
    for share in (0.0, 0.1, 0.5, 0.9, 1.0):
        pump.advance(share)
        flows.append(float(hands.pump_flow[body]))
    assert flows == pytest.approx([0.0, 0.5 * flows[2], flows[2], 0.5 * flows[2], 0.0], rel=1e-5)
    assert hands.drag[body] > 0.0 < hands.softening[body]
    assert room.sculpture.inflated_at == {body: room.sculpture.frame.end}


def test_a_spin_winds_the_neck_by_its_turns_in_frames_of_any_length():
    room = Room()
    ring = room.ring("nose.end")
    move = moves.Spin(**DONE, ring=ring, turns=3.0)
    room.sculpture.torsion.pinch(ring, 0.01)
    spin = Spin(move, room.sculpture)
    for begin, end in pairwise((-0.1, 0.3, 1.2, 2.5)):
        room.sculpture.frame = ComingFrame(begin, end, room.middle)
        spin.advance(min(1.0, end / move.seconds))
    assert room.sculpture.torsion.joints[ring].turns == pytest.approx(3.0)
    assert room.turning("red").any()
    assert not room.turning("blue").any()
    assert not room.turning("green").any()
    room.hands.spins.stop()
    assert not room.turning("red").any()


def spin_beyond(room, name):
    """Turn what lies beyond a ring."""
    ring = room.ring(name)
    room.sculpture.torsion.pinch(ring, 0.01)
    Spin(moves.Spin(**DONE, ring=ring, turns=3.0), room.sculpture).advance(0.5)


def test_a_spin_turns_its_balloon_beyond_the_ring_and_no_other():
    room = Room()
    spin_beyond(room, "nose.end")
    ring = room.plan.table.rings[room.ring("nose.end")]
    along = room.model.scene.bodies[room.sculpture.body["red"]].along
    assert (room.turning("red") == (along > ring.along + 1e-6)).all()
    assert not room.turning("blue").any()


def test_a_spin_turns_a_balloon_that_hangs_beyond_the_ring():
    room, alone = Room(), Room()
    room.weld("left.end", "blue.knot")
    room.weld("arm.end", "green.knot")
    spin_beyond(room, "nose.end")
    spin_beyond(alone, "nose.end")
    assert room.turning("blue").all()
    assert room.turning("green").all()
    assert (room.turning("red") == alone.turning("red")).all()
    # About the axis of its own balloon, whatever hangs on it.
    assert room.hands.spins.rows.tobytes() == alone.hands.spins.rows.tobytes()


@pytest.mark.parametrize("name", ["nose.end", "red.knot"])
def test_a_spin_leaves_a_balloon_that_hangs_on_its_ring_or_before_it(name):
    room = Room()
    room.weld(name, "blue.knot")
    spin_beyond(room, "nose.end")
    assert not room.turning("blue").any()


def test_a_spin_leaves_a_balloon_that_is_tied_on_both_sides_of_its_ring():
    room = Room()
    room.weld("left.end", "arm.end")
    room.weld("red.knot", "blue_rest.0")
    spin_beyond(room, "nose.end")
    assert room.turning("red").any()
    assert not room.turning("blue").any()


def test_a_ring_of_a_net_is_drawn_together_before_its_time_is_over():
    room = Room("kosaka")
    joint = room.joint("nose.end")
    draw = Draw(moves.Pinch(**DONE, ring=room.ring("nose.end")), room.sculpture)
    draw.advance(0.5 * CLOSED_EARLY)
    assert room.hands.radius_goal[joint] > room.hands.neck[joint]
    draw.advance(CLOSED_EARLY)
    assert room.hands.radius_goal[joint] == pytest.approx(room.hands.neck[joint])


def test_two_fingers_on_two_balloons_each_press_as_far_as_their_own_time_tells():
    room = Room()
    first, second = (
        LATEX_MOTIONS[moves.Press](moves.Press(**DONE, balloon=name, along=0.02, depth=0.01), room.sculpture)
        for name in ("red", "blue")
    )
    first.advance(0.2)
    first.advance(0.5)
    second.advance(0.2)
    deeper = (room.hands.fingers["start"] - room.hands.fingers["end"])[:2, 2]
    later, now = press_profile(0.5), press_profile(0.2)
    assert later > now > 0.0
    assert deeper == pytest.approx([0.01 * (later - now), 0.01 * now], abs=1e-6)


def test_a_weld_joins_and_letting_go_frees_all_rings():
    room = Room()
    names = ("nose.end", "arm.end")
    LATEX_MOTIONS[moves.Weld](moves.Weld(**DONE, rings=tuple(map(room.ring, names))), room.sculpture)
    assert room.hands.welds == [tuple(sorted(map(room.joint, names)))]
    room.gather()
    assert room.hands.mode.any()
    LATEX_MOTIONS[moves.LetGo](moves.LetGo(**DONE), room.sculpture)
    assert not room.hands.mode.any()


class Told(Motion):
    """A motion that tells what it is told."""

    def __init__(self, move, sculpture):
        self.told = sculpture.told
        self.text = move.text
        self.told.append((self.text, "begins"))

    @property
    def ended(self):
        return self.text != "lasting" or len(self.told) > 10

    def advance(self, share):
        self.told.append((self.text, round(share, 3)))


class Stub:
    """A sculpture of which only moves are known."""

    unwinding, undone = None, ()

    def __init__(self, *timeline):
        self.told = []
        self.plan = self.choreography = self.hands = self
        self.moves = tuple(moves.Move(start, seconds, 0, text) for start, seconds, text in timeline)

    def settle(self):
        self.told.append("settled")

    def take_up(self):
        self.told.append("taken up")

    def look_after(self, end, *, begun):
        if begun:
            self.told.append("looked after")


def performed(*timeline, frames=3):
    stub = Stub(*timeline)
    performer = Performer(stub, {moves.Move: Told})
    for frame in range(frames):
        performer.act(ComingFrame(float(frame), frame + 1.0, None))
        stub.told.append(performer.status.doing)
    return stub.told


def test_moves_begin_one_after_another_each_where_others_have_brought_the_rings():
    assert performed((0.0, 2.5, "fold"), (2.5, 0.0, "weld"), (2.5, 1.0, "rest")) == [
        *("taken up", "settled", ("fold", "begins"), ("fold", 0.4), "looked after", "fold"),
        *(("fold", 0.8), "fold"),
        ("fold", 1.0),
        *("taken up", "settled", ("weld", "begins"), ("weld", 1.0)),
        *("taken up", "settled", ("rest", "begins"), ("rest", 0.5), "looked after", "rest"),
    ]


def test_moves_at_the_same_time_end_each_at_its_own():
    told = performed((0.0, 1.0, "short"), (0.0, 2.0, "long"))
    assert told[-6:] == [("long", 0.5), "looked after", "long", ("long", 1.0), "long", "long"]


def test_a_motion_with_something_left_to_do_goes_on_when_its_move_is_over():
    told = performed((0.0, 0.0, "lasting"), frames=6)
    assert told.count(("lasting", 1.0)) == 4


def test_a_loosened_grip_fades_steadily_and_what_is_to_untwist_is_not_braked():
    room = Room()
    room.gather().advance(1.0)
    loosen = Loosen(moves.Loosen(**DONE), room.sculpture)
    held = [room.joint("left.end"), room.joint("right.end")]
    drag, grips = room.hands.drag.copy(), []
    for share in (0.0, 0.1, 0.3, 0.5):
        loosen.advance(share)
        grips.append(room.hands.force[held].max())
    assert (room.hands.mode[held] == LEAD_MODE).all()
    assert all(earlier > later for earlier, later in pairwise(grips))
    assert grips[-1] < 1e-3 * grips[0]
    loosen.advance(1.0)
    assert room.plan.loose
    assert np.array_equal(room.hands.drag, drag)


def test_what_hands_loosen_their_grip_on_floats():
    room = Room()
    assert not room.hands.floating.any()
    Loosen(moves.Loosen(**DONE), room.sculpture)
    assert room.hands.floating[list(room.sculpture.bodies)].all()
