"""Import stages into Blender in all their variants and compare what arrives with what was written.

python -m tests.blender.compare STAGE...

Points and attributes of every frame are compared bit for bit. Exits with 1 if anything differs.
"""

from __future__ import annotations

import sys
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

import bpy
import numpy as np
from pxr import Gf, Usd, UsdGeom, UsdLux

from tests.blender.arrays import array_differences
from tests.blender.comparison import Comparison
from tests.blender.imported import import_stage, show_frame, topology_of
from tests.blender.selections import all_selections, authored_selection, select
from tests.blender.surfaces import dome_differences, surface_differences

PLACED_WITHIN = 1e-5
"""Largest distance of a point in the world from where the stage has it, as a share of the stage's size."""
LOOK = (Gf.Vec3d(0.0, 0.0, 0.0), Gf.Vec3d(0.0, 0.0, -1.0))
"""Local points of cameras and lights: where they stand, and where they look."""
SHOWN = 8
"""Differences told of one selection."""


def compare_stage(
    file: str | Path, *, expected: str | Path | None = None, frames: Mapping[str, np.ndarray] | None = None
) -> Comparison:
    """Compare Blender's import of a stage with the stage, as it is opened and in all its variants.

    Args:
        file: what Blender imports.
        expected: a stage to compare with, if not the file itself.
        frames: points (F, V, 3) expected of prims by their name; then only as the file is opened.
    """
    begin, findings, shown = time.process_time(), [], 0
    file, expected = Path(file), Path(expected or file)
    with tempfile.TemporaryDirectory() as folder:
        views = (
            list(_views(file, expected, Path(folder))) if frames is None else [("as opened", file, expected)]
        )
        for title, imported, written in views:
            stage = Usd.Stage.Open(str(written))
            objects = import_stage(imported)
            codes = codes_of(stage)
            found = [
                *scene_differences(stage),
                *object_differences(stage, objects),
                *frame_differences(stage, objects, codes, frames or {}),
            ]
            findings += [f"{file.name}, {title}: {text}" for text in found[:SHOWN]]
            shown += len(codes)
    return Comparison(tuple(findings), len(views), shown, time.process_time() - begin)


def _views(file: Path, expected: Path, folder: Path) -> Iterator[tuple[str, Path, Path]]:
    """Each selection in words, with a file that shows it of either stage."""
    authored = authored_selection(expected)
    yield _text(authored), file, expected
    for number, chosen in enumerate(all_selections(expected)):
        if chosen != authored:
            places = [folder / f"{number}_{side}" for side in ("imported", "written")]
            for place in places:
                place.mkdir()
            yield _text(chosen), select(file, chosen, places[0]), select(expected, chosen, places[1])


def _text(selection: Mapping[str, str]) -> str:
    return " ".join(f"{name}={variant}" for name, variant in selection.items()) or "as opened"


def shown_prims(stage: Usd.Stage) -> dict[str, Usd.Prim]:
    """Prims that a renderer draws or that place others, by path."""
    found = {}
    for prim in stage.Traverse(Usd.TraverseInstanceProxies()):
        thing = UsdGeom.Imageable(prim)
        shows = thing and thing.ComputeVisibility() != UsdGeom.Tokens.invisible
        if shows and thing.ComputePurpose() in (UsdGeom.Tokens.default_, UsdGeom.Tokens.render):
            found[str(prim.GetPath())] = prim
    return found


def codes_of(stage: Usd.Stage) -> range:
    """Every whole time code of a stage, or only the first where nothing moves."""
    first, last = round(stage.GetStartTimeCode()), round(stage.GetEndTimeCode())
    moves = any(a.GetNumTimeSamples() > 1 for prim in stage.Traverse() for a in prim.GetAttributes())
    return range(first, (last if moves else first) + 1)


def scene_differences(stage: Usd.Stage) -> Iterator[str]:
    """What differs between the time of the stage and of the scene: one frame is one time code."""
    scene = bpy.context.scene
    ends = (stage.GetStartTimeCode(), stage.GetEndTimeCode())
    if stage.HasAuthoredTimeCodeRange() and ends != (scene.frame_start, scene.frame_end):
        yield f"time codes {ends}, in Blender {(scene.frame_start, scene.frame_end)}"
    if stage.GetFramesPerSecond() != stage.GetTimeCodesPerSecond():
        yield "a frame is no time code, as Blender takes it to be"


def object_differences(stage: Usd.Stage, objects: Mapping[str, bpy.types.Object]) -> Iterator[str]:
    """Which prims and objects have no counterpart, and meshes whose faces or materials differ."""
    prims = shown_prims(stage)
    for path in [path for path, prim in prims.items() if prim.IsA(UsdLux.DomeLight)]:
        yield from (f"{path}: {text}" for text in dome_differences(UsdLux.DomeLight(prims.pop(path))))
    for path in sorted({*prims} ^ {*objects}):
        yield f"{path}: {'does not arrive' if path in prims else 'only in Blender'}"
    for path in sorted({*prims} & {*objects}):
        prim, thing = prims[path], objects[path]
        texts = [*_kind_differences(prim, thing)]
        if not prim.IsA(UsdGeom.PointBased):
            texts += place_differences(prim, thing, stage.GetStartTimeCode(), LOOK)
        if prim.IsA(UsdGeom.Mesh):
            texts += [*_face_differences(prim, thing), *surface_differences(prim, thing)]
        yield from (f"{path}: {text}" for text in texts)


def _kind_differences(prim: Usd.Prim, thing: bpy.types.Object) -> Iterator[str]:
    kinds = {UsdGeom.Mesh: "MESH", UsdGeom.Points: "POINTCLOUD", UsdGeom.Camera: "CAMERA"}
    expected = next((kind for schema, kind in kinds.items() if prim.IsA(schema)), "EMPTY")
    if prim.HasAPI(UsdLux.LightAPI):
        expected = "LIGHT"
    if thing.type != expected:
        yield f"is a {prim.GetTypeName()}, in Blender {thing.type}"


def _face_differences(prim: Usd.Prim, thing: bpy.types.Object) -> Iterator[str]:
    graph, mesh = bpy.context.evaluated_depsgraph_get(), UsdGeom.Mesh(prim)
    written = mesh.GetFaceVertexCountsAttr().Get(), mesh.GetFaceVertexIndicesAttr().Get()
    if not all(np.array_equal(*pair) for pair in zip(written, topology_of(thing, graph), strict=True)):
        yield "faces differ"
    attributes = thing.evaluated_get(graph).data.attributes
    names = prim.GetStage().GetDefaultPrim().GetAttribute("balloon_usd:bubbles").Get()
    if names is None or "bubble" not in attributes:
        return
    bubble = np.array([item.value for item in attributes["bubble"].data])
    for subset in UsdGeom.Subset.GetGeomSubsets(mesh, UsdGeom.Tokens.face, "bubbles"):
        name = subset.GetPrim().GetName()
        if not np.array_equal(
            subset.GetIndicesAttr().Get(), np.flatnonzero(bubble == list(names).index(name))
        ):
            yield f"faces of {name} differ"


def frame_differences(
    stage: Usd.Stage,
    objects: Mapping[str, bpy.types.Object],
    codes: range,
    frames: Mapping[str, np.ndarray],
) -> Iterator[str]:
    """What differs between values at each time code and those of the frame; of each value, where it first does."""
    shown = shown_prims(stage).items()
    prims = {path: prim for path, prim in shown if path in objects and prim.IsA(UsdGeom.PointBased)}
    told = set()
    for position, code in enumerate(codes):
        graph = show_frame(code)
        for path, prim in prims.items():
            dumped = frames[prim.GetName()][position] if frames else None
            texts = dict(array_differences(prim, objects[path], graph, code, dumped))
            for text in place_differences(prim, objects[path], code, corners_of(prim, code)):
                texts["place"] = text
            for name, text in texts.items():
                if (path, name) not in told:
                    yield f"{path}.{name}: at {code}: {text}"
            told |= {(path, name) for name in texts}


def place_differences(
    prim: Usd.Prim, thing: bpy.types.Object, code: float, local: Sequence[Gf.Vec3d]
) -> Iterator[str]:
    """Say if local points of the object are not where the stage has them, in metres and with z up."""
    stage = prim.GetStage()
    turn = Gf.Matrix4d(1.0)
    if UsdGeom.GetStageUpAxis(stage) == UsdGeom.Tokens.y:
        turn.SetRotate(Gf.Rotation(Gf.Vec3d(1.0, 0.0, 0.0), 90.0))
    units = Gf.Matrix4d().SetScale(UsdGeom.GetStageMetersPerUnit(stage))
    written = UsdGeom.XformCache(code).GetLocalToWorldTransform(prim) * units * turn
    shown = Gf.Matrix4d(*(number for column in thing.matrix_world.transposed() for number in column))
    places = [(written.Transform(at), shown.Transform(at)) for at in local]
    size = max((there - places[0][0]).GetLength() for there, _ in places)
    gap = max((there - here).GetLength() for there, here in places)
    if gap > PLACED_WITHIN * size:
        yield f"{gap:.3g} m off"


def corners_of(prim: Usd.Prim, code: float) -> list[Gf.Vec3d]:
    """The corners of the box around the points of a prim."""
    box = UsdGeom.PointBased(prim).GetExtentAttr().Get(code)
    return [Gf.Vec3d(*(box[k][axis] for axis, k in enumerate(at))) for at in np.ndindex(2, 2, 2)]


def main(files: list[str]) -> int:
    """Compare the stages and print what differs."""
    failed = False
    for file in files:
        done = compare_stage(file)
        print(*done.findings, sep="\n", end="\n" if done.findings else "")
        print(
            f"{file}: {done.selections} selections, {done.frames} frames, {len(done.findings)} differences, {done.seconds:.1f} s"
        )
        failed |= bool(done.findings)
    return int(failed)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
