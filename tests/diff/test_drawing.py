"""Both stages side by side, and the page with all that differs."""

from __future__ import annotations

import base64
import re
from collections.abc import Callable
from html.parser import HTMLParser
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from pxr import Usd, UsdGeom

from balloon_usd.diff import DiffError, DiffNotWrittenError, compare_files
from balloon_usd.diff.drawing import draw_comparison, require_places
from balloon_usd.diff.moments import shown_moments
from balloon_usd.diff.ramp import STOPS, end_of_scale, linear, ramp
from balloon_usd.diff.sheet import HEAD, draw_sheet
from balloon_usd.diff.side_by_side import SideBySide
from balloon_usd.preview.contact_sheet import GUTTER, MARGIN
from balloon_usd.stage import write_stage
from tests.stage.tubes import frames, sculpture

SMALL = (96, 64)
Change = Callable[[Callable[[Usd.Stage], object]], Path]


@pytest.fixture(autouse=True)
def _small_pictures(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("balloon_usd.diff.sheet.SIZE", SMALL)


@pytest.fixture(scope="module")
def bulged(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The dog with a bulge in its first ear at frames 4 to 6, largest at 5."""
    moved = list(frames(12))
    for frame, by in ((moved[3], 1.1), (moved[4], 1.5), (moved[5], 1.2)):
        frame.points[0][20:36, 1:] *= np.float32(by)
    folder = tmp_path_factory.mktemp("bulged")
    return write_stage(sculpture(), iter(moved), folder, flat=True).files[0]


def test_first_worst_and_last_time_code_are_shown(written: Path, bulged: Path) -> None:
    assert shown_moments(compare_files(written / "dog.usdc", bulged), 1, 12) == (4, 5, 6)
    assert shown_moments(compare_files(bulged, bulged), 1, 12) == (1, 6, 12)


def test_both_stages_are_seen_from_the_same_place(written: Path, bulged: Path) -> None:
    drawn = SideBySide((written / "dog.usdc", bulged), SMALL, "cpu").draw(5, 0.02)
    first, second, apart = (picture.astype(int) for picture in drawn.pictures)
    # Floor and the tube that did not move stay where they are, apart from the shadow.
    assert 0.8 < (np.abs(first - second).max(axis=2) < 16).mean() < 0.99
    (frame,) = frames(1, first=5)
    radius = np.linalg.norm(frame.points[0][20:36, 1:], axis=1).max()
    assert drawn.distance == pytest.approx(0.5 * radius, rel=1e-4)
    # Where something moved, the third picture is warm, elsewhere it is grey.
    warm = apart[..., 0] - apart[..., 2] > 60
    assert 0.01 < warm.mean() < 0.3
    assert drawn.worst is not None
    x, y = (round(place) for place in drawn.worst)
    assert warm[max(y - 6, 0) : y + 7, max(x - 6, 0) : x + 7].any()


def test_what_did_not_move_has_no_colour(written: Path) -> None:
    drawn = SideBySide((written / "dog.usdc", written / "dog" / "dog.usda"), SMALL, "cpu").draw(5, 0.02)
    assert drawn.worst is None
    assert np.array_equal(drawn.pictures[0], drawn.pictures[1])
    apart = drawn.pictures[2].astype(int)
    assert (apart.max(axis=2) - apart.min(axis=2)).max() < 30


def test_other_vertices_are_measured_from_the_surface(written: Path, tmp_path: Path) -> None:
    write_stage(sculpture(rings=19), frames(12, rings=19), tmp_path, flat=True)
    drawn = SideBySide((written / "dog.usdc", tmp_path / "dog.usdc"), SMALL, "cpu").draw(5, 0.02)
    assert not drawn.lone
    assert 0.0 < drawn.distance < 0.005


def test_a_surface_that_only_the_second_stage_has_is_drawn_without_distance(
    written: Path, tmp_path: Path
) -> None:
    stage = Usd.Stage.Open(str(written / "dog.usdc"))
    flat = stage.Flatten()
    edited = Usd.Stage.Open(flat)
    edited.RemovePrim("/dog/geo/render/second")
    flat.Export(str(tmp_path / "one.usda"))
    drawn = SideBySide((tmp_path / "one.usda", written / "dog.usdc"), SMALL, "cpu").draw(5, 0.02)
    assert drawn.lone
    assert drawn.worst is None
    apart = drawn.pictures[2].astype(int)
    assert (apart[..., 2] - apart[..., 0] > 20).mean() > 0.03, "dark blue"


def test_points_that_are_not_finite_are_not_drawn(changed: Change, written: Path, tmp_path: Path) -> None:
    def break_it(stage: Usd.Stage) -> None:
        attribute = UsdGeom.Mesh.Get(stage, "/dog/geo/render/main").GetPointsAttr()
        points = np.array(attribute.Get(12))
        points[3] = np.nan
        attribute.Set(points, 12)

    comparison = compare_files(written / "dog.usdc", changed(break_it))
    with pytest.raises(
        DiffError, match=r"^time code 12 cannot be drawn: there are points that are not finite$"
    ):
        draw_comparison(comparison, png=tmp_path / "d.png", device="cpu")


def test_the_sheet_has_three_columns_and_a_scale(written: Path, bulged: Path) -> None:
    sheet = np.asarray(draw_sheet(compare_files(written / "dog.usdc", bulged), device="cpu"))
    assert sheet.shape[1] == 2 * MARGIN + 3 * SMALL[0] + 2 * GUTTER
    head = sheet[: MARGIN + HEAD].reshape(-1, 3)
    for color in STOPS:
        assert (np.abs(head.astype(int) - color).max(axis=1) <= 2).any(), color


def test_the_ramp_grows_darker_all_along() -> None:
    light = linear(ramp(np.linspace(0, 1, 50))) @ np.array([0.2126, 0.7152, 0.0722])
    assert (np.diff(light) < 0).all()


@pytest.mark.parametrize(
    ("largest", "end"),
    [
        (0.0, 1e-3),
        (0.005, 0.005),
        (0.00500001, 0.005),
        (0.0051, 0.006),
        (0.00062, 0.0008),
        (0.09, 0.1),
        (3, 3),
    ],
)
def test_the_scale_ends_at_a_round_number(largest: float, end: float) -> None:
    assert end_of_scale(largest) == pytest.approx(end)


class _Page(HTMLParser):
    def __init__(self, text: str) -> None:
        super().__init__()
        self.sources: list[str] = []
        self.text = ""
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.sources += [value or "" for name, value in attrs if name in {"src", "href"}]

    def handle_data(self, data: str) -> None:
        self.text += data


def test_the_page_stands_alone(written: Path, bulged: Path, tmp_path: Path) -> None:
    comparison = compare_files(written / "dog.usdc", bulged)
    draw_comparison(comparison, html=tmp_path / "d.html", png=tmp_path / "d.png", device="cpu")
    html = (tmp_path / "d.html").read_text(encoding="utf-8")
    page = _Page(html)
    (source,) = page.sources
    kind, _, data = source.partition(",")
    assert kind == "data:image/png;base64"
    with Image.open(BytesIO(base64.b64decode(data))) as inside, Image.open(tmp_path / "d.png") as beside:
        assert np.array_equal(np.asarray(inside), np.asarray(beside))
    assert not re.search(r"https?://", html)
    assert "The stages differ" in page.text
    for difference in comparison.differences:
        assert difference.text in page.text


def test_text_of_a_stage_cannot_become_markup(tmp_path: Path) -> None:
    files = [tmp_path / "one.usda", tmp_path / "other.usda"]
    for file, said in zip(files, ("plain", "<script>alert(1)</script>"), strict=True):
        stage = Usd.Stage.CreateNew(str(file))
        UsdGeom.Xform.Define(stage, "/a")
        stage.GetRootLayer().documentation = said
        stage.GetRootLayer().Save()
    draw_comparison(compare_files(*files), html=tmp_path / "d.html", device="cpu")
    html = (tmp_path / "d.html").read_text(encoding="utf-8")
    assert "<script>" not in html
    assert "&lt;script&gt;" in html
    assert "<img" not in html, "nothing to draw"


def test_a_picture_of_nothing_is_refused(tmp_path: Path) -> None:
    stage = Usd.Stage.CreateNew(str(tmp_path / "bare.usda"))
    UsdGeom.Xform.Define(stage, "/a")
    stage.GetRootLayer().Save()
    same = compare_files(tmp_path / "bare.usda", tmp_path / "bare.usda")
    with pytest.raises(DiffError, match=r"bare\.usda shows no mesh: there is nothing to draw$"):
        draw_comparison(same, png=tmp_path / "d.png", html=tmp_path / "d.html", device="cpu")
    assert [file.name for file in tmp_path.iterdir()] == ["bare.usda"]


def test_a_place_that_cannot_be_is_refused_before_anything_is_compared(tmp_path: Path) -> None:
    with pytest.raises(DiffError, match=r"a folder is in the way$"):
        require_places(None, tmp_path)
    with pytest.raises(DiffError, match=r"is not a folder$"):
        require_places(tmp_path / "none" / "d.png")


def test_a_full_disk_leaves_nothing_half_written(
    written: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: object) -> None:
        raise OSError(28, "No space left on device")

    same = compare_files(written / "dog.usdc", written / "dog.usdc")
    monkeypatch.setattr("pathlib.Path.replace", full)
    with pytest.raises(DiffNotWrittenError, match=r"d\.html cannot be written: No space left on device$"):
        draw_comparison(same, html=tmp_path / "d.html", device="cpu")
    assert [*tmp_path.iterdir()] == []
