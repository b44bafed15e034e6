from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from pxr import Usd, UsdGeom

from balloon_usd.stage import write_stage
from balloon_usd.stage.properties import check_stage, check_variants
from tests.stage.capsule import Capsule
from tests.stage.tubes import frames, sculpture

if TYPE_CHECKING:
    from pathlib import Path


def variants_of(file: Path) -> tuple[list[str], str]:
    stage = Usd.Stage.Open(str(file))
    variants = stage.GetDefaultPrim().GetVariantSet("detail")
    return variants.GetVariantNames(), variants.GetVariantSelection()


def write(
    folder: Path, detail: str, rings: int = 7, count: int = 4, **changes: object
) -> tuple[Path, tuple[str, ...]]:
    written = write_stage(sculpture(rings, **changes), frames(count, rings), folder, detail=detail)  # type: ignore[arg-type]
    return written.files[0], written.stale


def test_the_detail_just_written_is_the_one_that_shows(tmp_path: Path) -> None:
    write(tmp_path, "full", rings=9)
    file, stale = write(tmp_path, "draft")
    assert variants_of(file) == (["draft", "full"], "draft")
    assert stale == ()


@pytest.mark.parametrize(("detail", "rings"), [("draft", 7), ("full", 9)])
def test_every_detail_has_every_property(detail: str, rings: int, dog: Usd.Stage) -> None:
    dog.GetDefaultPrim().GetVariantSet("detail").SetVariantSelection(detail)
    points = UsdGeom.Mesh.Get(dog, "/dog/geo/render/main").GetPointsAttr().Get()
    assert len(points) == rings * 8 + 2
    assert check_stage(dog) == []


def test_a_detail_written_again_replaces_itself_only(tmp_path: Path) -> None:
    write(tmp_path, "full", rings=9)
    kept = {file: file.read_bytes() for file in (tmp_path / "dog" / "payload").glob("full*")}
    write(tmp_path, "draft")
    file, _ = write(tmp_path, "draft", rings=5)
    assert variants_of(file)[0] == ["draft", "full"]
    assert len(kept) == 5
    assert all(file.read_bytes() == content for file, content in kept.items())


@pytest.mark.parametrize(
    "changes",
    [
        {"provenance": {"recipe": "dog.yaml", "recipe_sha256": "1" * 64, "solver": "latex"}},
        {"meshes": sculpture().meshes[:1], "bubble_names": sculpture().meshes[0].bubble_names},
        {"count": 5},
        {"fps": 30.0},
    ],
    ids=["recipe", "balloons", "length", "rate"],
)
def test_a_detail_of_another_sculpture_goes_and_is_named(changes: dict[str, object], tmp_path: Path) -> None:
    write(tmp_path, "full")
    description = sculpture(**{key: value for key, value in changes.items() if key != "count"})  # type: ignore[arg-type]
    count = int(str(changes.get("count", 4)))
    bubbles = len(description.bubble_names)
    cut = (
        type(f)(f.time_code, f.points[: len(description.meshes)], f.stretch[: len(description.meshes)],
                f.pressure[:bubbles], f.volume[:bubbles])
        for f in frames(count)
    )  # fmt: skip
    written = write_stage(description, cut, tmp_path)
    assert written.stale == ("full",)
    assert variants_of(written.files[0]) == (["draft"], "draft")
    assert not list((tmp_path / "dog").rglob("full*"))


def test_what_people_put_into_the_folder_stays(tmp_path: Path) -> None:
    write(tmp_path, "draft")
    (tmp_path / "dog" / "notes").mkdir()
    (tmp_path / "dog" / "notes" / "todo.txt").write_text("paint the nose")
    (tmp_path / "dog" / "dog_shot.usda").write_text("#usda 1.0\n")
    write(tmp_path, "draft", rings=5)
    assert (tmp_path / "dog" / "notes" / "todo.txt").read_text() == "paint the nose"
    assert (tmp_path / "dog" / "dog_shot.usda").read_text() == "#usda 1.0\n"


@pytest.mark.parametrize("damage", ["", "no usda at all", "#usda 1.0\n"])
def test_a_damaged_interface_file_is_replaced(damage: str, tmp_path: Path) -> None:
    file, _ = write(tmp_path, "full")
    file.write_text(damage)
    file, _ = write(tmp_path, "draft")
    assert variants_of(file) == (["draft"], "draft")
    assert check_stage(Usd.Stage.Open(str(file))) == []


def test_a_detail_whose_samples_are_damaged_goes(tmp_path: Path) -> None:
    write(tmp_path, "full")
    (tmp_path / "dog" / "payload" / "full_sim.usdc").write_bytes(b"PXR-USDC")
    _, stale = write(tmp_path, "draft")
    assert stale == ("full",)


def test_flat_and_layered_stand_side_by_side(written: Path) -> None:
    assert (written / "dog.usdc").is_file()
    assert (written / "dog" / "dog.usda").is_file()


def test_details_of_a_stage_with_air_stand_side_by_side_though_they_have_other_particles(
    tmp_path: Path,
) -> None:
    for detail, grid in (("full", (8, 3, 3)), ("draft", (6, 2, 2))):
        capsule = Capsule(grid=grid)
        written = write_stage(capsule.describe(), capsule.frames(3), tmp_path, detail=detail)
    assert written.stale == ()
    assert variants_of(written.files[0]) == (["draft", "full"], "draft")
    assert check_variants(Usd.Stage.Open(str(written.files[0]))) == []


def test_a_detail_without_air_does_not_stay_beside_one_with_air(tmp_path: Path) -> None:
    write_stage(Capsule().describe(airs=()), Capsule().frames(3), tmp_path, detail="full")
    written = write_stage(Capsule().describe(), Capsule().frames(3), tmp_path)
    assert written.stale == ("full",)
    assert check_variants(Usd.Stage.Open(str(written.files[0]))) == []
