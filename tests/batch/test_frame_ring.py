from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from balloon_usd.batch.frame_ring import (
    MOST_FRAMES,
    SLOT_BYTES,
    FrameLayout,
    FrameRing,
    RingShape,
    frame_bytes,
)
from balloon_usd.batch.shared_memory import SharedMemory
from balloon_usd.solver.frame_arrays import Extent, Place
from tests.batch.runs import ROOT

EXTENT = Extent(7, 3)
PLACE = Place((slice(0, 4), slice(4, 7)), slice(0, 3))

OTHER = """
import sys
import numpy as np
from balloon_usd.batch.frame_ring import FrameLayout, FrameRing, RingShape
from balloon_usd.batch.shared_memory import SharedMemory
from balloon_usd.solver.frame_arrays import Extent, Place

extent = Extent(7, 3)
shape = RingShape(4, int(sys.argv[2]), 3)
ring = FrameRing(FrameLayout(shape, extent, ()), SharedMemory(shape.size, int(sys.argv[1])))
for slot in range(3):
    for number in range(4):
        frame = ring.frame_arrays(slot, number).frame(Place((slice(0, 4), slice(4, 7)), slice(0, 3)), 1)
        assert (frame.points[1] == 100 * slot + number).all(), (slot, number)
        frame.pressure[...] = -frame.points[0][0, 0]
"""


@pytest.fixture
def ring():
    shape = RingShape(4, frame_bytes(EXTENT), 3)
    memory = SharedMemory(shape.size)
    yield FrameRing(FrameLayout(shape, EXTENT, (PLACE,)), memory), memory
    memory.close()


def test_two_processes_see_the_same_frames(ring):
    frames, memory = ring
    for slot in range(3):
        for number in range(4):
            for points in frames.frame_arrays(slot, number).frame(PLACE, 1).points:
                points[...] = 100 * slot + number
    words = [sys.executable, "-c", OTHER, str(memory.handle), str(frame_bytes(EXTENT))]
    subprocess.run(words, pass_fds=[memory.handle], env={**os.environ, "PYTHONPATH": str(ROOT)}, check=True)
    for slot in range(3):
        for number in range(4):
            pressure = frames.frame_arrays(slot, number).frame(PLACE, 1).pressure
            assert (pressure == -(100 * slot + number)).all()


def test_no_two_frames_share_memory(ring):
    frames, _ = ring
    slots = [frames.frame_arrays(slot, number) for slot in range(3) for number in range(4)]
    arrays = [array for one in slots for array in one.frame(PLACE, 1).points]
    for array in arrays:
        array[...] = 0
    for number, array in enumerate(arrays):
        array[...] = number
    assert all((array == number).all() for number, array in enumerate(arrays))


def test_nothing_lies_beyond_the_last_slot(ring):
    frames, _ = ring
    with pytest.raises((TypeError, ValueError)):
        frames.frame_arrays(3, 0)


@pytest.mark.parametrize(("vertices", "count"), [(10, MOST_FRAMES), (10**7, 1)])
def test_small_frames_travel_together_and_large_ones_alone(vertices, count):
    shape = RingShape.of(Extent(vertices, 3))
    assert shape.frames == count
    assert shape.size == shape.slots * count * shape.frame_bytes
    assert count == 1 or shape.frames * shape.frame_bytes <= SLOT_BYTES


def test_memory_and_descriptors_go_with_the_arrays():
    before = len(list(Path("/proc/self/fd").iterdir()))
    for _ in range(50):
        shape = RingShape.of(EXTENT)
        memory = SharedMemory(shape.size)
        FrameRing(FrameLayout(shape, EXTENT, (PLACE,)), memory).frame_arrays(0, 0)
        memory.close()
    assert len(list(Path("/proc/self/fd").iterdir())) <= before + 1
    assert bytes(SharedMemory(10).buffer) == bytes(10)
