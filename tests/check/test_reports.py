"""What a report tells: where, when, in which variants, what to do, and what does not count."""

from __future__ import annotations

import json
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest
from pxr import Sdf, Usd, UsdGeom

from balloon_usd.check import check_file, document_of, text_of
from balloon_usd.check.frozen import frames_to_freeze, frozen
from balloon_usd.check.noise import BROKE_DOWN, REPEATED, SPECULATIVE, UNKNOWN_NODE, why_not_counted
from balloon_usd.files.lock import hold
from balloon_usd.stage import write_stage
from balloon_usd.stage.workspace import LOCK
from tests import interruptible
from tests.check.layered_damages import MAIN, edited, first_row, sample, unbound
from tests.stage.tubes import frames, sculpture

ROOT = Path(__file__).parents[2]


def test_a_fault_has_prim_time_variants_and_remedy(details: Path) -> None:
    sample("payload/full_sim.usdc", f"{MAIN}.primvars:stretch", 7, first_row(np.nan))(details)
    (fault,) = check_file(str(details)).found
    assert (fault.by, fault.rule, fault.prim) == ("balloon_usd", "13", f"{MAIN}.primvars:stretch")
    assert (fault.time_code, fault.variants) == (7.0, "detail=full")
    assert fault.text == "NaN or infinity"
    assert fault.remedy.startswith("simulate again")


def test_a_fault_of_one_look_is_told_with_the_look(dog: Path) -> None:
    unbound("clay")(dog)
    (fault,) = (fault for fault in check_file(str(dog)).found if fault.rule == "22")
    assert (fault.prim, fault.variants, fault.text) == (MAIN, "look=clay", "no material")


def test_a_fault_that_shows_in_every_variant_is_told_once(dog: Path) -> None:
    edited("payload/materials.usda", lambda stage: stage.OverridePrim("/dog/ghost"))(dog)
    found = [fault for fault in check_file(str(dog)).found if fault.rule == "7"]
    assert [(fault.prim, fault.variants) for fault in found] == [("/dog/ghost", "")]


def test_every_variant_and_three_frames_are_looked_at(details: Path) -> None:
    report = check_file(str(details))
    assert len(report.selections) == 2 * 2 * 6
    assert report.selections[0] == "detail=draft state=made look=recipe"
    assert report.frames == [1.0, 7.0, 12.0]
    assert report.validators[0].startswith("usd-core ")


def test_text_shows_three_faults_of_a_kind_and_counts_the_others(dog: Path) -> None:
    for time in range(2, 8):
        sample("payload/draft_sim.usdc", f"{MAIN}.extent", time, lambda e: e * np.float32(1.2))(dog)
    text = text_of(check_file(str(dog)))
    assert text.count("extent is loose") == 3
    assert "    and 3 more" in text
    assert "  property 14: Extent per sample, enclosing and tight." in text
    assert text.count("remedy: author extent as the smallest and largest corner") == 1


def test_what_does_not_count_is_said(stages: Path) -> None:
    report = check_file(str(stages / "dog.usdc"))
    assert report.not_counted[UNKNOWN_NODE] >= 4
    assert f"not counted: {report.not_counted[UNKNOWN_NODE]} x {UNKNOWN_NODE}" in text_of(report)


def test_only_noise_is_not_counted() -> None:
    said = (
        "shaderId 'ND_open_pbr_surface_surfaceshader' specified on shader prim </a> not found in sdrRegistry."
    )
    assert why_not_counted("usdShadeValidators:ShaderSdrCompliance", said) == UNKNOWN_NODE
    assert why_not_counted("usdShadeValidators:ShaderSdrCompliance", said.replace("ND_", "Own")) == ""
    assert why_not_counted("IndexedPrimvarChecker", "primvars:st contains repeated values") == REPEATED
    assert why_not_counted("DanglingOverPrimChecker", "Prim has an dangling over") == SPECULATIVE
    assert why_not_counted("ExtentsChecker", "Uncaught error: object has no len()") == BROKE_DOWN
    assert why_not_counted("ExtentsChecker", "Incorrect extent value for prim") == ""


def test_a_validator_of_usd_core_is_told_with_its_rule(dog: Path) -> None:
    def nest(stage: Usd.Stage) -> None:
        UsdGeom.Sphere.Define(stage, f"{MAIN}/knot")

    edited("dog.usda", nest)(dog)
    found = {(fault.by, fault.rule) for fault in check_file(str(dog)).found}
    assert any(by == "usd-core" and "Encapsulation" in rule for by, rule in found)
    assert ("balloon_usd", "23") in found


def test_a_frozen_frame_has_its_values_and_no_samples(stages: Path) -> None:
    stage = Usd.Stage.Open(str(stages / "dog" / "dog.usda"))
    points = stage.GetAttributeAtPath(f"{MAIN}.points")
    wanted = np.array(points.Get(7))
    assert frames_to_freeze(stage) == [1.0, 7.0, 12.0]
    with frozen(stage, 7.0):
        assert points.GetNumTimeSamples() == 0
        assert np.array_equal(points.Get(), wanted)
        moving = [a for p in stage.TraverseAll() for a in p.GetAuthoredAttributes() if a.GetNumTimeSamples()]
        assert moving == []
    assert points.GetNumTimeSamples() == 12


def test_a_run_that_is_writing_now_has_left_nothing(stages: Path, tmp_path: Path) -> None:
    shutil.copy(stages / "dog.usdc", tmp_path)
    folder = tmp_path / ".dog.a1b2c3d4.writing"
    folder.mkdir()
    lock = hold(folder / LOCK)
    assert check_file(str(tmp_path / "dog.usdc")).found == []
    lock.close()
    (fault,) = check_file(str(tmp_path / "dog.usdc")).found
    assert fault.text == f"a killed run has left {folder}"


def test_checking_changes_no_file(dog: Path) -> None:
    before = {file: (file.read_bytes(), file.stat().st_mtime_ns) for file in dog.rglob("*") if file.is_file()}
    check_file(str(dog))
    after = {file: (file.read_bytes(), file.stat().st_mtime_ns) for file in dog.rglob("*") if file.is_file()}
    assert after == before
    assert [file.name for file in dog.parent.iterdir()] == ["dog"]


def test_the_document_holds_everything_as_plain_data(dog: Path) -> None:
    sample("payload/draft_sim.usdc", f"{MAIN}.points", 6, first_row(0.9))(dog)
    document = document_of([check_file(str(dog)), check_file("gone.usda")])
    assert json.loads(json.dumps(document, allow_nan=False)) == document
    assert document["format"] == 1
    assert sorted(document["not_tested"], key=int) == ["26", "27", "28", "29"]
    found, unreadable = document["stages"]
    assert (found["result"], found["kind"], unreadable["result"]) == ("faults", "asset", "unreadable")
    (teleport,) = (fault for fault in found["faults"] if fault["rule"] == "19" and fault["time_code"] == 6.0)
    assert sorted(teleport) == ["by", "prim", "remedy", "rule", "text", "time_code", "variants"]
    assert unreadable["unreadable"] == '"gone.usda": no such file or folder'


def other_software(path: Path, edit: str) -> Path:
    """A stage as other software writes it: centimetres, Y up, normals, no kind, no bubbles."""
    stage = Usd.Stage.CreateNew(str(path))
    mesh = UsdGeom.Mesh.Define(stage, "/World/thing")
    mesh.CreatePointsAttr([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    if edit != "no faces":
        mesh.CreateFaceVertexCountsAttr([3])
        mesh.CreateFaceVertexIndicesAttr([0, 1, 2])
    if edit == "odd primvars":
        api = UsdGeom.PrimvarsAPI(mesh)
        for kind, value in (
            ("string", "a"),
            ("matrix4d[]", None),
            ("token[]", ["b"]),
            ("double3", (1, 2, 3)),
        ):
            name = f"odd_{kind.rstrip('[]')}"
            primvar = api.CreatePrimvar(name, Sdf.ValueTypeNames.Find(kind), "faceVarying")
            if value is not None:
                primvar.Set(value)
        mesh.CreateNormalsAttr([(0, 0, 1)] * 3)
    if edit == "odd head":
        stage.GetRootLayer().customLayerData = {"balloon_usd": "text"}
        stage.SetTimeCodesPerSecond(0)
        stage.SetEndTimeCode(1e12)
    if edit == "odd faces":
        mesh.CreateFaceVertexCountsAttr([3, 0, -1, 2**31 - 1])
        mesh.CreateFaceVertexIndicesAttr([0, -7, 2**31 - 1])
    if edit == "no points":
        mesh.GetPrim().RemoveProperty("points")
    if edit == "curves":
        curves = UsdGeom.BasisCurves.Define(stage, "/World/hair")
        curves.CreatePointsAttr([(0, 0, 0)] * 4)
        curves.CreateCurveVertexCountsAttr([4])
        UsdGeom.PointInstancer.Define(stage, "/World/many")
    if edit == "one sample":
        mesh.GetPointsAttr().Set([(0, 0, 0), (1, 0, 0), (0, 1, 0)], 5)
        mesh.GetPointsAttr().Set([(0, 0, 0), (1, 0, 0)], 6)
    stage.GetRootLayer().Save()
    return path


@pytest.mark.parametrize(
    "edit", ["", "no faces", "no points", "odd primvars", "odd head", "odd faces", "curves", "one sample"]
)
def test_stages_of_other_software_get_faults_and_no_crash(edit: str, tmp_path: Path) -> None:
    report = check_file(str(other_software(tmp_path / "thing.usda", edit)))
    assert report.unreadable == ""
    assert {"2", "3", "5"} <= {fault.rule for fault in report.found}
    assert all(fault.text and fault.remedy for fault in report.found)
    assert text_of(report)


@pytest.mark.parametrize(
    "found", ["float[]", "string[]", "string", "int", "double3[]", "asset", "matrix4d", "float4[]"]
)
@pytest.mark.parametrize(
    "name", ["points", "extent", "faceVertexIndices", "velocities", "primvars:displayColor"]
)
def test_a_value_of_another_type_than_the_schema_says_is_told(name: str, found: str, tmp_path: Path) -> None:
    path = other_software(tmp_path / "thing.usda", "")
    layer = Sdf.Layer.FindOrOpen(str(path))
    mesh = layer.GetPrimAtPath("/World/thing")
    if name in mesh.attributes:
        mesh.RemoveProperty(mesh.attributes[name])
    attribute = Sdf.AttributeSpec(mesh, name, Sdf.ValueTypeNames.Find(found))
    attribute.default = Sdf.ValueTypeNames.Find(found).defaultValue
    layer.Save()
    (told,) = (f for f in check_file(str(path)).found if f.rule == "20" and "nothing reads" in f.text)
    assert (told.prim, told.text) == (f"/World/thing.{name}", f"is of type {found}, which nothing reads")


def test_a_studio_may_offset_a_sculpture_and_show_it_finished(stages: Path, tmp_path: Path) -> None:
    shutil.copytree(stages / "dog", tmp_path / "assets" / "dog")
    (tmp_path / "shots").mkdir()
    shot = Usd.Stage.CreateNew(str(tmp_path / "shots" / "zoo.usda"))
    shot.GetRootLayer().TransferContent(Sdf.Layer.FindOrOpen(str(stages / "dog_shot.usda")))
    sculpture = shot.GetPrimAtPath("/shot/sculpture")
    sculpture.GetReferences().SetReferences(
        [Sdf.Reference("../assets/dog/dog.usda", layerOffset=Sdf.LayerOffset(10.5))]
    )
    still = shot.DefinePrim("/shot/still", "Xform")
    still.GetReferences().AddReference("../assets/dog/dog.usda")
    still.GetVariantSets().SetSelection("state", "finished")
    shot.GetRootLayer().Save()
    report = check_file(str(tmp_path / "shots" / "zoo.usda"))
    assert (report.kind.value, report.unreadable, report.found) == ("shot", "", [])


def test_faults_of_a_sculpture_show_in_its_shot(stages: Path, dog: Path, tmp_path: Path) -> None:
    shutil.copy(stages / "dog_shot.usda", tmp_path)
    sample("payload/draft_sim.usdc", f"{MAIN}.points", 6, first_row(0.9))(dog)
    found = {
        (fault.rule, fault.prim, fault.time_code)
        for fault in check_file(str(tmp_path / "dog_shot.usda")).found
    }
    assert ("19", MAIN.replace("/dog", "/shot/sculpture"), 6.0) in found


def test_memory_does_not_grow_with_the_number_of_frames(tmp_path: Path) -> None:
    def peak(count: int) -> int:
        folder = tmp_path / str(count)
        write_stage(sculpture(rings=500), frames(count, rings=500), folder)
        code = (
            "import resource, sys; from balloon_usd.check import check_file; report = check_file(sys.argv[1])"
        )
        code += "; print(len(report.faults), resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)"
        words = [sys.executable, "-c", code, str(folder / "dog")]
        process = interruptible.start(words, cwd=ROOT)
        faults, kilobytes = process.communicate(timeout=60)[0].split()
        assert faults == "0"
        return int(kilobytes)

    # All samples together take 60 MB more.
    assert peak(250) - peak(10) < 12_000
