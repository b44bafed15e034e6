"""The picture of a stage as Blender imports it."""

from __future__ import annotations

import numpy as np
from PIL import Image

from balloon_usd.stage import write_stage
from tests.stage.tubes import frames, sculpture


def test_a_stage_is_rendered_in_its_colours_before_pale_paper(blender, tmp_path):
    stage = write_stage(sculpture(), frames(2), tmp_path).files[0]
    blender("render_dog:main", str(stage), str(tmp_path / "dog.png"), width=60, samples=4)
    picture = np.asarray(Image.open(tmp_path / "dog.png")).astype(float)
    assert picture.shape == (40, 60, 3)
    red, _, blue = np.moveaxis(picture, 2, 0)
    assert (red > 2 * blue).sum() > 30
    assert (blue > 1.5 * red).sum() > 30
    assert picture[:2].min() > 100
