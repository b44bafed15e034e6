"""Sculptures that several tests draw."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

import sculptures

from balloon_usd.stage import write_stage
from tests.stage.capsule import Capsule


@pytest.fixture(scope="session")
def dog():
    """Points (V, 3), quads (Q, 4) and bubble of each quad (Q,)."""
    return sculptures.dog()


@pytest.fixture(scope="session")
def chain():
    return sculptures.chain()


@pytest.fixture(scope="session")
def springs(tmp_path_factory):
    """The file of a flat stage with air, in the look of the thesis unless another is asked for."""
    capsule = Capsule(n=4, along=10, grid=(12, 3, 3))
    folder = tmp_path_factory.mktemp("springs")
    return write_stage(capsule.describe(), capsule.frames(8), folder, flat=True).files[0]
