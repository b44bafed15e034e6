"""What is a balloon, and what is said of a mesh that is none."""

from __future__ import annotations

import sys
from pathlib import Path

import meshio
import numpy as np
import pytest

from balloon_usd.mesh_file.error import MeshFileError
from balloon_usd.mesh_file.read_shape import read_shape
from tests.mesh_file.shapes import ball, cube, heart_text, icosahedron, write_obj

RECIPES = Path(__file__).parents[2] / "recipes" / "meshes"


def test_the_shipped_heart_is_its_construction() -> None:
    assert (RECIPES / "heart.obj").read_text() == heart_text()


def test_quads_stay_as_they_are(tmp_path: Path) -> None:
    points, faces = cube()
    shape = read_shape(write_obj(tmp_path / "cube.obj", points, faces), 0.01)
    assert np.array_equal(shape.quads, faces)
    assert shape.volume == pytest.approx(8e-6)
    assert shape.area == pytest.approx(24e-4)
    assert shape.size == pytest.approx((0.02, 0.02, 0.02))


def test_triangles_are_cut_into_quads_without_a_change_of_shape(tmp_path: Path) -> None:
    points, faces = icosahedron()
    shape = read_shape(write_obj(tmp_path / "ico.obj", points, faces), 1.0)
    assert len(shape.quads) == 3 * len(faces)
    # Golden rectangles: volume and area of an icosahedron of edge 2.
    assert shape.volume == pytest.approx(5.0 / 12.0 * (3.0 + 5.0**0.5) * 8.0)
    assert shape.area == pytest.approx(20.0 * 3.0**0.5)


def test_a_shape_that_is_turned_inside_out_is_turned_back(tmp_path: Path) -> None:
    points, faces = icosahedron()
    shape = read_shape(write_obj(tmp_path / "ico.obj", points, [face[::-1] for face in faces]), 1.0)
    assert shape.volume > 0.0


@pytest.mark.parametrize("ending", [".ply", ".vtu", ".off", ".stl"])
def test_other_formats_hold_the_same_balloon(ending: str, tmp_path: Path) -> None:
    points, faces = icosahedron()
    file = tmp_path / f"ico{ending}"
    meshio.write(file, meshio.Mesh(points.astype(np.float32), [("triangle", np.array(faces))]))
    assert read_shape(file, 1.0).area == pytest.approx(20.0 * 3.0**0.5, rel=1e-6)


def test_points_that_no_face_names_are_left_out(tmp_path: Path) -> None:
    points, faces = cube()
    shape = read_shape(
        write_obj(tmp_path / "cube.obj", [(9, 9, 9), *points], [[c + 1 for c in f] for f in faces]), 1.0
    )
    assert len(shape.points) == 8
    assert shape.size == pytest.approx((2.0, 2.0, 2.0))


def test_splitting_keeps_the_shape_and_makes_four_of_each(tmp_path: Path) -> None:
    shape = read_shape(write_obj(tmp_path / "cube.obj", *cube()), 1.0)
    finer = shape.split()
    assert len(finer.quads) == 4 * len(shape.quads)
    assert (finer.volume, finer.area) == pytest.approx((shape.volume, shape.area))


def test_two_sheets_are_parted_by_some_air_and_their_rim_stays() -> None:
    heart = read_shape(RECIPES / "heart.obj", 0.01)
    assert heart.volume == pytest.approx(0.0, abs=1e-12)
    moved = heart.parted() - heart.points
    apart = np.abs(moved[:, 1])
    # Points of the file, and middles of their edges: 72 of them lie on the rim.
    assert (apart < 1e-9).sum() == 72
    assert apart[apart > 1e-9] == pytest.approx(apart.max())
    assert 0.5e-3 < apart.max() < 2e-3


def test_a_ball_is_not_parted() -> None:
    shape = ball(0.1, 6)
    assert np.array_equal(shape.parted(), shape.points)


def damaged(name: str) -> tuple[list[tuple[float, ...]], list[tuple[int, ...]]]:
    """A cube with one fault."""
    points, faces = (list(map(tuple, part)) for part in cube())
    moved = [(x + 5.0, y, z) for x, y, z in points]
    other = [tuple(corner + 8 for corner in face) for face in faces]
    faults = {
        "open": (points, faces[1:]),
        "doubled points": (
            [points[c] for f in faces for c in f],
            [tuple(range(4 * k, 4 * k + 4)) for k in range(6)],
        ),
        "face twice": (points, [*faces, faces[0][1:] + faces[0][:1]]),
        "turned": (points, [faces[0][::-1], *faces[1:]]),
        "two pieces": (points + moved, faces + other),
        "wall inside": (points, [*faces, (faces[0][0], faces[0][1], faces[5][2], faces[5][3])]),
        "one corner": (
            points + [(x + 2.0, y + 2.0, z + 2.0) for x, y, z in points],
            faces + [tuple(c + 8 if c + 8 != 8 else 7 for c in face) for face in faces],
        ),
        "no area": (
            [points[1], *points[1:]],
            [face for face in faces if 0 in face] + [f for f in faces if 0 not in f],
        ),
        "unknown point": (points, [(0, 1, 2, 99), *faces[1:]]),
        "corner twice": (points, [(0, 1, 1, 2), *faces[1:]]),
        "no number": ([(float("nan"), 0, 0), *points[1:]], faces),
        "five corners": (points, [(0, 1, 2, 3, 4)]),
        "no faces": (points, []),
    }
    return faults[name]


@pytest.mark.parametrize(
    ("fault", "message"),
    [
        ("open", r"^not closed: 4 edges have one face only, the first of points \d and \d: fill its holes$"),
        ("doubled points", r"^not closed: 24 edges have one face only, .*: merge its points by distance$"),
        ("face twice", r"^faces 1 and 7 are one face twice: delete one of them$"),
        ("turned", r"^faces 1 and \d are turned against each other: recalculate its normals to the outside$"),
        ("two pieces", r"^2 pieces that are not joined, expected one: give each a balloon$"),
        (
            "wall inside",
            r"^faces \d, \d, 7 meet at the edge of points \d and \d, expected two at every edge$",
        ),
        ("one corner", r"^two parts touch in point 8 alone, expected joined edges$"),
        ("no area", r"^face \d is a sliver, expected faces about as wide as long$|points inwards"),
        ("unknown point", r"^face 1 names a point that is not among its 8$"),
        ("corner twice", r"^face 1 has one point at two corners$"),
        ("no number", r"^point 1 is no number$"),
        ("five corners", r"^faces with 5 corners, expected triangles and quads$"),
        ("no faces", r"^no faces, expected a closed surface of triangles or quads$"),
    ],
)
def test_a_mesh_that_is_no_balloon_is_refused_with_its_fault(
    fault: str, message: str, tmp_path: Path
) -> None:
    with pytest.raises(MeshFileError, match=message):
        read_shape(write_obj(tmp_path / "cube.obj", *damaged(fault)), 0.01)


def test_a_quad_with_a_corner_that_points_inwards_is_refused(tmp_path: Path) -> None:
    points, faces = cube()
    points[0] = [0.9, 0.9, -1.0]
    with pytest.raises(MeshFileError, match=r"^face \d has a corner that points inwards: triangulate it$"):
        read_shape(write_obj(tmp_path / "cube.obj", points, faces), 0.01)


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("no.obj", None, r"^cannot be read \(No such file or directory\)$"),
        ("cube.blend", b"", r'^".blend" is no known format, expected one such as .obj, .ply or .stl$'),
        ("cube", b"", r'^"" is no known format'),
        ("cube.obj", b"\xff\xfe\x00", r"^cannot be read as obj$"),
        ("cube.obj", b"f 1 2\nv x y z\n", r"^cannot be read as obj$"),
        ("cube.obj", b"", r"^no points in space"),
        ("cube.ply", b"ply\nformat ascii 1.0\nelement ver", r"^cannot be read as ply$"),
        ("cube.vtu", b"<VTKFile", r"^cannot be read as vtu$"),
        ("cube.stl", b"\x00" * 90, r"^no points in space"),
    ],
)
def test_files_that_hold_no_mesh_are_refused(
    name: str, content: bytes | None, message: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    file = tmp_path / name
    if content is not None:
        file.write_bytes(content)
    with pytest.raises(MeshFileError, match=message):
        read_shape(file, 1.0)
    assert capfd.readouterr() == ("", "")


def test_too_many_faces_are_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("balloon_usd.mesh_file.read_shape.MOST_FACES", 5)
    with pytest.raises(MeshFileError, match=r"^6 faces, expected at most 5: simplify it$"):
        read_shape(write_obj(tmp_path / "cube.obj", *cube()), 1.0)


def test_without_meshio_its_remedy_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "meshio", None)
    with pytest.raises(MeshFileError, match=r"^meshio is not installed: pip install 'balloon-usd\[mesh\]'$"):
        read_shape(write_obj(tmp_path / "cube.obj", *cube()), 1.0)
