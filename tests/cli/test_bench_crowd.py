"""What `bench --crowd` measures: tubes that are turned into a rope."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.bench.crowd_ours import run_ours
from balloon_usd.bench.crowd_task import TURN, CrowdHeld, CrowdTask, walls_of_crowd
from balloon_usd.bench.frame_clock import clock_frames
from balloon_usd.bench.peers import PEERS
from balloon_usd.bench.pierced import pierced_triangles
from balloon_usd.bench.pinch_shape import volume
from balloon_usd.bench.pinch_task import RADIUS

TASK = CrowdTask()
EARLY = CrowdTask(frames=20)


def test_tubes_lie_side_by_side_and_pierce_nothing_at_the_start():
    assert pierced_triangles(TASK.points, TASK.triangles) == 0
    each = volume(TASK.tube.points.astype(float), TASK.chambers[0])
    assert [volume(TASK.points, chamber) for chamber in TASK.chambers] == pytest.approx([each] * 7)


def test_hands_turn_the_ends_by_half_a_turn_against_each_other():
    held = CrowdHeld(TASK)
    assert held.places(0) == pytest.approx(TASK.points[held.index])
    end = held.places(TASK.frames)
    half = len(end) // 2
    # A quarter of a turn each way.
    assert abs(TURN - np.pi) < 1e-6
    first, last = TASK.points[TASK.ends[0]], TASK.points[TASK.ends[1]]
    assert end[:half] == pytest.approx(np.column_stack([first[:, 0], first[:, 2], -first[:, 1]]))
    assert end[half:] == pytest.approx(np.column_stack([last[:, 0], -last[:, 2], last[:, 1]]))


def test_what_is_held_are_the_caps():
    first, last = TASK.ends
    assert len(first) == len(last) == 7 * 25
    assert TASK.points[first, 0].max() < 0.3 * RADIUS
    assert TASK.points[last, 0].min() > TASK.points[:, 0].max() - 0.3 * RADIUS


def test_walls_that_touch_go_through_nothing_and_others_do_and_hands_turn_both():
    for contact in (True, False):
        run = run_ours(EARLY, "cpu", contact=contact)
        assert len(run.shapes) == EARLY.frames
        crossed = sum(pierced_triangles(points, EARLY.triangles) for points in run.shapes)
        assert (crossed == 0) == contact
        held = CrowdHeld(EARLY)
        assert run.shapes[-1][held.index] == pytest.approx(held.places(EARLY.frames), abs=2e-4)


def test_other_solvers_get_the_same_walls():
    walls = walls_of_crowd(TASK)
    assert walls.triangles.shape == TASK.triangles.shape
    assert (walls.triangles == TASK.triangles).all()
    assert {peer.crowd_title for peer in PEERS.values()} == {"Newton VBD", "Blender cloth"}


def test_a_clock_tells_medians_and_lets_others_look_after_every_frame():
    done: list[object] = []
    clock = clock_frames(done.append, 3, lambda: done.append("look"))
    assert done == [0, "look", 1, "look", 2, "look"]
    assert 0.0 <= clock.wall < 1000.0


@pytest.mark.parametrize("beside", [["--stage"], ["--batch"], ["--mixed"]])
def test_a_crowd_is_measured_alone(cli, beside):
    result = cli("bench", "--crowd", *beside)
    assert result.exit_code == 2
    assert "one at a time" in result.stderr


def test_a_crowd_has_no_copies(cli):
    result = cli("bench", "--crowd", "--copies", "4")
    assert result.exit_code == 2
    assert "--copies: not used with --crowd" in result.stderr
