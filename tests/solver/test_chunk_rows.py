"""All quads of a chunk tested at once give what each gives alone."""

from __future__ import annotations

import numpy as np
import warp as wp

from balloon_usd.solver.kernels.device.chunk_rows import (
    CHUNK_QUADS,
    REACH_ROWS,
    SPHERE_ROWS,
    in_row,
    lanes_between,
    near_spheres,
    put_in_row,
    within_reach,
)

CHUNKS = 5
POINTS = 64


@wp.kernel
def store(values: wp.array3d[float], rows: wp.array2d[float]):
    """Store all values, by chunk, row and quad."""
    chunk, row, lane = wp.tid()
    put_in_row(rows, chunk, row, lane, values[chunk, row, lane])


@wp.kernel
def mask_all(
    spheres: wp.array2d[float],
    reach: wp.array2d[float],
    points: wp.array[wp.vec4],
    masks: wp.array3d[int],
    first: wp.array2d[float],
):
    """Write both masks of every point and chunk, and the first value of a row that was stored."""
    i, chunk = wp.tid()
    p = points[i]
    masks[i, chunk, 0] = near_spheres(spheres, chunk, wp.vec3(p[0], p[1], p[2]), p[3])
    masks[i, chunk, 1] = within_reach(reach, chunk, wp.vec3(p[0], p[1], p[2]), p[3])
    first[chunk, i % 4] = in_row(spheres, chunk, i % 4, 0)


@wp.kernel
def masks_between(masks: wp.array2d[int]):
    """Write the masks from one lane to another."""
    begin, end = wp.tid()
    masks[begin, end] = lanes_between(begin, end)


def stored(values):
    rows = wp.zeros((CHUNKS, values.shape[1] * CHUNK_QUADS), dtype=float, device="cpu")
    wp.launch(store, values.shape, [wp.array(values, dtype=float, device="cpu"), rows], device="cpu")
    return rows


def bits(mask):
    """The lanes of masks, (..., CHUNK_QUADS) bool."""
    return (mask[..., None].astype(np.int64) >> np.arange(CHUNK_QUADS)) & 1 == 1


def test_a_point_is_tested_against_all_quads_of_a_chunk_as_against_each():
    chance = np.random.default_rng(3)
    spheres = chance.uniform(0.0, 1.0, (CHUNKS, SPHERE_ROWS, CHUNK_QUADS)).astype(np.float32)
    reach = chance.uniform(0.0, 0.5, (CHUNKS, REACH_ROWS, CHUNK_QUADS)).astype(np.float32)
    points = chance.uniform(0.0, 0.6, (POINTS, 4)).astype(np.float32)
    masks = wp.zeros((POINTS, CHUNKS, 2), dtype=int, device="cpu")
    first = wp.zeros((CHUNKS, SPHERE_ROWS), dtype=float, device="cpu")
    given = [stored(spheres), stored(reach), wp.array(points, dtype=wp.vec4, device="cpu"), masks, first]
    wp.launch(mask_all, (POINTS, CHUNKS), given, device="cpu")
    found = bits(masks.numpy())
    p, r = points[:, None, :3, None], points[:, 3, None, None]
    near = ((spheres[:, :3] - p) ** 2).sum(axis=2) < (spheres[:, 3] + r) ** 2
    within = ((reach[:, :3] - p) ** 2).sum(axis=2) < reach[:, 3] ** 2 + (reach[:, 4] + r) ** 2
    assert (found[:, :, 0] == near).all()
    assert (found[:, :, 1] == within).all()
    assert 0.1 < near.mean() < 0.9
    assert 0.1 < within.mean() < 0.95
    assert (first.numpy() == spheres[:, :, 0]).all()


def test_a_mask_of_lanes_has_these_and_no_others():
    masks = wp.zeros((CHUNK_QUADS + 1, CHUNK_QUADS + 1), dtype=int, device="cpu")
    wp.launch(masks_between, masks.shape, [masks], device="cpu")
    lane = np.arange(CHUNK_QUADS)
    begin, end = np.meshgrid(*2 * [np.arange(CHUNK_QUADS + 1)], indexing="ij")
    expected = (lane >= begin[..., None]) & (lane < end[..., None])
    assert (bits(masks.numpy()) == expected).all()
