"""Air and rubber push each other, and leaked air comes back, as the thesis says (eqs. 3.5 to 3.13, 3.17, 3.18)."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from balloon_usd.balloon.capsule_mesh import capsule_mesh
from balloon_usd.solver.kernels.kosaka.offset_regions import (
    WIDER,
    WIDER_OUTSIDE,
    face_surface,
    press_air,
    press_faces,
    press_vertices,
)
from tests.solver import kosaka_reference as thesis
from tests.solver.kosaka_bench import DEVICES, Sample, by_balloon, launch, listed, off, sample

GRADINGS = (0.0, 0.7)
"""The thesis's own push, and one that fades with depth."""


@dataclass(frozen=True)
class Wanted:
    """What the thesis says about a sample."""

    normal: np.ndarray
    d: np.ndarray
    uvw: np.ndarray
    near: np.ndarray
    """Which particles are in which triangles' regions, inside or outside, (T, P)."""
    depth: np.ndarray

    def push(self, grading: float) -> np.ndarray:
        """How hard every particle pushes on every triangle, (T, P)."""
        beside = self.uvw.min(axis=2)
        return np.where(self.near & (self.d < 0.0), thesis.grading(self.depth, beside, WIDER, grading), 0.0)


@pytest.fixture(scope="module")
def mixed() -> Sample:
    return sample(seed=33, particles=900)


@pytest.fixture(scope="module")
def wanted(mixed) -> Wanted:
    s = mixed
    normal, d, uvw = thesis.regions(s.triangles, s.x, s.air)
    inner, outer = (by_balloon(name, s.face_balloon)[:, None] for name in ("air_offset", "leak_offset"))
    near = s.same_cluster & (uvw.min(axis=2) > np.where(d < 0.0, -WIDER, -WIDER_OUTSIDE))
    near &= (d > -inner) & (d < outer)
    return Wanted(normal, d, uvw, near, np.clip(-d / inner, 0.0, 1.0))


def surface(s: Sample, device: str):
    faces = len(s.triangles)
    host = s.host() | {"face_normal": np.zeros((faces, 3)), "face_angles": np.zeros((faces, 3))}
    return launch(face_surface, device, faces, **host)


def everything(rows: int, columns: int, device: str):
    """Lists that leave nothing out: clusters and regions alone decide."""
    return listed([np.arange(columns, dtype=np.int32)] * rows, device)


def pressed_faces(s: Sample, device: str, grading: float, hits: float = 0.0):
    faces, quads = len(s.triangles), len(s.quads)
    count, table = everything(quads, len(s.air), device)
    host = s.host(grading=grading) | {
        "face_normal": surface(s, device)["face_normal"],
        "face_air_count": count,
        "face_air": table,
        "face_push": np.zeros((faces, 3)),
        "face_hits": np.full(faces, hits),
    }
    return launch(press_faces, device, quads, **host)


def pressed_vertices(s: Sample, device: str, grading: float):
    host = s.host() | surface(s, device)
    host |= {"face_push": pressed_faces(s, device, grading)["face_push"], "air_pull": np.zeros_like(s.x)}
    return launch(press_vertices, device, len(s.x), **host)["air_pull"]


def pressed_air(s: Sample, device: str, grading: float = 0.0):
    particles = len(s.air)
    count, table = everything(particles, len(s.triangles), device)
    host = s.host(grading=grading) | {
        "face_normal": surface(s, device)["face_normal"],
        "air_face_count": count,
        "air_faces": table,
        "wall_push": np.zeros_like(s.air),
        "repairs": np.zeros(particles, dtype=np.int32),
    }
    return launch(press_air, device, particles, **host)


def test_the_sample_has_air_in_many_regions_on_both_sides(mixed, wanted):
    for side in (wanted.d < 0.0, wanted.d > 0.0):
        assert np.count_nonzero((wanted.near & side).any(axis=0)) > 0.2 * len(mixed.air)


def test_shares_and_normals_of_the_reference_give_a_point_back(mixed, wanted):
    a, b, c = np.moveaxis(mixed.x[mixed.triangles], 1, 0)[:, :, None]
    on_plane = thesis.plane_point(*np.moveaxis(wanted.uvw, -1, 0), a, b, c)
    points = on_plane + wanted.d[..., None] * wanted.normal[:, None]
    assert np.abs(points - mixed.air).max() < 1e-9


@pytest.mark.parametrize("device", DEVICES)
def test_normals_and_angles_of_triangles_are_those_of_the_thesis(device, mixed, wanted):
    found = surface(mixed, device)
    assert off(found["face_normal"], wanted.normal) < 1e-5
    assert off(found["face_angles"], thesis.angles_of(mixed.triangles, mixed.x)) < 1e-5


@pytest.mark.parametrize("device", DEVICES)
def test_normals_of_a_capsule_point_outward(device, mixed):
    mesh = capsule_mesh(0.08, 0.0255, 12, (0.08,))
    host = mixed.host() | {"quads": mesh.quads, "x": mesh.points}
    none = np.zeros((2 * len(mesh.quads), 3))
    normal = launch(face_surface, device, len(none), **host | {"face_normal": none, "face_angles": none})
    middle = mesh.points[thesis.triangles_of(mesh.quads)].mean(axis=1)
    axis = np.column_stack([np.clip(middle[:, 0], 0.0255, 0.0545), np.zeros((len(middle), 2))])
    assert (thesis.dot(normal["face_normal"], middle - axis) > 0.0).all()


@pytest.mark.parametrize("grading", GRADINGS)
@pytest.mark.parametrize("device", DEVICES)
def test_air_pushes_on_the_corners_of_triangles_as_in_the_thesis(device, grading, mixed, wanted):
    share = np.einsum("tp,tpc->tc", wanted.push(grading), wanted.uvw)
    assert off(pressed_faces(mixed, device, grading)["face_push"], share) < 1e-5


@pytest.mark.parametrize("device", DEVICES)
def test_what_a_particle_pushes_with_is_shared_out_whole(device, mixed, wanted):
    found = pressed_faces(mixed, device, 0.0)
    assert np.array_equal(found["face_hits"], np.count_nonzero(wanted.push(0.0), axis=1))
    assert found["face_push"].sum(axis=1) == pytest.approx(found["face_hits"], abs=1e-5)


@pytest.mark.parametrize("device", DEVICES)
def test_hits_add_up_from_step_to_step(device, mixed):
    first, later = (pressed_faces(mixed, device, 0.7, hits)["face_hits"] for hits in (0.0, 10.0))
    assert later == pytest.approx(10.0 + first)


@pytest.mark.parametrize("grading", GRADINGS)
@pytest.mark.parametrize("device", DEVICES)
def test_air_pushes_on_the_rubber_as_in_the_thesis(device, grading, mixed, wanted):
    s = mixed
    angles = thesis.angles_of(s.triangles, s.x)
    pushes = thesis.pushes(s.triangles, angles, wanted.normal, wanted.push(grading), wanted.uvw)
    push = by_balloon("push", s.vertex_balloon)[:, None]
    assert off(pressed_vertices(s, device, grading), push * pushes) < 1e-5


@pytest.mark.parametrize("grading", GRADINGS)
@pytest.mark.parametrize("device", DEVICES)
def test_the_rubber_pushes_on_air_as_in_the_thesis(device, grading, mixed, wanted):
    s, push = mixed, wanted.push(grading)
    beta = by_balloon("beta", s.air_balloon)
    sums = [
        thesis.wall_force_sum(beta[p] * push[hit, p][:, None], wanted.normal[hit])
        for p, hit in enumerate((push > 0.0).T)
    ]
    assert off(pressed_air(s, device, grading)["wall_push"], np.array(sums)) < 1e-5


@pytest.mark.parametrize("device", DEVICES)
def test_leaked_air_comes_back_at_rest_as_in_the_thesis(device, mixed, wanted):
    s = mixed
    nearest, outside = thesis.leaked(wanted.d, wanted.near)
    assert 0.1 < outside.mean() < 0.9
    gamma = by_balloon("gamma", s.air_balloon)[:, None]
    back = thesis.leak_checked(s.air, gamma, wanted.normal[nearest], outside)
    after = pressed_air(s, device)
    assert np.array_equal(after["repairs"], outside)
    assert off(after["air"], back) < 1e-6
    assert off((after["air"] - s.air)[outside], (back - s.air)[outside]) < 1e-5
    assert np.array_equal(after["air"][~outside], s.air[~outside].astype(np.float32))
    assert not after["air_speed"][outside].any()
    assert np.array_equal(after["air_speed"][~outside], s.air_speed[~outside].astype(np.float32))


@pytest.mark.parametrize("device", DEVICES)
def test_air_does_not_feel_the_rubber_of_another_bubble(device, mixed):
    strangers = mixed.host()["air_cluster"] + 100
    alone = Sample(**(vars(mixed) | {"air_cluster": strangers}))
    assert not pressed_vertices(alone, device, 0.0).any()
    after = pressed_air(alone, device)
    assert not after["wall_push"].any()
    assert not after["repairs"].any()
