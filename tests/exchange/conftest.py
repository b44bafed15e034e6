from __future__ import annotations

from pathlib import Path

import pytest

from balloon_usd.stage import write_stage
from tests.stage.tubes import frames, sculpture

FRAMES = 5


@pytest.fixture(scope="session")
def dog(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The stage of two tubes. Only to be read."""
    folder = tmp_path_factory.mktemp("written")
    return write_stage(sculpture(), frames(FRAMES), folder).files[0]
