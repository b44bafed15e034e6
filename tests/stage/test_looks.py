from __future__ import annotations

import hashlib
import struct
import zlib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pytest
from pxr import Usd, UsdGeom, UsdShade

from balloon_usd import __version__
from balloon_usd.diff import differences
from balloon_usd.stage import StageError, write_stage
from balloon_usd.stage.properties import check_variants
from balloon_usd.stage.stretch_color import RAMP, stretch_colors
from balloon_usd.stage.wire_texture import CUT, LINE, SIDE, wire_png
from tests.stage.capsule import Capsule
from tests.stage.selections import complaints, every_selection
from tests.stage.tubes import Frame, frames, sculpture

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
    assert looks.GetVariantSelection() == ("thesis" if looks.GetVariantNames() else "")
    assert material_of(capsule, MAIN) == "/capsule/mtl/wire"
    assert is_visible(capsule, AIR)


@pytest.mark.parametrize(
    ("look", "bound", "shown"),
    [
        ("recipe", "latex_red", False),
        ("clear", "clear_red", True),
        ("chrome", "chrome_red", False),
        ("clay", "clay", False),
        ("stress", "stress", False),
        ("thesis", "wire", True),
    ],
)
@pytest.mark.parametrize("form", ["layered", "flat"])
def test_rubber_hides_the_air_unless_one_sees_through_it(
    look: str, bound: str, shown: bool, form: str, tmp_path: Path
) -> None:
    written = write_stage(Capsule().describe(), Capsule().frames(2), tmp_path, flat=form == "flat", look=look)
    stage = Usd.Stage.Open(str(written.files[0]))
    assert material_of(stage, MAIN) == f"/capsule/mtl/{bound}"
    assert is_visible(stage, MAIN)
    assert is_visible(stage, AIR) is shown
    assert UsdGeom.Mesh.Get(stage, MAIN).GetDoubleSidedAttr().Get() is shown


def test_a_stage_in_one_file_has_one_look_and_needs_no_composition(aired: Path) -> None:
    flat = Usd.Stage.Open(str(aired / "capsule.usdc"))
    assert flat.GetDefaultPrim().GetVariantSets().GetNames() == []
    assert flat.GetRootLayer().GetCompositionAssetDependencies() == []
    spec = flat.GetRootLayer().GetPrimAtPath(MAIN)
    assert spec.relationships["material:binding"].targetPathList.explicitItems == ["/capsule/mtl/wire"]


def test_every_look_of_every_detail_has_every_property(capsule: Usd.Stage) -> None:
    assert check_variants(capsule) == []


COLORED = ("recipe", "clear", "chrome")
LOOKS = {"recipe", "clear", "chrome", "clay", "print", "stress"}


def surface_of(stage: Usd.Stage, path: str) -> UsdShade.Shader:
    bound, _ = UsdShade.MaterialBindingAPI(stage.GetPrimAtPath(path)).ComputeBoundMaterial()
    return bound.ComputeSurfaceSource()[0]


def test_every_stage_has_looks_and_shows_the_recipe_s_colours(dog: Usd.Stage) -> None:
    looks = dog.GetDefaultPrim().GetVariantSet("look")
    assert {*looks.GetVariantNames()} == LOOKS
    assert looks.GetVariantSelection() == "recipe"
    color = surface_of(dog, "/dog/geo/render/main").GetInput("diffuseColor").Get()
    assert np.allclose(color, (0.8, 0.05, 0.08))


@pytest.mark.parametrize("look", COLORED)
def test_two_colours_stay_told_apart(look: str, dog: Usd.Stage) -> None:
    select(dog, look=look)
    paths = [f"/dog/geo/render/{name}" for name in ("main", "second")]
    assert [material_of(dog, path).rpartition("_")[2] for path in paths] == ["main", "second"]
    red, blue = (surface_of(dog, path).GetInput("diffuseColor").Get() for path in paths)
    assert red[0] > 2 * red[2]
    assert blue[2] > 2 * blue[0]


@pytest.mark.parametrize(
    ("look", "inputs"),
    [
        ("recipe", {"ior": 1.52, "clearcoat": 0.5}),
        ("clear", {"ior": 1.52, "opacity": 0.35}),
        ("chrome", {"metallic": 1.0, "roughness": 0.08}),
        ("clay", {"roughness": 1.0, "diffuseColor": (0.45, 0.45, 0.45)}),
    ],
)
def test_each_look_has_its_finish_and_openpbr_beside_it(
    look: str, inputs: dict[str, object], dog: Usd.Stage
) -> None:
    select(dog, look=look)
    surface = surface_of(dog, "/dog/geo/render/second")
    for name, value in inputs.items():
        assert np.allclose(surface.GetInput(name).Get(), value), name
    open_pbr = UsdShade.Shader(surface.GetPrim().GetParent().GetChild("openpbr"))
    assert open_pbr.GetShaderId() == "ND_open_pbr_surface_surfaceshader"
    color = open_pbr.GetInput("base_color").Get()
    assert color == surface.GetInput("diffuseColor").Get()


def stretched(count: int) -> Iterator[Frame]:
    """Frames whose stretch runs along the tubes and grows."""
    for frame in frames(count):
        along = np.linspace(1.0, 6.0, len(frame.stretch[0]), dtype=np.float32)
        yield replace(frame, stretch=(along + np.float32(0.1 * frame.time_code), along))


def test_stress_is_stretch_as_a_colour_at_every_vertex_and_time_code(tmp_path: Path) -> None:
    stage = Usd.Stage.Open(str(write_stage(sculpture(), stretched(5), tmp_path, look="stress").files[0]))
    color = UsdGeom.Mesh.Get(stage, "/dog/geo/render/main").GetDisplayColorPrimvar()
    assert color.GetInterpolation() == "vertex"
    assert color.GetTimeSamples() == [1, 2, 3, 4, 5]
    for frame in stretched(5):
        shown = color.ComputeFlattened(frame.time_code)
        assert np.array_equal(shown, stretch_colors(frame.stretch[0], 7.0))
    assert color.ComputeFlattened() == color.ComputeFlattened(5)
    assert color.GetAttr().GetDocumentation().endswith("1 dark blue, 4 pale yellow, 7 dark red.")
    (source,), _ = surface_of(stage, "/dog/geo/render/main").GetInput("diffuseColor").GetConnectedSources()
    assert UsdShade.Shader(source.source.GetPrim()).GetInput("varname").Get() == "displayColor"


@pytest.mark.parametrize("form", ["layered", "flat", "usdz"])
def test_only_a_layered_stage_numbers_its_colours_since_readers_of_one_layer_may_know_no_indices(
    form: str, tmp_path: Path
) -> None:
    one_layer = {form: True} if form != "layered" else {}
    written = write_stage(sculpture(), stretched(3), tmp_path, look="stress", **one_layer)
    stage = Usd.Stage.Open(str(written.files[0]))
    color = UsdGeom.Mesh.Get(stage, "/dog/geo/render/main").GetDisplayColorPrimvar()
    if form == "layered":
        assert np.array_equal(color.Get(), RAMP)
        assert (color.GetAttr().GetTimeSamples(), color.GetIndicesAttr().GetTimeSamples()) == ([], [1, 2, 3])
    else:
        assert not color.IsIndexed()
        assert color.GetAttr().GetTimeSamples() == [1, 2, 3]


def test_a_colour_of_a_layered_stage_takes_less_than_two_bytes_whatever_the_mesh(tmp_path: Path) -> None:
    rings, count, any_stretch = 1250, 20, np.random.default_rng(7)
    noise = [any_stretch.uniform(3.0, 5.0, 8 * rings + 2).astype(np.float32) for _ in range(count)]
    moving = (replace(f, stretch=(n, n)) for f, n in zip(frames(count, rings), noise, strict=True))
    write_stage(sculpture(rings), moving, tmp_path)
    colors = sum(len(n) for n in noise)
    assert (tmp_path / "dog" / "payload" / "draft_stress.usdc").stat().st_size < 2 * colors


def test_the_colours_of_stress_are_only_read_in_its_look(dog: Usd.Stage) -> None:
    def read() -> set[str]:
        return {Path(layer.realPath).name for layer in dog.GetUsedLayers() if layer.realPath}

    assert "draft_stress.usdc" not in read()
    assert not dog.GetAttributeAtPath("/dog/geo/render/main.primvars:displayColor").GetNumTimeSamples()
    select(dog, look="stress")
    assert "draft_stress.usdc" in read()


def test_a_flat_stage_holds_the_colours_of_stress_if_that_is_its_look(tmp_path: Path) -> None:
    flat, layered = (
        Usd.Stage.Open(str(write_stage(sculpture(), stretched(4), tmp_path, flat=f, look="stress").files[0]))
        for f in (True, False)
    )
    assert list(differences(flat, layered)) == []
    plain = write_stage(sculpture(), stretched(4), tmp_path, flat=True).files[0]
    assert not Usd.Stage.Open(str(plain)).GetDefaultPrim().GetVariantSets().GetNames()


@pytest.mark.parametrize("look", [*COLORED, "clay"])
def test_flat_and_layered_are_alike_in_every_look(look: str, tmp_path: Path) -> None:
    flat, layered = (
        Usd.Stage.Open(str(write_stage(sculpture(), frames(2), tmp_path, flat=f, look=look).files[0]))
        for f in (True, False)
    )
    assert list(differences(flat, layered)) == []


def test_another_look_of_the_next_run_keeps_the_other_details(tmp_path: Path) -> None:
    write_stage(sculpture(rings=9), frames(4, rings=9), tmp_path, detail="full", look="clay")
    written = write_stage(sculpture(), frames(4), tmp_path, look="chrome")
    assert written.stale == ()
    stage = Usd.Stage.Open(str(written.files[0]))
    assert stage.GetDefaultPrim().GetVariantSet("look").GetVariantSelection() == "chrome"


@pytest.mark.parametrize(
    ("choices", "message"),
    [
        ({"look": "crome"}, '"dog" has no look "crome", did you mean "chrome"?'),
        (
            {"look": "wood"},
            '"dog" has no look "wood", expected one of recipe, clear, chrome, clay, print, stress',
        ),
        ({"look": "thesis"}, '"dog" has no look "thesis" since it has no air, take "recipe"'),
        ({"flat": True, "usdz": True}, "flat and usdz exclude each other: a stage has one form at a time"),
        (
            {"shot": True, "usdz": True},
            "usdz and shot exclude each other: a shot refers to a stage whose z is up",
        ),
    ],
)
def test_what_a_stage_cannot_have_is_told_before_the_first_frame(
    choices: dict[str, Any], message: str, tmp_path: Path
) -> None:
    unasked = frames(2)
    with pytest.raises(StageError) as caught:
        write_stage(sculpture(), unasked, tmp_path, **choices)
    assert str(caught.value) == message
    assert next(unasked).time_code == 1
    assert list(tmp_path.iterdir()) == []


def test_looks_and_details_do_not_disturb_each_other(aired: Path) -> None:
    stage = Usd.Stage.Open(str(aired / "capsule" / "capsule.usda"))
    stage.SetEditTarget(stage.GetSessionLayer())
    for detail, vertices in (("draft", 42), ("full", 92)):
        for look, bound in (("recipe", "latex_red"), ("thesis", "wire")):
            select(stage, detail=detail, look=look)
            assert len(UsdGeom.Mesh.Get(stage, MAIN).GetPointsAttr().Get(2)) == vertices
            assert material_of(stage, MAIN) == f"/capsule/mtl/{bound}"
            assert is_visible(stage, AIR) is (look == "thesis")
    stage.GetSessionLayer().Clear()


def test_a_shot_may_choose_another_look(aired: Path, tmp_path: Path) -> None:
    stage = Usd.Stage.CreateNew(str(tmp_path / "shot.usda"))
    prim = stage.DefinePrim("/toy")
    prim.GetReferences().AddReference(str(aired / "capsule" / "capsule.usda"))
    prim.GetVariantSet("look").SetVariantSelection("recipe")
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
    assert list(differences(flat, layered)) == []


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
    select(stage, look="recipe")
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


def test_the_validators_of_usd_have_nothing_to_say_in_any_variant(dog: Usd.Stage, capsule: Usd.Stage) -> None:
    for stage in (dog, capsule):
        for chosen in every_selection(stage):
            assert complaints(stage) == [], chosen
