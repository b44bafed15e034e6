"""All quads of a chunk tested at once give what each gives alone."""

from __future__ import annotations

import numpy as np
import pytest
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
from balloon_usd.solver.kernels.device.search_lanes import SEARCH_LANES
from balloon_usd.solver.kernels.device.warp_reduce import WARP, without_lowest

DEVICES = ["cpu", *(device.alias for device in wp.get_cuda_devices())]
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
    i, chunk, _lane = wp.tid()
    p = points[i]
    masks[i, chunk, 0] = near_spheres(spheres, chunk, wp.vec3(p[0], p[1], p[2]), p[3])
    masks[i, chunk, 1] = within_reach(reach, chunk, wp.vec3(p[0], p[1], p[2]), p[3])
    first[chunk, i % 4] = in_row(spheres, chunk, i % 4, 0)


@wp.kernel
def masks_between(masks: wp.array2d[int]):
    """Write the masks from one lane to another."""
    begin, end = wp.tid()
    masks[begin, end] = lanes_between(begin, end)


@wp.kernel
def leave_out(bits: wp.array[int], left: wp.array2d[int]):
    """Write masks without none, one, two and so on of their lowest bits."""
    i, count = wp.tid()
    left[i, count] = without_lowest(bits[i], count)


def stored(values, device):
    rows = wp.zeros((CHUNKS, values.shape[1] * CHUNK_QUADS), dtype=float, device=device)
    wp.launch(store, values.shape, [wp.array(values, dtype=float, device=device), rows], device=device)
    return rows


def bits(mask):
    """The lanes of masks, (..., CHUNK_QUADS) bool."""
    return (mask[..., None].astype(np.int64) >> np.arange(CHUNK_QUADS)) & 1 == 1


@pytest.mark.parametrize("device", DEVICES)
def test_a_point_is_tested_against_all_quads_of_a_chunk_as_against_each(device):
    chance = np.random.default_rng(3)
    spheres = chance.uniform(0.0, 1.0, (CHUNKS, SPHERE_ROWS, CHUNK_QUADS)).astype(np.float32)
    reach = chance.uniform(0.0, 0.5, (CHUNKS, REACH_ROWS, CHUNK_QUADS)).astype(np.float32)
    points = chance.uniform(0.0, 0.6, (POINTS, 4)).astype(np.float32)
    masks = wp.zeros((POINTS, CHUNKS, 2), dtype=int, device=device)
    first = wp.zeros((CHUNKS, SPHERE_ROWS), dtype=float, device=device)
    rows = [stored(spheres, device), stored(reach, device)]
    lanes = SEARCH_LANES if wp.get_device(device).is_cuda else 1
    given = [*rows, wp.array(points, dtype=wp.vec4, device=device), masks, first]
    wp.launch(mask_all, (POINTS, CHUNKS, lanes), given, device=device, block_dim=WARP)
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


def test_a_mask_loses_its_lowest_bits():
    masks = np.array([0, 1, 0b1011000, -1], np.int32)
    left = wp.zeros((len(masks), 4), dtype=int, device="cpu")
    wp.launch(leave_out, left.shape, [wp.array(masks, dtype=int, device="cpu"), left], device="cpu")
    assert left.numpy().tolist() == [
        [0, 0, 0, 0],
        [1, 0, 0, 0],
        [0b1011000, 0b1010000, 0b1000000, 0],
        [-1, -2, -4, -8],
    ]
