from __future__ import annotations

import zipfile
from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom, UsdShade

from balloon_usd.stage import StageError, write_stage
from tests.stage.capsule import Capsule
from tests.stage.selections import complaints
from tests.stage.tubes import frames, sculpture

MAIN = "/dog/geo/render/main"


@pytest.fixture(scope="module")
def package(tmp_path_factory: pytest.TempPathFactory) -> Path:
    written = write_stage(sculpture(), frames(12), tmp_path_factory.mktemp("package"), usdz=True)
    assert [file.name for file in written.files] == ["dog.usdz"]
    assert [file.name for file in written.files[0].parent.iterdir()] == ["dog.usdz"]
    return written.files[0]


def test_a_package_is_one_crate_stored_where_it_can_be_mapped(package: Path) -> None:
    with zipfile.ZipFile(package) as archive:
        (entry,) = archive.infolist()
        assert archive.testzip() is None
    assert (entry.filename, entry.compress_type) == ("dog.usdc", zipfile.ZIP_STORED)
    assert package.read_bytes().index(b"PXR-USDC") % 64 == 0
    assert Sdf.ZipFile.Open(str(package)).GetFileNames() == ["dog.usdc"]


def test_a_package_says_nothing_of_the_run(package: Path) -> None:
    with zipfile.ZipFile(package) as archive:
        (entry,) = archive.infolist()
    assert entry.date_time == (1980, 1, 1, 0, 0, 0)


@pytest.mark.parametrize("look", ["recipe", "clear", "chrome", "clay", "print", "stress"])
def test_the_validators_of_usd_have_nothing_to_say(look: str, tmp_path: Path) -> None:
    stage = Usd.Stage.Open(str(write_stage(sculpture(), frames(3), tmp_path, usdz=True, look=look).files[0]))
    assert complaints(stage) == []


def test_the_sculpture_stands_upright_where_y_is_up(package: Path, dog: Usd.Stage) -> None:
    stage = Usd.Stage.Open(str(package))
    assert UsdGeom.GetStageUpAxis(stage) == "Y"
    assert UsdGeom.GetStageMetersPerUnit(stage) == 1.0
    for time in (1, 7, 12):
        original = np.asarray(UsdGeom.Mesh.Get(dog, MAIN).GetPointsAttr().Get(time))
        packed = UsdGeom.Mesh.Get(stage, MAIN)
        assert np.array_equal(packed.GetPointsAttr().Get(time), original)
        to_world = np.array(packed.ComputeLocalToWorldTransform(time))
        world = np.concatenate([original, np.ones((len(original), 1))], axis=1) @ to_world
        assert np.allclose(world[:, :3], original[:, [0, 2, 1]] * [1, 1, -1], atol=1e-9)


def test_a_package_has_the_whole_animation_and_one_look(package: Path) -> None:
    stage = Usd.Stage.Open(str(package))
    root = stage.GetDefaultPrim()
    assert root.GetVariantSets().GetNames() == []
    assert UsdGeom.Mesh.Get(stage, MAIN).GetPointsAttr().GetTimeSamples() == [*range(1, 13)]
    assert stage.GetPrimAtPath("/dog/mtl").GetAllChildrenNames() == ["latex_main", "latex_second"]
    bound, _ = UsdShade.MaterialBindingAPI(stage.GetPrimAtPath(MAIN)).ComputeBoundMaterial()
    assert bound.GetPath() == "/dog/mtl/latex_main"
    assert root.GetAssetInfoByKey("identifier").path == "./dog.usdz"


def test_a_package_of_a_sculpture_with_air_takes_the_recipe_s_colours_and_no_texture(tmp_path: Path) -> None:
    written = write_stage(Capsule().describe(), Capsule().frames(3), tmp_path, usdz=True)
    assert [file.name for file in tmp_path.iterdir()] == ["capsule.usdz"]
    stage = Usd.Stage.Open(str(written.files[0]))
    assert stage.GetPrimAtPath("/capsule/mtl").GetAllChildrenNames() == ["latex_red", "air"]
    assert stage.GetRootLayer().GetExternalAssetDependencies() == []
    assert complaints(stage) == []


def test_the_look_of_the_thesis_needs_a_texture_and_is_refused(tmp_path: Path) -> None:
    with pytest.raises(StageError) as caught:
        write_stage(Capsule().describe(), Capsule().frames(3), tmp_path, usdz=True, look="thesis")
    assert str(caught.value) == (
        '"capsule" has no look "thesis" since a usdz holds no textures, take "recipe"'
    )
    assert list(tmp_path.iterdir()) == []
