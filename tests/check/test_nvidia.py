"""NVIDIA's validator has nothing to say about stages as they are written, and finds what is wrong with others."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import pytest

from balloon_usd.check import check_file, text_of
from balloon_usd.check.nvidia import INSTALL
from tests.check.layered_damages import MAIN, sample

if TYPE_CHECKING:
    from pathlib import Path


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ask NVIDIA's validator, which other tests of this folder do not."""
    monkeypatch.undo()


@pytest.mark.parametrize("name", ["dog", "dog.usdc", "dog.usdz", "dog_shot.usda", "capsule", "capsule.usdc"])
def test_nvidia_has_nothing_to_say_about_a_stage_as_it_is_written(
    name: str, stages: Path, asked: None
) -> None:
    report = check_file(str(stages / name))
    assert [name.split()[0] for name in report.validators] == ["usd-core", "usd-validation-nvidia"]
    assert report.found == []


def test_frozen_frames_show_nvidia_what_moves(dog: Path, asked: None) -> None:
    def welded(points: np.ndarray) -> np.ndarray:
        points[8:16] = points[0:8]
        return points

    sample("payload/draft_sim.usdc", f"{MAIN}.points", 7, welded)(dog)
    found = [fault for fault in check_file(str(dog)).found if fault.by == "nvidia" and fault.time_code == 7.0]
    assert {fault.prim.partition(".")[0] for fault in found} == {MAIN}


def test_where_it_is_not_installed_that_is_said(stages: Path) -> None:
    text = text_of(check_file(str(stages / "dog.usdc")))
    assert f"NVIDIA's validator is not installed and was not asked: {INSTALL}" in text
