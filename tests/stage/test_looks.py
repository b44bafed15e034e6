from __future__ import annotations

import hashlib
import struct
import zlib
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdShade, UsdValidation

from balloon_usd import __version__
from balloon_usd.stage import write_stage
from balloon_usd.stage.properties import check_variants, flat_equals_composed
from balloon_usd.stage.wire_texture import CUT, LINE, SIDE, wire_png
from tests.stage.capsule import Capsule

if TYPE_CHECKING:
    from pytest_regressions.file_regression import FileRegressionFixture

MAIN, AIR = "/capsule/geo/render/main", "/capsule/geo/render/main_air"


def select(stage: Usd.Stage, **variants: str) -> None:
    for name, variant in variants.items():
        assert stage.GetDefaultPrim().GetVariantSet(name).SetVariantSelection(variant)


def material_of(stage: Usd.Stage, path: str) -> str:
    bound, _ = UsdShade.MaterialBindingAPI(stage.GetPrimAtPath(path)).ComputeBoundMaterial()
    return str(bound.GetPath())


def is_visible(stage: Usd.Stage, path: str) -> bool:
    return UsdGeom.Imageable(stage.GetPrimAtPath(path)).ComputeVisibility() != UsdGeom.Tokens.invisible


def grey_pixels(png: bytes) -> np.ndarray:
    """Decode an 8-bit grey PNG without filters."""
    assert png.startswith(b"\x89PNG\r\n\x1a\n")
    chunks, place = {}, 8
    while place < len(png):
        (length,) = struct.unpack(">I", png[place : place + 4])
        kind, data = png[place + 4 : place + 8], png[place + 8 : place + 8 + length]
        assert struct.unpack(">I", png[place + 8 + length : place + 12 + length]) == (
            zlib.crc32(kind + data),
        )
        chunks[kind], place = data, place + 12 + length
    width, height, depth, color = struct.unpack(">IIBB", chunks[b"IHDR"][:10])
    assert (depth, color) == (8, 0)
    rows = np.frombuffer(zlib.decompress(chunks[b"IDAT"]), dtype=np.uint8).reshape(height, width + 1)
    assert not rows[:, 0].any()
    return rows[:, 1:] / 255.0


def test_a_stage_with_air_is_shown_as_in_the_thesis(capsule: Usd.Stage) -> None:
    looks = capsule.GetDefaultPrim().GetVariantSet("look")
    assert looks.GetVariantNames() == ["latex", "thesis"]
    assert looks.GetVariantSelection() == "thesis"
    assert material_of(capsule, MAIN) == "/capsule/mtl/wire"
    assert is_visible(capsule, AIR)


def test_in_the_look_of_latex_the_rubber_hides_the_air(capsule: Usd.Stage) -> None:
    select(capsule, look="latex")
    assert material_of(capsule, MAIN) == "/capsule/mtl/latex_red"
    assert is_visible(capsule, MAIN)
    assert not is_visible(capsule, AIR)


def test_every_look_of_every_detail_has_every_property(capsule: Usd.Stage) -> None:
    assert check_variants(capsule) == []


def test_looks_and_details_do_not_disturb_each_other(aired: Path) -> None:
    stage = Usd.Stage.Open(str(aired / "capsule" / "capsule.usda"))
    stage.SetEditTarget(stage.GetSessionLayer())
    for detail, vertices in (("draft", 42), ("full", 92)):
        for look, bound in (("latex", "latex_red"), ("thesis", "wire")):
            select(stage, detail=detail, look=look)
            assert len(UsdGeom.Mesh.Get(stage, MAIN).GetPointsAttr().Get(2)) == vertices
            assert material_of(stage, MAIN) == f"/capsule/mtl/{bound}"
            assert is_visible(stage, AIR) is (look == "thesis")
    stage.GetSessionLayer().Clear()


def test_a_shot_may_choose_another_look(aired: Path, tmp_path: Path) -> None:
    stage = Usd.Stage.CreateNew(str(tmp_path / "shot.usda"))
    prim = stage.DefinePrim("/toy")
    prim.GetReferences().AddReference(str(aired / "capsule" / "capsule.usda"))
    prim.GetVariantSet("look").SetVariantSelection("latex")
    assert material_of(stage, "/toy/geo/render/main") == "/toy/mtl/latex_red"
    assert not is_visible(stage, "/toy/geo/render/main_air")


def test_the_wire_reads_its_texture_through_coordinates_within_each_quad(capsule: Usd.Stage) -> None:
    texture = UsdShade.Shader.Get(capsule, "/capsule/mtl/wire/texture")
    file = texture.GetInput("file").Get()
    assert file.path == "./wire.png"
    assert Path(file.resolvedPath).read_bytes() == wire_png()
    surface = UsdShade.Shader.Get(capsule, "/capsule/mtl/wire/preview")
    assert surface.GetInput("opacityThreshold").Get() == CUT
    name = UsdShade.Shader.Get(capsule, "/capsule/mtl/wire/place").GetInput("varname").Get()
    within = UsdGeom.PrimvarsAPI(capsule.GetPrimAtPath(MAIN)).GetPrimvar(name)
    assert within.GetInterpolation() == "faceVarying"
    quads = np.asarray(within.ComputeFlattened()).reshape(-1, 4, 2)
    assert len(quads) == len(Capsule().quads)
    assert (quads == [[0, 0], [1, 0], [1, 1], [0, 1]]).all()


def test_the_wire_is_seen_from_inside_too(capsule: Usd.Stage) -> None:
    assert UsdGeom.Mesh.Get(capsule, MAIN).GetDoubleSidedAttr().Get() is True


def test_the_texture_keeps_the_edges_of_a_quad_and_nothing_between() -> None:
    grey = grey_pixels(wire_png())
    assert grey.shape == (SIDE, SIDE)
    middle = (np.arange(SIDE) + 0.5) / SIDE
    inside = np.minimum(middle, 1 - middle) > LINE
    assert (grey[np.ix_(inside, inside)] < CUT).all()
    assert (grey[~inside] > CUT).all()
    assert (grey[:, ~inside] > CUT).all()
    assert 0.15 < (grey > CUT).mean() < 0.35


def test_the_texture_is_the_same_bytes_everywhere() -> None:
    digest = hashlib.sha256(wire_png()).hexdigest()
    assert digest == "5247c180536e18d893ef7c607d519baef5a737d845eb9b2f5f8be3dd69642b22"


def test_flat_and_layered_are_alike(aired: Path) -> None:
    flat, layered = (Usd.Stage.Open(str(aired / name)) for name in ("capsule.usdc", "capsule/capsule.usda"))
    assert list(flat_equals_composed(flat, layered)) == []


def test_the_flat_stage_takes_its_texture_along(tmp_path: Path) -> None:
    written = write_stage(Capsule().describe(), Capsule().frames(2), tmp_path, flat=True)
    assert written.files == (tmp_path / "capsule.usdc", tmp_path / "wire.png")
    assert sorted(file.name for file in tmp_path.iterdir()) == ["capsule.usdc", "wire.png"]


def test_an_asset_holds_its_texture_in_the_payload(tmp_path: Path) -> None:
    written = write_stage(Capsule().describe(), Capsule().frames(2), tmp_path)
    assert written.files[-1] == tmp_path / "capsule" / "payload" / "wire.png"
    assert all(file.is_file() for file in written.files)


@pytest.mark.parametrize("layer", ["capsule.usda", "payload/materials.usda"])
def test_text_layers_stay_as_they_are(
    layer: str, tmp_path: Path, file_regression: FileRegressionFixture
) -> None:
    write_stage(Capsule().describe(), Capsule().frames(3), tmp_path)
    text = (tmp_path / "capsule" / layer).read_text().replace(f'"{__version__}"', '"VERSION"')
    file_regression.check(text, extension=".usda", basename=Path(layer).stem)


def test_a_material_of_the_recipe_may_be_called_wire(tmp_path: Path) -> None:
    (mesh,) = Capsule().describe().meshes
    object.__setattr__(mesh, "material", "wire")
    stage = Usd.Stage.Open(
        str(write_stage(Capsule().describe(meshes=(mesh,)), Capsule().frames(2), tmp_path).files[0])
    )
    assert material_of(stage, MAIN) == "/capsule/mtl/wire"
    stage.SetEditTarget(stage.GetSessionLayer())
    select(stage, look="latex")
    assert material_of(stage, MAIN) == "/capsule/mtl/wire_2"
    stage.GetSessionLayer().Clear()


def test_the_texture_goes_with_the_air_but_somebody_elses_stays(tmp_path: Path) -> None:
    texture = tmp_path / "capsule" / "payload" / "wire.png"
    still = Capsule().describe(airs=())
    write_stage(Capsule().describe(), Capsule().frames(2), tmp_path)
    write_stage(still, Capsule().frames(2), tmp_path)
    assert not texture.exists()
    texture.write_bytes(b"mine")
    write_stage(still, Capsule().frames(2), tmp_path)
    assert texture.read_bytes() == b"mine"


@pytest.mark.parametrize("look", ["latex", "thesis"])
def test_the_validators_of_usd_have_nothing_to_say(look: str, capsule: Usd.Stage) -> None:
    select(capsule, look=look)
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    errors = UsdValidation.ValidationContext(validators).Validate(capsule)
    said = [text for text in (error.GetErrorAsString() for error in errors) if "'ND_open_pbr" not in text]
    assert said == []
