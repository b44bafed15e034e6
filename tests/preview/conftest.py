"""Sculptures that several tests draw."""

from __future__ import annotations

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parent))

import sculptures

from balloon_usd.stage import write_stage
from tests.stage.capsule import Capsule
from tests.stage.tubes import frames, sculpture


@pytest.fixture(scope="session")
def dog():
    """Points (V, 3), quads (Q, 4) and bubble of each quad (Q,)."""
    return sculptures.dog()


@pytest.fixture(scope="session")
def chain():
    return sculptures.chain()


@pytest.fixture(scope="session")
def springs(tmp_path_factory):
    """The file of a stage with air, in the look of the thesis unless another is asked for."""
    capsule = Capsule(n=4, along=10, grid=(12, 3, 3))
    folder = tmp_path_factory.mktemp("springs")
    return write_stage(capsule.describe(), capsule.frames(8), folder).files[0]


@pytest.fixture(scope="session")
def two_tubes(tmp_path_factory):
    """The file of a stage of a red and a blue tube, slack at first and stretched to the utmost in the end."""
    stretched = (
        replace(f, stretch=tuple(np.full_like(s, 1.0 + 0.5 * f.time_code) for s in f.stretch))
        for f in frames(12)
    )
    return write_stage(sculpture(), stretched, tmp_path_factory.mktemp("two_tubes")).files[0]
