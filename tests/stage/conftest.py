from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import pytest
from pxr import Usd

from balloon_usd.stage import write_stage
from tests import interruptible
from tests.stage.capsule import Capsule
from tests.stage.tubes import frames, sculpture

if TYPE_CHECKING:
    from collections.abc import Callable

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="session")
def written(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the layered dog in two details, and the flat one. Only to be read."""
    folder = tmp_path_factory.mktemp("written")
    write_stage(sculpture(rings=9), frames(12, rings=9), folder, detail="full")
    write_stage(sculpture(), frames(12), folder)
    write_stage(sculpture(), frames(12), folder, flat=True)
    return folder


@pytest.fixture
def dog(written: Path) -> Usd.Stage:
    """The layered dog, open; edits go to the session layer and are lost."""
    stage = Usd.Stage.Open(str(written / "dog" / "dog.usda"))
    stage.GetSessionLayer().Clear()
    stage.SetEditTarget(stage.GetSessionLayer())
    return stage


@pytest.fixture(scope="session")
def aired(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with the layered capsule of springs and air in two details, and the flat one. Only to be read."""
    folder = tmp_path_factory.mktemp("aired")
    fine, coarse = Capsule(n=3, along=6, grid=(8, 3, 3)), Capsule()
    write_stage(fine.describe(), fine.frames(8), folder, detail="full")
    write_stage(coarse.describe(), coarse.frames(8), folder)
    write_stage(coarse.describe(), coarse.frames(8), folder, flat=True)
    return folder


@pytest.fixture(params=["capsule/capsule.usda", "capsule.usdc"], ids=["layered", "flat"])
def capsule(request: pytest.FixtureRequest, aired: Path) -> Usd.Stage:
    """The capsule, open, layered and flat; edits go to the session layer and are lost."""
    stage = Usd.Stage.Open(str(aired / request.param))
    stage.GetSessionLayer().Clear()
    stage.SetEditTarget(stage.GetSessionLayer())
    return stage


@pytest.fixture
def child() -> Callable[..., subprocess.Popen[str]]:
    """Start a Python process that runs some code with the test tubes at hand."""

    def start(code: str, **environment: str) -> subprocess.Popen[str]:
        prelude = (
            "import os, resource, signal, sys, time\nfrom dataclasses import replace\nfrom pathlib import Path\nimport numpy as np\n"
            "from balloon_usd.stage import *\nfrom tests.stage.tubes import *\nfrom tests.stage.capsule import *\n"
        )
        words = [sys.executable, "-c", prelude + code]
        return interruptible.start(words, cwd=ROOT, env={**os.environ, **environment})

    return start
