from __future__ import annotations

import shutil
from typing import TYPE_CHECKING

import pytest

from balloon_usd.stage import write_stage
from tests.stage.capsule import Capsule
from tests.stage.tubes import frames, sculpture

if TYPE_CHECKING:
    from pathlib import Path


@pytest.fixture(scope="session")
def stages(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with every form of the dog of two tubes, and of the capsule with air. Only to be read."""
    folder = tmp_path_factory.mktemp("stages")
    write_stage(sculpture(), frames(12), folder, shot=True)
    write_stage(sculpture(), frames(12), folder, flat=True)
    write_stage(sculpture(), frames(12), folder, usdz=True)
    capsule = Capsule()
    write_stage(capsule.describe(), capsule.frames(8), folder, shot=True)
    write_stage(capsule.describe(), capsule.frames(8), folder, flat=True)
    return folder


@pytest.fixture
def dog(stages: Path, tmp_path: Path) -> Path:
    """A copy of the dog in layers, to be damaged: its folder."""
    return shutil.copytree(stages / "dog", tmp_path / "dog")


@pytest.fixture
def details(dog: Path) -> Path:
    """The same with a second, finer detail, which is not selected."""
    write_stage(sculpture(rings=9), frames(12, rings=9), dog.parent, detail="full")
    write_stage(sculpture(), frames(12), dog.parent)
    return dog


@pytest.fixture(autouse=True)
def _not_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    """Spare the time of NVIDIA's validator, which has tests of its own."""
    monkeypatch.setattr("balloon_usd.check.check.nvidia_installed", lambda: False)
