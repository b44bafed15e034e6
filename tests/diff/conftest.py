"""Stages that are compared: tubes and a capsule of air as they are written, and copies to change."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from pxr import Usd

from balloon_usd.stage import write_stage
from tests.stage.capsule import Capsule
from tests.stage.tubes import frames, sculpture

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

FRAMES = 12


@pytest.fixture(scope="session")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the layered dog of two tubes, and the flat one. Only to be read."""
    folder = tmp_path_factory.mktemp("written")
    write_stage(sculpture(), frames(FRAMES), folder)
    write_stage(sculpture(), frames(FRAMES), folder, flat=True)
    return folder


@pytest.fixture(scope="session")
def aired(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the capsule of springs and air, layered and flat. Only to be read."""
    folder = tmp_path_factory.mktemp("aired")
    capsule = Capsule()
    write_stage(capsule.describe(), capsule.frames(8), folder)
    write_stage(capsule.describe(), capsule.frames(8), folder, flat=True)
    return folder


@pytest.fixture
def changed(written: Path, tmp_path: Path) -> Callable[[Callable[[Usd.Stage], object]], Path]:
    """Change a copy of the flat dog and return its file."""

    def change(how: Callable[[Usd.Stage], object]) -> Path:
        file = tmp_path / "changed.usdc"
        original = Usd.Stage.Open(str(written / "dog.usdc"))
        original.GetRootLayer().Export(str(file))
        stage = Usd.Stage.Open(str(file))
        how(stage)
        stage.GetRootLayer().Save()
        return file

    return change
