from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
import pytest

from balloon_usd.stage import AirDescription, MeshDescription, StageError, write_stage
from tests.stage.capsule import AirFrame, Capsule
from tests.stage.tubes import Frame, frames, sculpture, tube_mesh

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

MESH = tube_mesh("main", ("nose", "ear"), 5, (0.8, 0.1, 0.1))


def provenance(**more: str) -> dict[str, str]:
    return {"recipe": "dog.yaml", "recipe_sha256": "0", "solver": "latex", **more}


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"name": "../dog"}, '"../dog" cannot name a prim: use letters, digits and underscores'),
        ({"name": ""}, '"" cannot name a prim'),
        ({"meshes": ()}, '"dog" has no meshes'),
        ({"fps": 0.0}, '"dog": fps is 0.0'),
        ({"fps": float("nan")}, '"dog": fps is nan'),
        ({"meshes": (MESH, MESH), "bubble_names": ("nose", "ear")}, '"dog": name used twice: main'),
        ({"bubble_names": ("nose",), "meshes": (MESH,)}, "not among the sculpture's bubbles: ear"),
        ({"provenance": {"recipe": "dog.yaml"}}, 'provenance has no "recipe_sha256"'),
        ({"provenance": provenance(host_name="render07")}, 'provenance "host_name" depends on the run'),
        (
            {"provenance": provenance(recipe="/home/me/dog.yaml")},
            'provenance "recipe" holds an absolute path',
        ),
    ],
)
def test_a_description_that_cannot_be_written_is_refused(changes: dict[str, object], message: str) -> None:
    with pytest.raises(StageError) as caught:
        sculpture(**changes)  # type: ignore[arg-type]
    assert message in str(caught.value)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"name": "left ear"}, '"left ear" cannot name a prim'),
        ({"bubble_names": ("nose", "1ear")}, '"1ear" cannot name a prim'),
        ({"quads": np.zeros((0, 4), np.int32)}, 'mesh "main" has no quads'),
        ({"quads": MESH.quads[:, :3]}, "quads have shape (40, 3)"),
        ({"quads": MESH.quads - 1}, "negative vertex number"),
        ({"st": MESH.st[1:]}, "st has shape (39, 4, 2)"),
        ({"quad_bubble": MESH.quad_bubble[1:]}, "quad_bubble has shape (39,)"),
        ({"quad_bubble": MESH.quad_bubble + 1}, "quad_bubble points outside its 2 bubble names"),
        ({"color": (1.2, 0.0, 0.0)}, "colour (1.2, 0.0, 0.0) is not in 0..1"),
    ],
)
def test_a_mesh_that_does_not_fit_together_is_refused(changes: dict[str, object], message: str) -> None:
    with pytest.raises(StageError) as caught:
        replace(MESH, **changes)  # type: ignore[arg-type]
    assert message in str(caught.value)


def not_finite(frame: Frame) -> Frame:
    frame.points[1][3, 1] = np.nan
    return frame


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (not_finite, 'frame 3: points of "second" are not finite'),
        (lambda f: replace(f, time_code=7), "frame 7: expected time code 3"),
        (lambda f: replace(f, points=f.points[:1]), "frame 3: 1 meshes, expected 2"),
        (lambda f: replace(f, points=(f.points[0][1:], f.points[1])), 'points of "main" are float32 (57, 3)'),
        (
            lambda f: replace(f, pressure=f.pressure[:3]),
            "frame 3: pressure are float32 (3,), expected float32 (5,)",
        ),
        (lambda f: replace(f, volume=f.volume.astype(float)), "frame 3: volume are float64"),
        (
            lambda f: replace(f, stretch=(f.stretch[0], f.stretch[1] * np.inf)),
            'stretch of "second" are not finite',
        ),
    ],
)
def test_a_bad_frame_ends_the_run_and_leaves_nothing(
    spoil: Callable[[Frame], Frame], message: str, tmp_path: Path
) -> None:
    def spoilt() -> Iterator[Frame]:
        for frame in frames(5):
            yield spoil(frame) if frame.time_code == 3 else frame

    with pytest.raises(StageError) as caught:
        write_stage(sculpture(), spoilt(), tmp_path)
    assert message in str(caught.value)
    assert list(tmp_path.iterdir()) == []


def air_not_finite(frame: AirFrame) -> AirFrame:
    frame.air[0][3, 1] = np.inf
    return frame


def in_bubble(number: int) -> Callable[[AirFrame], AirFrame]:
    def spoil(frame: AirFrame) -> AirFrame:
        frame.cluster[0][7] = number
        return frame

    return spoil


@pytest.mark.parametrize(
    ("spoil", "message"),
    [
        (air_not_finite, 'frame 3: particles of "main_air" are not finite'),
        (in_bubble(2), 'frame 3: a particle of "main_air" is in bubble 2, expected 0 to 1'),
        (in_bubble(-1), 'frame 3: a particle of "main_air" is in bubble -1, expected 0 to 1'),
        (
            lambda f: replace(f, air=(f.air[0][1:],)),
            'frame 3: particles of "main_air" are float32 (23, 3), expected float32 (24, 3)',
        ),
        (
            lambda f: replace(f, air=(f.air[0].astype(float),)),
            'frame 3: particles of "main_air" are float64 (24, 3), expected float32 (24, 3)',
        ),
        (
            lambda f: replace(f, cluster=(f.cluster[0][1:],)),
            'frame 3: clusters of "main_air" are int32 (23,), expected int32 (24,)',
        ),
        (
            lambda f: replace(f, cluster=(f.cluster[0].astype(np.int64),)),
            'frame 3: clusters of "main_air" are int64 (24,), expected int32 (24,)',
        ),
        (
            lambda f: replace(f, air=()),
            "frame 3: particles of 0 and clusters of 1 balloons, expected 1",
        ),
        (
            lambda f: replace(f, cluster=f.cluster * 2),
            "frame 3: particles of 1 and clusters of 2 balloons, expected 1",
        ),
    ],
)
@pytest.mark.parametrize("flat", [False, True])
def test_bad_air_ends_the_run_and_leaves_nothing(
    spoil: Callable[[AirFrame], AirFrame], message: str, flat: bool, tmp_path: Path
) -> None:
    spoilt = (spoil(frame) if frame.time_code == 3 else frame for frame in Capsule().frames(5))
    with pytest.raises(StageError) as caught:
        write_stage(Capsule().describe(), spoilt, tmp_path, flat=flat)
    assert str(caught.value) == message
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("given", "message"),
    [
        (("left air", 8, 0.003), '"left air" cannot name a prim'),
        (("air", 0, 0.003), 'air "air" has 0 particles'),
        (("air", 8, 0.0), 'air "air": width is 0.0'),
        (("air", 8, float("nan")), 'air "air": width is nan'),
    ],
)
def test_air_that_cannot_be_drawn_is_refused(given: tuple[str, int, float], message: str) -> None:
    with pytest.raises(StageError) as caught:
        AirDescription(*given)
    assert message in str(caught.value)


def test_air_and_rubber_need_different_names() -> None:
    with pytest.raises(StageError, match='"capsule": name used twice: main'):
        Capsule().describe(airs=(AirDescription("main", 24, 0.003),))


def test_a_folder_in_the_place_of_the_texture_is_told_before_the_first_frame(tmp_path: Path) -> None:
    (tmp_path / "wire.png").mkdir()
    unasked = Capsule().frames(3)
    with pytest.raises(StageError, match=r"wire.png could not be written: a folder is in the way"):
        write_stage(Capsule().describe(), unasked, tmp_path, flat=True)
    assert next(unasked).time_code == 1


def test_a_first_time_code_below_one_is_refused(tmp_path: Path) -> None:
    with pytest.raises(StageError, match="frame 0: expected time code from 1 up"):
        write_stage(sculpture(), frames(2, first=0), tmp_path)


def test_no_frames_are_no_stage(tmp_path: Path) -> None:
    with pytest.raises(StageError, match='"dog": there are no frames'):
        write_stage(sculpture(), iter(()), tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("detail", ["", "a/b", "very full", "materials", "draft_finished"])
def test_a_detail_that_cannot_be_a_file_is_refused(detail: str, tmp_path: Path) -> None:
    with pytest.raises(StageError):
        write_stage(sculpture(), frames(2), tmp_path, detail=detail)


def test_a_mesh_knows_its_vertices() -> None:
    mesh: MeshDescription = MESH
    assert mesh.vertex_count == 42
    assert mesh.quads_at_vertex.sum() == 4 * len(mesh.quads)
