from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom

from balloon_usd.stage import write_stage
from balloon_usd.stage.stretch_color import stretch_colors
from tests.stage.tubes import LENGTH, frames, sculpture

MAIN = "/dog/geo/render/main"


def select(stage: Usd.Stage, **variants: str) -> None:
    for name, variant in variants.items():
        assert stage.GetDefaultPrim().GetVariantSet(name).SetVariantSelection(variant)


def sampled(stage: Usd.Stage) -> list[str]:
    attributes = [a for prim in stage.TraverseAll() for a in prim.GetAttributes()]
    return [str(a.GetPath()) for a in attributes if a.GetNumTimeSamples()]


def test_a_stage_shows_the_sculpture_as_it_is_made(dog: Usd.Stage) -> None:
    state = dog.GetDefaultPrim().GetVariantSet("state")
    assert (state.GetVariantNames(), state.GetVariantSelection()) == (["finished", "made"], "made")
    assert f"{MAIN}.points" in sampled(dog)


@pytest.mark.parametrize("look", ["recipe", "clear", "chrome", "clay", "print", "stress"])
@pytest.mark.parametrize(("detail", "rings"), [("draft", 7), ("full", 9)])
def test_the_finished_sculpture_is_the_last_frame_without_any_sample(
    detail: str, rings: int, look: str, dog: Usd.Stage
) -> None:
    select(dog, detail=detail, look=look, state="finished")
    *_, last = frames(12, rings)
    mesh = UsdGeom.Mesh.Get(dog, MAIN)
    assert sampled(dog) == []
    assert np.array_equal(mesh.GetPointsAttr().Get(1), last.points[0])
    assert np.array_equal(UsdGeom.PrimvarsAPI(mesh).GetPrimvar("stretch").Get(), last.stretch[0])
    assert np.allclose(dog.GetDefaultPrim().GetAttribute("balloon_usd:pressure").Get(), last.pressure)
    if look == "stress":
        shown = mesh.GetDisplayColorPrimvar().ComputeFlattened()
        assert np.array_equal(shown, stretch_colors(last.stretch[0], 7.0))


def test_the_finished_sculpture_reads_no_samples_from_disk(dog: Usd.Stage) -> None:
    select(dog, state="finished")
    read = {Path(layer.realPath).name for layer in dog.GetUsedLayers() if layer.realPath}
    assert read == {"dog.usda", "draft_finished.usda", "draft_geo.usdc", "materials.usda"}


def test_each_state_tells_its_own_room_without_the_payload(written: Path) -> None:
    stage = Usd.Stage.Open(str(written / "dog" / "dog.usda"), Usd.Stage.LoadNone)
    stage.SetEditTarget(stage.GetSessionLayer())
    hints = {}
    for state in ("made", "finished"):
        select(stage, state=state)
        hints[state] = np.asarray(UsdGeom.ModelAPI(stage.GetDefaultPrim()).GetExtentsHint())
    *_, last = frames(12)
    corners = np.concatenate(last.points)
    assert np.array_equal(hints["finished"], [corners.min(axis=0), corners.max(axis=0)])
    assert (hints["made"][0] <= hints["finished"][0]).all()
    assert (hints["made"][1] >= hints["finished"][1]).all()
    assert hints["made"][1][1] > hints["finished"][1][1]
    assert hints["made"][1][0] < 1.1 * LENGTH
    stage.GetSessionLayer().Clear()


def test_a_payload_layer_can_be_opened_by_itself(written: Path) -> None:
    for name, moving in (("draft.usda", True), ("draft_finished.usda", False)):
        stage = Usd.Stage.Open(str(written / "dog" / "payload" / name))
        assert UsdGeom.Mesh.Get(stage, MAIN).GetPointsAttr().Get() is not None
        assert bool(sampled(stage)) is moving


def test_a_detail_that_lacks_a_file_goes_with_the_next_run(tmp_path: Path) -> None:
    for lacking in ("full_finished.usda", "full_stress.usdc", "full_geo.usdc"):
        write_stage(sculpture(rings=9), frames(3, rings=9), tmp_path, detail="full")
        (tmp_path / "dog" / "payload" / lacking).unlink()
        written = write_stage(sculpture(), frames(3), tmp_path)
        assert written.stale == ("full",), lacking


def test_an_asset_of_an_earlier_layout_goes_with_the_next_run(tmp_path: Path) -> None:
    write_stage(sculpture(rings=9), frames(3, rings=9), tmp_path, detail="full")
    samples = tmp_path / "dog" / "payload" / "full_sim.usdc"
    layer = Sdf.Layer.FindOrOpen(str(samples))
    facts = dict(layer.customLayerData)
    layer.customLayerData = {"balloon_usd": {**facts["balloon_usd"], "schema": 1}}
    layer.Save()
    del layer
    assert write_stage(sculpture(), frames(3), tmp_path).stale == ("full",)
