from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.preview.camera import MARGIN, VIEWS, Axes, frame_points


def on_screen(points, axes, framing):
    local = points - framing.eye
    depth = local @ axes.forward
    return local @ axes.right / depth / framing.half_width, local @ axes.up / depth / framing.half_height


@pytest.mark.parametrize("view", VIEWS)
@pytest.mark.parametrize("aspect", [0.5, 1.0, 1.5])
def test_all_points_are_seen_and_fill_the_picture(view, aspect):
    points = np.random.default_rng(3).normal(size=(200, 3)) * [0.3, 0.1, 0.2] + [5.0, -2.0, 1.0]
    axes = Axes.of(view)
    x, y = on_screen(points, axes, frame_points(points.astype(np.float32), axes, aspect))
    filled = max(np.abs(x).max(), np.abs(y).max())
    assert filled == pytest.approx(1 / MARGIN, abs=1e-3)


@pytest.mark.parametrize("view", VIEWS)
def test_axes_are_right_handed_and_orthonormal(view):
    axes = Axes.of(view)
    matrix = np.stack([axes.right, axes.forward, axes.up])
    assert np.allclose(matrix @ matrix.T, np.eye(3))
    assert np.linalg.det(matrix) == pytest.approx(1.0)


def test_the_side_view_has_x_to_the_right_and_the_front_view_meets_the_start():
    assert np.allclose(Axes.of("side").right, [1, 0, 0])
    assert Axes.of("front").forward[0] > 0.9
    assert Axes.of("top").forward[2] < -0.99


def test_a_single_point_is_not_enlarged_without_end():
    framing = frame_points(np.zeros((1, 3), dtype=np.float32), Axes.of("side"), 1.5)
    assert framing.distance > 0.01
