from __future__ import annotations

import numpy as np
import pytest

from balloon_usd.preview import Particles, PreviewError, Raycaster, quad_surface, render_mesh, render_meshes

RED = (0.60, 0.012, 0.018)
BLUE = (0.02, 0.10, 0.55)
SMALL = (180, 120)


@pytest.fixture(scope="module")
def picture(dog):
    return render_mesh(dog[0], dog[1], RED, "side", SMALL, device="cpu").astype(int)


def is_red(picture):
    return picture[..., 0] > picture[..., 1] + 60


def test_a_picture_has_the_asked_size_and_pale_corners(picture):
    assert picture.shape == (120, 180, 3)
    assert picture[0, 0].min() > 190
    assert picture[0, -1].min() > 190


def test_the_sculpture_is_drawn_in_its_colour_and_fills_the_frame(picture):
    red = is_red(picture)
    assert 0.12 < red.mean() < 0.5
    rows, columns = np.nonzero(red)
    assert max(np.ptp(rows) / 120, np.ptp(columns) / 180) > 0.8


def test_latex_shines(picture):
    rows, columns = np.nonzero(is_red(picture))
    inside = picture[rows.min() : rows.max(), columns.min() : columns.max()]
    between = (inside[..., 1] > 120) & (inside[..., 0] > inside[..., 1] + 25)
    assert between.sum() > 20


def test_the_floor_below_is_darker_than_the_paper_above(picture):
    assert picture[-8, 40:140].mean() < picture[4, 40:140].mean() - 3


def test_the_same_sculpture_gives_the_same_bits(dog, picture):
    again = render_mesh(dog[0], dog[1], RED, "side", SMALL, device="cpu")
    assert np.array_equal(again, picture)


def test_a_caster_used_before_draws_as_a_fresh_one(dog, picture):
    caster = Raycaster([quad_surface(dog[1])], [RED], device="cpu")
    caster.shoot([dog[0] * 2.0], "top", SMALL)
    assert np.array_equal(caster.shoot([dog[0]], "side", SMALL).picture, picture)


def test_each_quad_may_have_its_own_colour(chain):
    points, quads, bubble = chain
    colors = np.where((bubble == 0)[:, None], RED, BLUE)
    picture = render_mesh(points, quads, colors, "side", SMALL, device="cpu").astype(int)
    left, right = picture[:, :40], picture[:, 60:]
    assert (left[..., 0] > left[..., 2] + 60).any()
    assert not (right[..., 0] > right[..., 2] + 60).any()


def test_several_meshes_share_one_picture(chain):
    points, quads, _ = chain
    behind = points + np.array([0, 0.1, 0.1], dtype=np.float32)
    picture = render_meshes([(points, quads, RED), (behind, quads, BLUE)], "side", SMALL, device="cpu")
    shown = picture.astype(int)
    assert is_red(shown).any()
    assert (shown[..., 2] > shown[..., 0] + 60).any()


def test_a_crease_between_two_bubbles_is_darker_than_their_bellies(chain):
    points, quads, _ = chain
    picture = render_mesh(points, quads, RED, "side", (360, 240), device="cpu").astype(int)
    columns = np.nonzero(is_red(picture).any(axis=0))[0]
    row = int(np.nonzero(is_red(picture).any(axis=1))[0].mean())
    along = picture[row, columns.min() : columns.min() + 130, 0]
    assert along.min() < 0.75 * np.median(along)


def test_the_scale_of_a_picture_measures_the_sculpture(chain):
    points, quads, _ = chain
    shot = Raycaster([quad_surface(quads)], [RED], device="cpu").shoot([points], "side", (360, 240))
    columns = np.nonzero(is_red(shot.picture.astype(int)).any(axis=0))[0]
    assert np.ptp(columns) * shot.metres_per_pixel == pytest.approx(np.ptp(points[:, 0]), rel=0.03)


def test_a_device_that_is_not_there_is_refused_with_those_that_are(dog):
    with pytest.raises(PreviewError, match=r'no device "cuda:99", only .*cpu'):
        render_mesh(dog[0], dog[1], RED, device="cuda:99")


def test_points_that_are_not_finite_are_refused(dog):
    points = dog[0].copy()
    points[7, 1] = np.nan
    with pytest.raises(PreviewError, match="not finite"):
        render_mesh(points, dog[1], RED, device="cpu")


def balls(*centres, radius=0.01):
    count = len(centres)
    colors = np.tile(np.float32(BLUE), (count, 1))
    return Particles(np.float32(centres).reshape(-1, 3), np.full(count, radius, dtype=np.float32), colors)


def is_blue(picture):
    return picture[..., 2].astype(int) > picture[..., 0].astype(int) + 60


@pytest.fixture(scope="module")
def caster(chain):
    return Raycaster([quad_surface(chain[1])], [RED], device="cpu")


def test_particles_are_drawn_as_balls_in_front_of_the_rubber(chain, caster):
    shot = caster.shoot([chain[0]], "side", (360, 240), balls((0.1, -0.05, 0.0)))
    rows, columns = np.nonzero(is_blue(shot.picture))
    assert abs(np.ptp(rows) - np.ptp(columns)) <= 2
    assert np.ptp(columns) * shot.metres_per_pixel == pytest.approx(0.02, rel=0.2)


def test_rubber_hides_the_particles_in_it(chain, caster):
    plain = caster.shoot([chain[0]], "side", SMALL)
    hidden = caster.shoot([chain[0]], "side", SMALL, balls((0.1, 0.0, 0.0)))
    assert np.array_equal(plain.picture, hidden.picture)


def test_no_particles_change_nothing(chain, caster):
    plain = caster.shoot([chain[0]], "side", SMALL)
    assert np.array_equal(caster.shoot([chain[0]], "side", SMALL, Particles.none()).picture, plain.picture)


def test_the_frame_holds_all_particles(chain, caster):
    near = caster.shoot([chain[0]], "side", SMALL)
    far = caster.shoot([chain[0]], "side", SMALL, balls((0.9, 0.0, 0.0)))
    assert far.metres_per_pixel > 1.5 * near.metres_per_pixel
    assert is_blue(far.picture).any()


def test_a_ball_casts_a_shadow(chain, caster):
    picture = caster.shoot([chain[0]], "side", (360, 240), balls((0.2, -0.1, 0.0), radius=0.02)).picture
    rows, columns = np.nonzero(is_blue(picture))
    below = picture[rows.max() + 3].astype(int).sum(axis=1)
    assert below[int(columns.mean())] < below[-20] - 30


def test_points_out_of_all_reach_are_refused(dog):
    points = dog[0].copy()
    points[7, 1] = 1e30
    with pytest.raises(PreviewError, match="farther than 100000 m"):
        render_mesh(points, dog[1], RED, device="cpu")
