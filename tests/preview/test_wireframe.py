from __future__ import annotations

import time

import numpy as np
import pytest

from balloon_usd.preview import Cage, Particles, PreviewError, Wireframe
from tests.stage.capsule import THESIS

ORANGE = (0.871, 0.216, 0.005)
BLUE = (0.012, 0.105, 0.687)
CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float32)
QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
SMALL = (180, 120)


def wire(quads, color=ORANGE):
    cage = Cage(np.full(len(quads), 4), np.asarray(quads).ravel())
    return Wireframe([cage], [np.tile(np.float32(color), (len(quads), 1))], device="cpu")


def balls(*centres, radius=0.2, color=BLUE):
    count = len(centres)
    return Particles(
        np.float32(centres).reshape(-1, 3),
        np.full(count, radius, dtype=np.float32),
        np.tile(np.float32(color), (count, 1)),
    )


def draw(particles=None, view="side", size=SMALL, points=CUBE):
    return wire(QUADS).shoot([points], view, size, particles).picture.astype(int)


def orange_of(picture):
    return np.clip(picture[..., 0] - picture[..., 2] - 8, 0, None)


def blue_of(picture):
    return np.clip(picture[..., 2] - picture[..., 0] - 8, 0, None)


@pytest.fixture(scope="module")
def cube():
    return draw()


def test_a_picture_has_the_asked_size_and_pale_corners(cube):
    assert cube.shape == (120, 180, 3)
    assert cube[0, 0].min() > 190
    assert cube[0, -1].min() > 190


def test_the_wire_is_orange_and_nothing_is_between(cube):
    lines = orange_of(cube) > 20
    assert 0.01 < lines.mean() < 0.15
    rows, columns = np.nonzero(lines)
    assert max(np.ptp(rows) / 120, np.ptp(columns) / 180) > 0.8
    middle = cube[rows.min() + 15 : rows.min() + 25, columns.min() + 25 : columns.max() - 25]
    assert orange_of(middle).max() < 8


def test_nearer_wires_are_stronger():
    square = np.float32([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]])
    points = np.concatenate([square + np.float32([-1.5, -1, 0]), square + np.float32([1.5, 1, 0])])
    two = wire([[0, 1, 2, 3], [4, 5, 6, 7]])
    lines = orange_of(two.shoot([points], "side", (360, 240)).picture.astype(int))
    assert lines[:, :180].sum() > 1.4 * lines[:, 180:].sum() > 0


def test_the_far_side_of_a_balloon_is_paler_than_the_near_side():
    square = np.float32([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]])
    points = np.concatenate([square + np.float32([-1.5, 0, 0]), square + np.float32([1.5, 0, 0])])
    two = wire([[0, 1, 2, 3], [7, 6, 5, 4]])
    lines = orange_of(two.shoot([points], "side", (360, 240)).picture.astype(int))
    assert lines[:, :180].sum() > 1.7 * lines[:, 180:].sum() > 0


def test_a_ball_inside_is_seen_through_the_wire(cube):
    picture = draw(balls((0, 0, 0)))
    assert blue_of(picture).max() > 80
    rows, columns = np.nonzero(blue_of(picture) > 40)
    assert abs(np.ptp(rows) - np.ptp(columns)) <= 1
    assert np.array_equal(orange_of(picture)[:, :40] > 20, orange_of(cube)[:, :40] > 20)


def test_a_ball_is_shaded_as_a_ball():
    picture = draw(balls((0, 0, 0), radius=0.5)).sum(axis=2)
    rows, columns = np.nonzero(blue_of(draw(balls((0, 0, 0), radius=0.5))) > 40)
    top, left = rows.min(), columns.min()
    reach = np.ptp(rows)
    assert (
        picture[top + reach // 4, left + reach // 4]
        > 1.3 * picture[top + 7 * reach // 8, left + 5 * reach // 8]
    )


def test_a_ball_hides_the_wire_behind_it_and_is_crossed_by_the_wire_in_front():
    crossed = []
    for depth in (-1.4, -0.6):
        picture = draw(balls((1, depth, 0), radius=0.3), size=(360, 240))
        rows, columns = np.nonzero(blue_of(picture) > 60)
        middle = picture[int(rows.mean()), columns.min() + 2 : columns.max() - 1]
        crossed.append(bool(orange_of(middle).max() > 40))
    assert crossed == [False, True]


def test_balls_hide_each_other_whatever_their_order():
    near, far = (0, -0.5, 0), (0, 0.5, 0)
    pictures = []
    for order in ((near, far), (far, near)):
        particles = balls(*order, radius=0.4)
        red = [centre == far for centre in order]
        particles.colors[red] = (0.7, 0.01, 0.02)
        pictures.append(draw(particles))
    assert np.array_equal(*pictures)
    assert pictures[0][60, 90, 2] > pictures[0][60, 90, 0] + 40


def test_the_same_frame_gives_the_same_bits_from_a_caster_used_before(cube):
    caster = wire(QUADS)
    caster.shoot([CUBE * 2], "top", SMALL, balls((0, 0, 0)))
    assert np.array_equal(caster.shoot([CUBE], "side", SMALL).picture, cube)


def test_lines_grow_with_the_picture():
    shares = [(orange_of(draw(size=size)) > 40).mean() for size in ((360, 240), (1440, 960))]
    assert shares[1] == pytest.approx(shares[0], rel=0.35)


def test_there_is_a_soft_shadow_below(cube):
    assert cube[-8, 40:140].mean() < cube[4, 40:140].mean() - 2


def test_the_scale_of_a_picture_measures_the_wire():
    shot = wire(QUADS).shoot([CUBE * np.float32([1, 0.01, 1])], "side", (360, 240))
    columns = np.nonzero((orange_of(shot.picture.astype(int)) > 20).any(axis=0))[0]
    assert np.ptp(columns) * shot.metres_per_pixel == pytest.approx(2.0, rel=0.03)


def test_the_frame_holds_particles_that_leaked():
    picture = draw(balls((4, 0, 0)))
    assert blue_of(picture).max() > 40


@pytest.mark.parametrize(
    ("value", "words"), [(np.nan, "not finite"), (np.inf, "not finite"), (1e30, "farther than 100000 m")]
)
def test_what_no_camera_can_see_is_refused(value, words):
    points = CUBE.copy()
    points[3, 1] = value
    with pytest.raises(PreviewError, match=words):
        draw(points=points)
    with pytest.raises(PreviewError, match=words):
        draw(balls((0, value, 0)))


def test_a_flat_or_vanishing_cage_is_no_trouble():
    for shape in ([1, 0, 1], [0, 0, 1], [0, 0, 0]):
        assert draw(balls((0, 0, 0)), points=CUBE * np.float32(shape)).shape == (120, 180, 3)


def test_a_frame_of_the_thesis_takes_less_than_a_third_of_a_second():
    caster = wire(THESIS.quads)
    points, centres = THESIS.points(waist=0.5), THESIS.particles()
    particles = balls(*centres, radius=0.0015)
    assert (len(THESIS.quads), len(centres)) == (1600, 800)
    caster.shoot([points], particles=particles)
    times = []
    for _ in range(3):
        begin = time.perf_counter()
        caster.shoot([points], particles=particles)
        times.append(time.perf_counter() - begin)
    assert min(times) < 0.3
