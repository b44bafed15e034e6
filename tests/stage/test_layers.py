"""What the guide for studios tells: its layers are composed here as they stand there."""

from __future__ import annotations

import re
import shutil
from collections import Counter
from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom, UsdShade

from balloon_usd.stage import write_stage
from tests.stage.selections import complaints
from tests.stage.tubes import frames, sculpture, tube_mesh

EXAMPLES = Path(__file__).parents[2] / "docs/examples"
GUIDE = Path(__file__).parents[2] / "docs/howto/studios.md"
FRAMES = 12
BLUE = (0.02, 0.1, 0.6)
NAMES = ("blue_dog.usda", "shelf.usda", "waxed_nose.usda", "every_dog.usda", "crowd.usda")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The asset of a red dog in two details, with the guide's layers beside it."""
    folder = tmp_path_factory.mktemp("studio")
    for detail, rings in (("full", 9), ("draft", 7)):
        names = ("nose", "left_ear", "right_ear")
        main = tube_mesh("main", names, rings, (0.8, 0.05, 0.08))
        object.__setattr__(main, "material", "latex_red")
        second = tube_mesh("second", ("stem", "petal"), rings, (0.1, 0.3, 0.7))
        write_stage(sculpture(meshes=(main, second)), frames(FRAMES, rings), folder, detail=detail)
    text = GUIDE.read_text(encoding="utf-8")
    for name in re.findall(r"^<!-- generated: example (\S+) -->$", text, re.MULTILINE):
        shutil.copy(EXAMPLES / name, folder)
    return folder


def opened(folder: Path, name: str) -> Usd.Stage:
    stage = Usd.Stage.Open(str(folder / name))
    assert stage.GetCompositionErrors() == []
    return stage


def material_of(stage: Usd.Stage, prim: str) -> UsdShade.Material:
    mesh = stage.GetPrimAtPath(f"{prim}/geo/render/main")
    return UsdShade.MaterialBindingAPI(mesh).ComputeBoundMaterial()[0]


def color_of(stage: Usd.Stage, prim: str) -> tuple[float, ...]:
    surface = material_of(stage, prim).ComputeSurfaceSource()[0]
    return tuple(surface.GetInput("diffuseColor").Get())


def points_of(stage: Usd.Stage, prim: str) -> Usd.Attribute:
    return UsdGeom.Mesh.Get(stage, f"{prim}/geo/render/main").GetPointsAttr()


def made(time_code: int) -> np.ndarray:
    return [*frames(FRAMES)][time_code - 1].points[0]


def test_the_readme_shows_all_layers(folder: Path) -> None:
    assert {file.name for file in folder.glob("*.usda")} == {*NAMES}


@pytest.mark.parametrize("name", NAMES)
def test_the_validators_of_usd_have_nothing_to_say(name: str, folder: Path) -> None:
    assert complaints(opened(folder, name)) == []


@pytest.mark.parametrize("name", NAMES)
def test_a_layer_lasts_as_long_as_the_dogs_in_it(name: str, folder: Path) -> None:
    dog = Sdf.Layer.FindOrOpen(str(EXAMPLES / "blue_dog.usda")).endTimeCode
    stage, latest = opened(folder, name), 0.0
    for mesh in (UsdGeom.Mesh(prim) for prim in Usd.PrimRange.Stage(stage, Usd.TraverseInstanceProxies())):
        times = mesh.GetPointsAttr().GetTimeSamples() if mesh else []
        if times:
            scale = (times[-1] - times[0]) / (FRAMES - 1)
            latest = max(latest, times[0] + scale * (dog - 1))
    assert stage.GetEndTimeCode() == latest


def test_a_stronger_layer_paints_the_sculpture(folder: Path) -> None:
    stage = opened(folder, "blue_dog.usda")
    assert color_of(stage, "/dog") == pytest.approx(BLUE)
    open_pbr = UsdShade.Shader.Get(stage, "/dog/mtl/latex_red/openpbr")
    assert tuple(open_pbr.GetInput("base_color").Get()) == pytest.approx(BLUE)
    assert tuple(open_pbr.GetInput("subsurface_color").Get()) == pytest.approx(BLUE)
    shown = UsdGeom.Mesh.Get(stage, "/dog/geo/render/main").GetDisplayColorAttr().Get()
    assert np.allclose(shown, [BLUE])
    assert points_of(stage, "/dog").GetTimeSamples() == [*range(1, FRAMES + 1)]
    untouched = Usd.Stage.Open(str(folder / "dog" / "dog.usda"))
    assert color_of(untouched, "/dog") == pytest.approx((0.8, 0.05, 0.08))


def test_one_bubble_gets_a_material_of_its_own(folder: Path) -> None:
    stage = opened(folder, "waxed_nose.usda")
    mesh = UsdShade.MaterialBindingAPI(stage.GetPrimAtPath("/dog/geo/render/main"))
    (subset,) = mesh.GetMaterialBindSubsets()
    nose = UsdGeom.Subset.Get(stage, "/dog/geo/render/main/nose").GetIndicesAttr().Get()
    assert len(nose) > 10
    assert (subset.GetPrim().GetName(), subset.GetIndicesAttr().Get()) == ("waxed", nose)
    bound = UsdShade.MaterialBindingAPI(subset.GetPrim()).ComputeBoundMaterial()[0]
    assert bound.GetPath() == "/dog/mtl/wax"
    assert material_of(stage, "/dog").GetPath() == "/dog/mtl/latex_red"


def test_a_reference_moves_a_copy_and_shifts_its_time(folder: Path) -> None:
    stage = opened(folder, "shelf.usda")
    points = points_of(stage, "/shelf/late")
    assert points.GetTimeSamples() == [48 + 2 * time for time in range(1, FRAMES + 1)]
    assert np.array_equal(points.Get(48 + 2 * 5), made(5))
    placed = UsdGeom.Xformable.Get(stage, "/shelf/late").ComputeLocalToWorldTransform(1)
    assert np.allclose(placed.Transform((0.1, 0.0, 0.0)), (0.0, 0.6, 0.0))


def test_a_reference_chooses_variants(folder: Path) -> None:
    stage = opened(folder, "shelf.usda")
    assert material_of(stage, "/shelf/late").GetPath() == "/shelf/late/mtl/chrome_red"
    still = points_of(stage, "/shelf/still")
    assert (still.GetNumTimeSamples(), np.array_equal(still.Get(), made(FRAMES))) == (0, True)
    stage.SetEditTarget(stage.GetSessionLayer())
    sets = stage.GetPrimAtPath("/shelf/still").GetVariantSets()
    sets.GetVariantSet("detail").SetVariantSelection("full")
    assert len(points_of(stage, "/shelf/still").Get()) == 9 * 8 + 2
    assert not points_of(stage, "/shelf/still").GetNumTimeSamples()


def test_a_copy_may_get_a_material_of_the_studio_s_own(folder: Path) -> None:
    stage = opened(folder, "shelf.usda")
    assert material_of(stage, "/shelf/still").GetPath() == "/shelf/mtl/wax"


def test_a_class_changes_every_copy_at_once(folder: Path) -> None:
    for name, rough in (("shelf.usda", 0.08), ("every_dog.usda", 0.3)):
        stage = opened(folder, name)
        for copy in ("late", "still"):
            foil = UsdShade.Shader.Get(stage, f"/shelf/{copy}/mtl/chrome_red/preview")
            assert foil.GetInput("roughness").Get() == pytest.approx(rough), (name, copy)


def test_a_sublayer_can_be_shifted_in_time(folder: Path) -> None:
    stage = opened(folder, "every_dog.usda")
    points = points_of(stage, "/shelf/late")
    assert points.GetTimeSamples() == [24 + 48 + 2 * time for time in range(1, FRAMES + 1)]


def test_instances_have_their_own_colour_look_time_and_place(folder: Path) -> None:
    stage = opened(folder, "crowd.usda")
    red, blue, clear = (stage.GetPrimAtPath(f"/crowd/dog_{number}") for number in range(3))
    assert all(prim.IsInstance() for prim in (red, blue, clear))
    assert color_of(stage, "/crowd/dog_0") == pytest.approx((0.8, 0.05, 0.08))
    assert color_of(stage, "/crowd/dog_1") == pytest.approx(BLUE)
    assert material_of(stage, "/crowd/dog_2").GetPrim().GetName() == "clear_red"
    assert points_of(stage, "/crowd/dog_1").GetTimeSamples() == [12 + t for t in range(1, FRAMES + 1)]
    assert np.array_equal(points_of(stage, "/crowd/dog_2").Get(24 + 5), made(5))
    place = UsdGeom.Xformable(clear).ComputeLocalToWorldTransform(1).ExtractTranslation()
    assert tuple(place) == (0.0, 0.8, 0.0)


def hundred(folder: Path) -> Usd.Stage:
    """The example's three dogs, over and over up to a hundred, each at its own place."""
    layer = Sdf.Layer.OpenAsAnonymous(str(folder / "crowd.usda"))
    for number in range(3, 100):
        copy = Sdf.Path(f"/crowd/dog_{number}")
        Sdf.CopySpec(layer, f"/crowd/dog_{number % 3}", layer, copy)
        layer.GetPrimAtPath(copy).attributes["xformOp:translate"].default = (0.0, 0.4 * number, 0.0)
    layer.Export(str(folder / "hundred.usd"))
    return opened(folder, "hundred.usd")


def test_a_hundred_copies_share_as_many_prototypes_as_there_are_kinds_of_them(folder: Path) -> None:
    stage = hundred(folder)
    dogs = stage.GetPrimAtPath("/crowd").GetChildren()
    shared = Counter(str(dog.GetPrototype().GetPath()) for dog in dogs)
    assert (len(dogs), len(stage.GetPrototypes()), sum(shared.values())) == (100, 3, 100)
    assert min(shared.values()) == 33
    places = {
        tuple(UsdGeom.Xformable(dog).ComputeLocalToWorldTransform(1).ExtractTranslation()) for dog in dogs
    }
    assert len(places) == 100
    (folder / "hundred.usd").unlink()


def test_each_offset_of_its_own_makes_a_prototype_of_its_own(folder: Path) -> None:
    layer = Sdf.Layer.OpenAsAnonymous(str(folder / "crowd.usda"))
    asset = str(folder / "dog" / "dog.usda")
    for number in range(3):
        references = layer.GetPrimAtPath(f"/crowd/dog_{number}").referenceList
        references.ClearEditsAndMakeExplicit()
        references.explicitItems.append(Sdf.Reference(asset, layerOffset=Sdf.LayerOffset(12.0)))
    stage = Usd.Stage.Open(layer)
    assert len(stage.GetPrototypes()) == 3
    for path in ("/crowd/dog_1", "/crowd/dog_2"):
        prim = layer.GetPrimAtPath(path)
        prim.inheritPathList.ClearEdits()
        prim.variantSelections.clear()
    assert len(stage.GetPrototypes()) == 1
    references.explicitItems[0] = Sdf.Reference(asset, layerOffset=Sdf.LayerOffset(13.0))
    assert len(stage.GetPrototypes()) == 2
