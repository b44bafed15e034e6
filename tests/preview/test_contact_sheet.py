from __future__ import annotations

import errno
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from PIL import Image
from pxr import Gf, Usd, UsdGeom, Vt

from balloon_usd.preview import PictureNotWrittenError, PreviewError, draw_contact_sheet, spread_moments
from balloon_usd.preview.png_file import write_png
from balloon_usd.stage import write_stage
from tests.stage.capsule import Capsule

SMALL = (96, 64)


@pytest.fixture(scope="module")
def stage_path(dog, tmp_path_factory):
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, "Z")
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    stage.SetStartTimeCode(1)
    stage.SetEndTimeCode(20)
    points, quads, _ = dog
    mesh = UsdGeom.Mesh.Define(stage, "/dog")
    mesh.CreateFaceVertexCountsAttr([4] * len(quads))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(quads.ravel()))
    mesh.CreateDisplayColorAttr([Gf.Vec3f(0.6, 0.01, 0.02)])
    for time in (1, 20):
        tall = points * np.float32([1, 1, 1 + time / 20])
        mesh.GetPointsAttr().Set(Vt.Vec3fArray.FromNumpy(tall), time)
    path = tmp_path_factory.mktemp("stage") / "dog.usdc"
    stage.Export(str(path))
    return path


def test_eight_moments_are_spread_from_the_first_frame_to_the_last():
    assert spread_moments(1, 141) == (1, 21, 41, 61, 81, 101, 121, 141)
    assert spread_moments(1, 4) == (1, 2, 3, 4)
    assert spread_moments(7, 7) == (7,)


def test_a_sheet_has_a_row_for_every_few_pictures(stage_path, tmp_path):
    path = draw_contact_sheet(
        stage_path, tmp_path / "sheet.png", frames=(1, 10, 20), columns=2, size=SMALL, device="cpu"
    )
    with Image.open(path) as sheet:
        assert sheet.format == "PNG"
        width, height = sheet.size
    assert 2 * 96 < width < 3 * 96
    assert 2 * 64 < height < 5 * 64


def test_the_same_stage_gives_the_same_bytes(stage_path, tmp_path):
    sheets = [
        draw_contact_sheet(stage_path, tmp_path / f"{n}.png", frames=(20,), size=SMALL, device="cpu")
        for n in (1, 2)
    ]
    assert sheets[0].read_bytes() == sheets[1].read_bytes()


def test_moments_differ(stage_path, tmp_path):
    sheet = draw_contact_sheet(
        stage_path, tmp_path / "sheet.png", frames=(1, 20), columns=2, size=SMALL, device="cpu"
    )
    with Image.open(sheet) as image:
        pixels = np.asarray(image).astype(int)
    left, right = pixels[70:134, 24:120], pixels[70:134, 134:230]
    assert np.abs(left - right).max() > 50


def picture_of(sheet, size=SMALL):
    """The first picture on a sheet."""
    with Image.open(sheet) as image:
        return np.asarray(image).astype(int)[70 : 70 + size[1], 24 : 24 + size[0]]


def test_a_sheet_shows_the_look_of_the_stage_or_the_one_asked_for(springs, tmp_path):
    own, thesis, latex = (
        picture_of(
            draw_contact_sheet(
                springs, tmp_path / f"{look}.png", frames=(8,), size=SMALL, look=look, device="cpu"
            )
        )
        for look in (None, "thesis", "recipe")
    )
    assert np.array_equal(own, thesis)
    is_red = latex[..., 0] > latex[..., 1] + 80
    is_blue = own[..., 2] > own[..., 0] + 40
    assert is_red.mean() > 0.15
    assert is_blue.any()
    assert not (latex[..., 2] > latex[..., 0] + 40).any()
    assert not (own[..., 0] > own[..., 1] + 150).any()


def test_a_stage_in_one_file_is_drawn_as_wire_too(springs, tmp_path):
    capsule = Capsule(n=4, along=10, grid=(12, 3, 3))
    flat = write_stage(capsule.describe(), capsule.frames(8), tmp_path, flat=True).files[0]
    of_layers, of_one_file = (
        picture_of(draw_contact_sheet(stage, tmp_path / "x.png", frames=(8,), size=SMALL, device="cpu"))
        for stage in (springs, flat)
    )
    assert np.array_equal(of_layers, of_one_file)


def test_looks_can_be_told_apart(two_tubes, tmp_path):
    """Foil has blacker shadows than latex, clay no colour, and through clear latex one sees the paper."""
    seen = {}
    for look in ("recipe", "clear", "chrome", "clay"):
        sheet = draw_contact_sheet(
            two_tubes, tmp_path / "x.png", frames=(12,), size=(240, 160), look=look, device="cpu"
        )
        seen[look] = picture_of(sheet, (240, 160))
    on_rubber = np.ptp(seen["recipe"], axis=2) > 60
    assert on_rubber.mean() > 0.05
    dark = {look: float(np.percentile(picture[on_rubber].mean(axis=1), 10)) for look, picture in seen.items()}
    assert dark["chrome"] < 0.8 * dark["recipe"]
    assert dark["clear"] > 1.5 * dark["recipe"]
    assert np.ptp(seen["clay"][on_rubber], axis=1).max() < 25
    for look in ("clear", "chrome"):
        rows = seen[look][on_rubber]
        assert (rows[:, 0] > rows[:, 2] + 15).any(), look
        assert (rows[:, 2] > rows[:, 0] + 15).any(), look


def test_stress_is_drawn_in_the_colours_of_each_frame(two_tubes, tmp_path):
    blue = []
    for time in (1, 12):
        sheet = draw_contact_sheet(
            two_tubes, tmp_path / "x.png", frames=(time,), size=SMALL, look="stress", device="cpu"
        )
        picture = picture_of(sheet)
        blue.append(float((picture[..., 2] > picture[..., 0] + 40).mean()))
    assert blue[0] > 0.1
    assert blue[1] < 0.5 * blue[0]


def test_clusters_change_colour_with_the_frames(springs, tmp_path):
    size = (240, 160)
    green = []
    for time in (4, 5):
        sheet = draw_contact_sheet(springs, tmp_path / "x.png", frames=(time,), size=size, device="cpu")
        picture = picture_of(sheet, size)
        green.append(bool((picture[..., 1] > picture[..., [0, 2]].max(axis=2) + 25).any()))
    assert green == [False, True]


def test_a_look_that_is_not_there_draws_nothing(stage_path, tmp_path):
    with pytest.raises(PreviewError, match='has no look "thesis"'):
        draw_contact_sheet(stage_path, tmp_path / "x.png", look="thesis", device="cpu")
    assert list(tmp_path.iterdir()) == []


def test_a_place_that_cannot_be_is_told_before_the_stage_is_read(tmp_path):
    (tmp_path / "taken.png").mkdir()
    for path, words in (
        (tmp_path / "taken.png", r"taken.png cannot be written: a folder is in the way"),
        (tmp_path / "no" / "x.png", r"x.png cannot be written: .*no is not a folder"),
    ):
        with pytest.raises(PreviewError, match=words):
            draw_contact_sheet(tmp_path / "no_stage.usda", path)


def test_two_runs_at_once_do_not_fight_over_one_sheet(tmp_path):
    size = (400, 400)
    images = [Image.effect_noise(size, sigma) for sigma in (40, 90)]
    with ThreadPoolExecutor(max_workers=8) as pool:
        jobs = [pool.submit(write_png, images[number % 2], tmp_path / "sheet.png") for number in range(32)]
        for job in jobs:
            job.result()
    assert [path.name for path in tmp_path.iterdir()] == ["sheet.png"]
    with Image.open(tmp_path / "sheet.png") as found:
        assert any(np.array_equal(found, image) for image in images)


def test_a_picture_that_cannot_be_written_is_another_error_and_leaves_nothing(tmp_path, monkeypatch):
    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("pathlib.Path.replace", full)
    with pytest.raises(PictureNotWrittenError, match=r"sheet.png cannot be written: No space left on device"):
        write_png(Image.new("RGB", (4, 4)), tmp_path / "sheet.png")
    assert list(tmp_path.iterdir()) == []


def test_a_sheet_that_cannot_be_written_leaves_nothing(stage_path, tmp_path):
    (tmp_path / "taken.png").mkdir()
    with pytest.raises(PreviewError, match="cannot be written"):
        draw_contact_sheet(stage_path, tmp_path / "taken.png", frames=(1,), size=SMALL, device="cpu")
    with pytest.raises(PreviewError, match="cannot be written"):
        draw_contact_sheet(stage_path, tmp_path / "no" / "x.png", frames=(1,), size=SMALL, device="cpu")
    assert [path.name for path in tmp_path.iterdir()] == ["taken.png"]


@pytest.mark.parametrize(
    ("wrong", "told"),
    [
        ({"columns": 0}, "0 pictures in a row"),
        ({"size": (0, 64)}, "pictures of 0 by 64 pixels"),
        ({"size": (10**6, 10**6)}, "expected 1 to 8192"),
        ({"view": "back"}, 'unknown view "back"'),
        ({"frames": [float("nan")]}, "expected some numbers"),
        ({"frames": []}, "expected some numbers"),
    ],
)
def test_pictures_without_size_view_or_moment_are_refused(stage_path, tmp_path, wrong, told):
    with pytest.raises(ValueError, match=told):
        draw_contact_sheet(stage_path, tmp_path / "sheet.png", device="cpu", **wrong)
    assert not (tmp_path / "sheet.png").exists()


def test_a_folder_of_layers_stands_for_its_stage_and_time_codes_may_be_numbers_of_numpy(tmp_path):
    written = write_stage(Capsule().describe(), Capsule().frames(2), tmp_path)
    options = {"frames": np.arange(1, 3), "size": SMALL, "device": "cpu"}
    sheet = draw_contact_sheet(written.files[0].parent, tmp_path / "sheet.png", **options)
    assert sheet.exists()
