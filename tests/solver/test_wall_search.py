"""The search for walls finds what a look at every pair of a vertex and a face finds."""

from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.solver.kernels.physics.facing_walls import DEPTH_LIMIT, FACING, ROUNDING, STAYING
from balloon_usd.solver.kernels.physics.meeting import FOLDED, INSIDE, OPPOSITE
from balloon_usd.solver.kernels.physics.motion import LYING_MODE
from balloon_usd.solver.kernels.physics.patch import SIDE_SLIP
from balloon_usd.solver.kernels.physics.surface import GROUP
from balloon_usd.solver.simulation import simulate_many
from tests.solver.locked_pair import locked_pair

FLAT = 0.05
"""Width of a tube that is pressed flat, in its own."""
MOVING = 1.0
"""Speed of walls that look for others, m/s."""
ROUNDED = 1e-5
"""How near to a limit float32 does not know the side, m."""


@pytest.fixture(scope="module")
def model():
    """A locked pair at its end."""
    simulation = simulate_many([locked_pair()], detail="draft", device="cpu")
    assert all(frames for frames in simulation.frames())
    return simulation.model


def searched(model, velocity, crossed=0, watched=0, floating=0, touching=1):
    """The arrays of the scene after one more search; `velocity`: (V, 3), m/s.

    `crossed`, `watched`: whether its walls cross, and are kept apart at every search; `floating`: whether
    hands loosen their grip; `touching`: what its walls may touch.
    """
    scene, search = model.scene, model.stepper._search
    kept = scene.v.numpy().copy()
    scene.v.assign(velocity)
    scene.crossed.fill_(crossed)
    scene.watched.fill_(watched)
    scene.floating.fill_(floating)
    scene.touching.fill_(touching)
    search.measure_quads()
    search.find()
    found = {name: array.numpy().copy() for name, array in scene.arrays.items() if hasattr(array, "numpy")}
    scene.v.assign(kept)
    return found


def nearest(x, p):
    """Point of bilinear patches, (N, 4, 3), nearest to points (N, 3), by three steps of Gauss and Newton."""
    place = np.zeros((len(p), 2))
    a = 0.5 * (x[:, 1] - x[:, 0] + x[:, 2] - x[:, 3])
    b = 0.5 * (x[:, 3] - x[:, 0] + x[:, 2] - x[:, 1])
    h = x[:, 0] - x[:, 1] + x[:, 2] - x[:, 3]
    for step in range(4):
        u, w = place.T[:, :, None]
        r = x.mean(axis=1) + u * a + w * b + u * w * h
        if step == 3:
            return r
        du, dw, r = a + w * h, b + u * h, r - p
        aa, bb, ab = (du * du).sum(1), (dw * dw).sum(1), (du * dw).sum(1)
        ra, rb = (r * du).sum(1), (r * dw).sum(1)
        det = np.maximum(aa * bb - ab * ab, 1e-20)
        place -= np.stack([(bb * ra - ab * rb) / det, (aa * rb - ab * ra) / det], axis=1)
        place = np.clip(place, -0.5, 0.5)
    raise AssertionError


def ahead_of(s, touch, vertex):
    """How much farther than where it presses every face is looked for, (Q,) m."""
    speeds = np.linalg.norm(s["v"][s["quads"]].mean(axis=1), axis=1) + np.linalg.norm(s["v"][vertex])
    return touch.margin + touch.ahead * speeds


def distances(s, touch, vertex, slack):
    """How far every face is from a vertex, (Q,) m, inf where it may not touch it; `slack`: of limits, m."""
    x, own = s["x"].astype(float), s["vertex_segment"][vertex]
    size = np.linalg.norm(s["quad_area"].astype(float), axis=1)
    face = s["quad_area"] / size[:, None]
    height = ((x[vertex] - s["quad_middle"]) * face).sum(axis=1)
    radius = s["balloon_radius"][0]
    away = np.abs(s["quad_place"] - s["vertex_place"][vertex]).max(axis=1)
    sides = s["quad_outward"] @ s["vertex_outward"][vertex]
    across = (s["quad_segment"] == own) & (away < touch.across * radius) & (sides < OPPOSITE)
    meets = across | (away > touch.apart * radius) | ((s["quad_segment"] != own) & (own >= 0))
    going = s["v"][s["quads"]].mean(axis=1) - s["v"][vertex]
    offset = s["contact_offset"][0]
    watched = np.where(across, INSIDE * offset, offset + s["contact_arc"][0] * size)
    watched = watched + touch.margin + touch.ahead * np.linalg.norm(going, axis=1) + slack
    deepest = slack + DEPTH_LIMIT * np.minimum(
        s["ring_radius"][s["vertex_ring"][vertex]], s["ring_radius"][s["quad_ring"]]
    )
    if not s["crossed"][vertex]:
        neck = -2 if s["watched"][0] or s["vertex_neck"][vertex] < 0 else s["vertex_neck"][vertex]
        apart = np.where(s["quad_neck"] == neck, FOLDED, ROUNDING) * offset
        deepest = np.minimum(deepest, slack + apart)
    deepest = np.where(across, np.minimum(deepest, watched), deepest)
    turned = face @ s["normal"][vertex] < FACING + 100.0 * slack
    height = np.where(across, -height, height)
    gap = x[vertex] - nearest(x[s["quads"]], np.repeat(x[vertex][None], len(face), axis=0))
    beside = np.linalg.norm(gap - (gap * face).sum(axis=1)[:, None] * face, axis=1)
    near = (height > -deepest) & (height < watched) & (beside < SIDE_SLIP * np.sqrt(size) + slack)
    corner = np.linalg.norm(x[s["quads"]] - s["quad_middle"][:, None], axis=2).max(axis=1)
    wide = corner + SIDE_SLIP * np.sqrt(size)
    seen = ahead_of(s, touch, vertex) + offset + s["contact_arc"][0] * size
    near &= np.hypot(wide, seen) + slack > np.linalg.norm(x[vertex] - s["quad_middle"], axis=1)
    return np.where(meets & turned & near, np.linalg.norm(gap, axis=1), np.inf)


@pytest.mark.parametrize(
    ("speed", "crossed", "watched"),
    [(0.0, 0, 0), (1.0, 0, 0), (0.0, 1, 0), (0.0, 0, 1)],
    ids=["still", "fast", "crossed", "watched"],
)
def test_every_vertex_finds_the_wall_nearest_to_it_of_all_that_it_may_touch(model, speed, crossed, watched):
    velocity = np.random.default_rng(5).normal(0.0, speed, (len(model.scene.x), 3)).astype(np.float32)
    s = searched(model, velocity, crossed, watched)
    found = looked = small = 0
    for vertex in range(len(s["x"])):
        distance = distances(s, model.scene.touch, vertex, ROUNDED)
        best = int(np.argmin(distance))
        if distance[best] != distances(s, model.scene.touch, vertex, -ROUNDED).min():
            continue
        looked += 1
        target = s["target"][vertex, 0]
        assert (target >= 0) == (distance[best] < np.inf), vertex
        if target >= 0:
            found += 1
            assert distance[target] == pytest.approx(distance[best], abs=ROUNDED)
            small += s["area"][vertex] < 0.25 * np.linalg.norm(s["quad_area"][target])
    assert looked > 0.9 * len(s["x"])
    assert found > 100
    # Where necks press on full bubbles.
    assert small > 5


def test_walls_that_lie_look_for_nothing_else_than_what_they_touch(model):
    scene, still = model.scene, np.zeros((len(model.scene.x), 3), dtype=np.float32)
    before = searched(model, still)["target"]
    at = scene.x.numpy().copy()
    scene.x.assign(at * np.array([1.0, 0.8, 1.25], dtype=np.float32))
    try:
        kept, found = searched(model, still, touching=LYING_MODE)["target"], searched(model, still)["target"]
    finally:
        scene.x.assign(at)
    assert (kept == before).all()
    assert (found != before).any(axis=1).sum() > 20


@pytest.mark.parametrize("floating", [0, 1], ids=["held", "loosened"])
def test_once_hands_loosen_their_grip_what_was_touched_is_kept_while_another_is_hardly_nearer(
    model, floating
):
    kept = judged = 0
    for seed in range(3):
        # What moves looks farther, and so finds walls that are much nearer than others, too.
        moving = np.random.default_rng(seed).normal(0.0, MOVING, (len(model.scene.x), 3)).astype(np.float32)
        s = searched(model, moving)
        targets, wanted = touched_before(s, model.scene.touch, floating)
        model.scene.target.assign(targets)
        found = searched(model, moving, floating=floating)["target"]
        kept += sum(targets[vertex, 0] == wall for vertex, wall in wanted.items())
        judged += len(wanted)
        for vertex, wall in wanted.items():
            assert wall in found[vertex], (seed, vertex)
    assert judged > 150
    assert (60 < kept < judged) if floating else kept == 0


def touched_before(s, touch, floating):
    """Walls farther off than the nearest that vertices touch, (V, 2), and which of both they shall touch then."""
    targets, wanted = s["target"].copy(), {}
    gain = STAYING * s["contact_offset"][0]
    for vertex in np.flatnonzero(s["target"][:, 0] >= 0):
        distance = distances(s, touch, vertex, -ROUNDED)
        distance[s["quad_segment"] != s["quad_segment"][s["target"][vertex, 0]]] = np.inf
        by_distance = np.argsort(distance, kind="stable")
        last = np.isfinite(distance).sum() - 1
        closest, other = by_distance[0], by_distance[last if vertex % 2 else 1]
        nearest_of_all = distances(s, touch, vertex, ROUNDED).min()
        if not np.isfinite(distance[other]) or distance[closest] != nearest_of_all:
            continue
        farther = distance[other] - distance[closest]
        if farther > ROUNDED and abs(farther - gain) > ROUNDED:
            targets[vertex] = (other, -1)
            wanted[vertex] = other if floating and farther < gain else closest
    return targets, wanted


def test_what_is_kept_apart_is_not_pressed_through_walls_that_it_is_behind(model):
    x = model.scene.x.numpy()
    bubbles = [model.scene.vertex_segment.numpy() == b for b in model.layout.bubbles[1:3]]
    way = x[bubbles[1]].mean(axis=0) - x[bubbles[0]].mean(axis=0)
    inside = x.copy()
    inside[bubbles[0]] += 4e-3 * way / np.linalg.norm(way)
    model.scene.x.assign(inside)
    still = np.zeros_like(x)
    crossed, apart, watched = (
        int((searched(model, still, *how)["target"] >= 0).sum()) for how in ((1, 0), (0, 0), (0, 1))
    )
    model.scene.x.assign(x)
    # Walls apart from each other touch only in folds of their necks, and not even there while they are led.
    assert crossed > apart > watched > 100


def test_the_list_of_a_face_holds_every_contact_on_it_once_in_order(model):
    s = searched(model, np.zeros((len(model.scene.x), 3), dtype=np.float32))
    vertex, slot = np.nonzero(s["target"] >= 0)
    pairs, faces = 2 * vertex + slot, s["target"][vertex, slot]
    assert len(pairs) == s["pair_count"][0] == s["listed_count"][0] > 100
    for face in range(len(s["quads"])):
        first, count = s["hit_first"][face], s["hit_count"][face]
        assert s["hits"][first : first + count].tolist() == sorted(pairs[faces == face].tolist())
    pressed = s["pressed"][: s["pressed_count"][0]]
    assert sorted(pressed.tolist()) == np.flatnonzero(s["hit_count"]).tolist()


def test_the_inside_of_a_tube_that_is_pressed_flat_is_pressed_apart():
    simulation = simulate_many([locked_pair()], detail="draft", device="cpu")
    stepper, scene = simulation.model.stepper, simulation.model.scene
    x = scene.x.numpy().copy()
    flat = x.copy()
    flat[:, 1] *= FLAT
    scene.x.assign(flat)
    searched(simulation.model, np.zeros_like(x))
    stepper._sculptures.advance(stepper._launcher, stepper.substeps, 0, 1, contact=True, fingers=False)
    # On a CPU the vectors of one vertex lie together.
    force = scene.contact_force.numpy().reshape(-1, 2, 3).sum(axis=1)
    pressed = np.abs(force[:, 1]) > 1e-3
    assert pressed.sum() > 50
    assert (force[pressed, 1] * x[pressed, 1] > 0.0).mean() > 0.95


def test_the_box_of_a_group_of_chunks_is_about_all_that_they_reach(model):
    found = searched(model, model.scene.v.numpy())
    chunks, groups = len(found["chunk_low"]), range(0, len(found["chunk_low"]), GROUP)
    assert len(groups) > 1
    for group, first in enumerate(groups):
        own = slice(first, min(first + GROUP, chunks))
        assert np.array_equal(found["group_low"][group], found["chunk_low"][own].min(axis=0))
        assert np.array_equal(found["group_high"][group], found["chunk_high"][own].max(axis=0))
