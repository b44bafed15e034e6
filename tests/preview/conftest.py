"""Sculptures that several tests draw."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

import sculptures


@pytest.fixture(scope="session")
def dog():
    """Points (V, 3), quads (Q, 4) and bubble of each quad (Q,)."""
    return sculptures.dog()


@pytest.fixture(scope="session")
def chain():
    return sculptures.chain()
