from __future__ import annotations

import shutil
from typing import TYPE_CHECKING

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdValidation, Vt

from balloon_usd.diff import differences
from balloon_usd.stage.properties import (
    PROPERTIES,
    check_property,
    check_selections,
    check_stage,
    check_variants,
    same_bytes,
    whole_or_absent,
)
from tests.stage.damages import AIR, AIR_DAMAGES, DAMAGES, MAIN, air, normals, set_at, velocities, with_row

if TYPE_CHECKING:
    from pathlib import Path

    from tests.stage.damages import Damage

OF_A_STAGE = range(1, 26)
"""Properties that an open stage shows by itself."""


@pytest.fixture
def stage(written: Path, tmp_path: Path) -> Usd.Stage:
    """A copy of the flat dog, to be damaged."""
    return Usd.Stage.Open(str(shutil.copy(written / "dog.usdc", tmp_path / "copy.usdc")))


@pytest.mark.parametrize("number", OF_A_STAGE)
def test_a_layered_stage_has_the_property(number: int, dog: Usd.Stage) -> None:
    assert check_property(number, dog) == []


@pytest.mark.parametrize("number", OF_A_STAGE)
def test_a_flat_stage_has_the_property(number: int, stage: Usd.Stage) -> None:
    assert check_property(number, stage) == []


@pytest.mark.parametrize(("number", "what", "damage"), DAMAGES, ids=[f"{n}-{w}" for n, w, _ in DAMAGES])
def test_a_damaged_stage_is_found_out(number: int, what: str, damage: Damage, stage: Usd.Stage) -> None:
    damage(stage)
    findings = check_property(number, stage)
    assert findings
    assert {finding.number for finding in findings} == {number}


@pytest.fixture
def springs(aired: Path, tmp_path: Path) -> Usd.Stage:
    """A copy of the flat capsule with air, to be damaged."""
    shutil.copy(aired / "wire.png", tmp_path)
    return Usd.Stage.Open(str(shutil.copy(aired / "capsule.usdc", tmp_path / "copy.usdc")))


@pytest.mark.parametrize(
    ("number", "what", "damage"), AIR_DAMAGES, ids=[f"{n}-{w}" for n, w, _ in AIR_DAMAGES]
)
def test_damaged_air_is_found_out(number: int, what: str, damage: Damage, springs: Usd.Stage) -> None:
    damage(springs)
    if number == 1:
        springs.GetRootLayer().Save()
    findings = check_property(number, springs)
    assert findings
    assert {finding.number for finding in findings} == {number}


def test_one_width_may_be_given_for_all_particles(springs: Usd.Stage) -> None:
    widths = air(springs).GetWidthsAttr()
    widths.Set(list(widths.Get())[:1])
    assert [str(finding) for finding in check_property(23, springs)] == [
        f"property 23: {AIR}: 1 widths, expected 24"
    ]
    air(springs).SetWidthsInterpolation("constant")
    assert check_stage(springs) == []


@pytest.fixture
def layered(aired: Path, tmp_path: Path) -> Usd.Stage:
    """A copy of the layered capsule with air, whose layers may be damaged."""
    return Usd.Stage.Open(str(shutil.copytree(aired / "capsule", tmp_path / "capsule") / "capsule.usda"))


def materials(stage: Usd.Stage) -> Sdf.Layer:
    return Sdf.Layer.Find(
        str(stage.GetRootLayer().realPath).replace("capsule.usda", "payload/materials.usda")
    )


def without_look(look: str) -> Damage:
    def damage(stage: Usd.Stage) -> None:
        looks = materials(stage).GetPrimAtPath("/capsule").variantSets["look"]
        looks.RemoveVariant(looks.variants[look])

    return damage


def without_state(stage: Usd.Stage) -> None:
    states = stage.GetRootLayer().GetPrimAtPath("/capsule{detail=draft}").variantSets["state"]
    states.RemoveVariant(states.variants["finished"])


def clay_unbound(stage: Usd.Stage) -> None:
    mesh = materials(stage).GetPrimAtPath("/capsule{look=clay}geo/render/main")
    mesh.RemoveProperty(mesh.properties["material:binding"])


def moving_still(stage: Usd.Stage) -> None:
    file = stage.GetRootLayer().realPath.replace("capsule.usda", "payload/draft_geo.usdc")
    layer = Sdf.Layer.FindOrOpen(file)
    path = "/capsule/geo/render/main.points"
    layer.SetTimeSample(path, 1.0, layer.GetAttributeAtPath(path).default)


@pytest.mark.parametrize(
    ("damage", "told"),
    [
        (without_look("thesis"), "property 32: /capsule: variant set look lacks thesis"),
        (without_look("clear"), "property 32: /capsule: variant set look lacks clear"),
        (without_state, "property 32: /capsule: variant set state lacks finished"),
        (clay_unbound, "clay: property 22: /capsule/geo/render/main: no material"),
        (moving_still, "property 5: /capsule/geo/render/main at time code 1: 1 points samples in a still"),
    ],
    ids=["no thesis look", "no clear look", "no still", "a look is broken", "a still that moves"],
)
def test_what_is_wrong_with_a_variant_that_is_not_selected_is_found_out(
    damage: Damage, told: str, layered: Usd.Stage
) -> None:
    assert check_variants(layered) == []
    damage(layered)
    found = [str(finding) for finding in check_variants(layered)]
    assert any(text.endswith(told) for text in found), found
    assert all(text.startswith("property 32: ") for text in found)


def test_every_selection_of_nested_variants_is_looked_at(layered: Usd.Stage) -> None:
    found = [tuple(selection.items()) for selection, _, _ in check_selections(layered)]
    assert len(found) == len(set(found)) == 2 * 2 * 7
    assert dict(found[0]) == {"detail": "draft", "state": "made", "look": "thesis"}


def test_looking_at_the_variants_leaves_the_stage_as_it_is(layered: Usd.Stage) -> None:
    before = layered.ExportToString()
    assert check_variants(layered) == []
    assert layered.ExportToString() == before
    assert layered.GetDefaultPrim().GetVariantSet("look").GetVariantSelection() == "thesis"


def test_a_fault_in_the_samples_is_told_once_not_for_every_look(layered: Usd.Stage) -> None:
    samples = layered.GetRootLayer().realPath.replace("capsule.usda", "payload/draft_sim.usdc")
    path = "/capsule/geo/render/main.primvars:stretch"
    layer = Sdf.Layer.FindOrOpen(samples)
    layer.SetTimeSample(path, 3.0, Vt.FloatArray([np.nan] * len(layer.QueryTimeSample(path, 3.0))))
    found = [finding for _, _, findings in check_selections(layered) for finding in findings]
    assert [str(finding) for finding in found] == [f"property 13: {path} at time code 3: NaN or infinity"]


def test_a_default_above_samples_hides_them_and_is_found_out(layered: Usd.Stage) -> None:
    path = "/capsule/geo/render/main.primvars:stretch"
    layered.GetAttributeAtPath(path).Set(layered.GetAttributeAtPath(path).Get())
    text = "a default in capsule.usda hides the samples in draft_sim.usdc"
    assert f"property 5: {path}: {text}" in [str(finding) for finding in check_stage(layered)]


def test_a_layer_outside_of_the_folder_is_found_out(layered: Usd.Stage, tmp_path: Path) -> None:
    Sdf.Layer.CreateNew(str(tmp_path / "studio.usda")).Save()
    layered.GetRootLayer().subLayerPaths.append("../studio.usda")
    (finding,) = check_property(6, layered)
    assert finding.text == f"a layer outside the folder of the stage: {tmp_path / 'studio.usda'}"


def test_a_stage_without_variants_is_checked_once(stage: Usd.Stage) -> None:
    assert check_variants(stage) == []
    normals(stage)
    assert [finding.number for finding in check_variants(stage)] == [32]


def test_every_property_has_a_damage_that_shows_it() -> None:
    assert {number for number, _, _ in DAMAGES} == set(OF_A_STAGE)


def test_all_32_properties_say_how_they_are_tested() -> None:
    assert list(PROPERTIES) == list(range(1, 33))
    for number, told in PROPERTIES.items():
        assert told.says.endswith(".")
        assert told.where
        looks = (*told.of_stage, *told.of_values, *told.at_moments)
        assert bool(looks) == (number in OF_A_STAGE)
        for look in looks:
            assert f"Property {number}: " in str(look.__doc__)


@pytest.mark.parametrize("number", OF_A_STAGE)
def test_an_empty_stage_has_findings_but_no_crash(number: int) -> None:
    for finding in check_property(number, Usd.Stage.CreateInMemory()):
        assert str(finding).startswith("property ")


def test_right_velocities_are_no_finding(stage: Usd.Stage) -> None:
    velocities(1.0)(stage)
    assert check_stage(stage) == []


def test_a_finding_tells_where_and_when(stage: Usd.Stage) -> None:
    set_at("points", 7, with_row(2, np.nan))(stage)
    (finding,) = check_property(13, stage)
    assert str(finding) == f"property 13: {MAIN}.points at time code 7: NaN or infinity"


@pytest.mark.parametrize("file", ["dog/dog.usda", "dog.usdc"])
@pytest.mark.parametrize("detail", ["draft", "full"])
def test_the_validators_of_usd_have_nothing_to_say(file: str, detail: str, written: Path) -> None:
    stage = Usd.Stage.Open(str(written / file))
    stage.SetEditTarget(stage.GetSessionLayer())
    stage.GetDefaultPrim().GetVariantSet("detail").SetVariantSelection(detail)
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    assert len(validators) >= 20
    errors = UsdValidation.ValidationContext(validators).Validate(stage)
    # MaterialX is not part of the wheel, so its nodes are unknown to it.
    said = [text for text in (error.GetErrorAsString() for error in errors) if "'ND_open_pbr" not in text]
    assert said == []
    stage.GetSessionLayer().Clear()


def test_the_flat_stage_equals_the_composed_one(written: Path) -> None:
    composed = Usd.Stage.Open(str(written / "dog" / "dog.usda"))
    flat = Usd.Stage.Open(str(written / "dog.usdc"))
    assert list(differences(flat, composed)) == []


def test_a_flat_stage_that_is_not_the_composed_one_is_found_out(stage: Usd.Stage, dog: Usd.Stage) -> None:
    set_at("points", 5, with_row(0, 0.25))(stage)
    moved, changed = differences(stage, dog)
    assert moved.startswith(f"{MAIN}: nose moved 421 mm at 5")
    assert changed == f"{MAIN}.points: differ by up to 0.25 at 5; at 1 of 12 time codes"


def test_a_truncated_file_is_not_whole(written: Path, tmp_path: Path) -> None:
    whole = (written / "dog.usdc").read_bytes()
    (tmp_path / "dog.usdc").write_bytes(whole[: len(whole) // 2])
    assert [finding.number for finding in whole_or_absent(tmp_path, "dog")] == [30]


def test_an_asset_without_interface_or_payload_is_not_whole(written: Path, tmp_path: Path) -> None:
    shutil.copytree(written / "dog", tmp_path / "dog")
    assert list(whole_or_absent(tmp_path, "dog")) == []
    (tmp_path / "dog" / "payload" / "draft_sim.usdc").unlink()
    assert {finding.number for finding in whole_or_absent(tmp_path, "dog")} == {30}
    (tmp_path / "dog" / "dog.usda").unlink()
    assert [str(f) for f in whole_or_absent(tmp_path, "dog")] == [
        f"property 30: {tmp_path / 'dog'} has no interface file"
    ]


def test_a_missing_file_makes_two_runs_differ(written: Path, tmp_path: Path) -> None:
    shutil.copytree(written / "dog", tmp_path / "dog")
    (tmp_path / "dog" / "payload" / "full.usda").unlink()
    (finding,) = same_bytes(written / "dog", tmp_path / "dog")
    assert str(finding) == f"property 29: {tmp_path / 'dog' / 'payload' / 'full.usda'} is missing"
