"""Elements of arrays, however they are read and wherever they lie."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import warp as wp

from balloon_usd.solver.upload import BatchedUpload
from tests.solver.array_kernels import compare_readings, double, through_soa

DEVICES = ["cpu", *(device.alias for device in wp.get_cuda_devices())]
"""Where simulations can run on this machine."""
ITEMS = 37
READINGS = 12
"""Ways of reading that are compared."""


def some(dtype, device, shape=ITEMS):
    """An array of numbers that all differ."""
    empty = wp.zeros(shape, dtype=dtype, device="cpu").numpy()
    return wp.array(np.arange(empty.size).reshape(empty.shape) - 5, dtype=dtype, device=device)


@pytest.mark.parametrize("device", DEVICES)
def test_every_way_of_reading_an_element_gives_what_warp_gives(device):
    types = (wp.vec2i, wp.vec4i, float, wp.vec2, wp.vec3, wp.vec4, wp.mat22)
    arrays = [some(int, device), some(int, device, (ITEMS, 3)), *(some(t, device) for t in types)]
    same = wp.zeros(ITEMS, dtype=int, device=device)
    wp.launch(compare_readings, ITEMS, inputs=[*arrays, same], device=device)
    assert (same.numpy() == READINGS).all()


@pytest.mark.parametrize("device", DEVICES)
def test_what_is_stored_in_an_array_is_there(device):
    number, three = some(float, device), some(wp.vec3, device)
    before = number.numpy().copy(), three.numpy().copy()
    wp.launch(double, ITEMS, inputs=[number, three], device=device)
    assert (number.numpy() == 2 * before[0]).all()
    assert (three.numpy() == 2 * before[1]).all()


@pytest.mark.parametrize("device", DEVICES)
@pytest.mark.parametrize("vectors", [2, 4])
def test_a_structure_of_arrays_keeps_every_vector_of_every_item(device, vectors):
    given = some(wp.vec3, device, (ITEMS, vectors))
    planes = wp.zeros((3 * vectors, ITEMS), dtype=float, device=device)
    found = wp.zeros_like(given)
    wp.launch(through_soa, ITEMS, inputs=[given, planes, found], device=device)
    assert (found.numpy() == given.numpy()).all()
    assert sorted(planes.numpy().ravel()) == sorted(given.numpy().ravel())


@pytest.mark.parametrize("device", DEVICES)
def test_arrays_in_a_batched_upload_keep_their_values_and_take_what_is_sent(device):
    held = {"mode": some(int, device), "goal": some(wp.vec3, device), "gas": some(wp.float64, device)}
    scene = SimpleNamespace(arrays=dict(held), device=device)
    upload = BatchedUpload(scene, held)
    for name, array in held.items():
        assert (scene.arrays[name].numpy() == array.numpy()).all()
    goal = np.full((ITEMS, 3), 7.5, np.float32)
    upload.send({"goal": goal, "mode": np.arange(ITEMS)})
    assert (scene.arrays["goal"].numpy() == goal).all()
    assert (scene.arrays["mode"].numpy() == np.arange(ITEMS)).all()
    assert (scene.arrays["gas"].numpy() == held["gas"].numpy()).all()
