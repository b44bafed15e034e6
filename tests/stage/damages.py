"""What can be wrong with a stage: damages by the number of the property that must find them."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade, Vt

MAIN = "/dog/geo/render/main"
AIR = "/capsule/geo/render/main_air"
Damage = Callable[[Usd.Stage], object]


def mesh(stage: Usd.Stage) -> UsdGeom.Mesh:
    return UsdGeom.Mesh.Get(stage, MAIN)


def attribute(stage: Usd.Stage, name: str) -> Usd.Attribute:
    return stage.GetPrimAtPath(MAIN).GetAttribute(name)


def set_at(name: str, time: float | None, change: Callable[[np.ndarray], np.ndarray]) -> Damage:
    """Change the value of an attribute of the mesh at one time code."""

    def damage(stage: Usd.Stage) -> None:
        code = Usd.TimeCode.Default() if time is None else time
        changed = np.ascontiguousarray(change(np.array(attribute(stage, name).Get(code))))
        attribute(stage, name).Set(changed, code)

    return damage


def with_row(row: int | slice, value: object) -> Callable[[np.ndarray], np.ndarray]:
    def change(values: np.ndarray) -> np.ndarray:
        values[row] = value
        return values

    return change


def info(key: str, value: object | None) -> Damage:
    def damage(stage: Usd.Stage) -> None:
        head = stage.GetRootLayer().pseudoRoot
        head.ClearInfo(key) if value is None else head.SetInfo(key, value)

    return damage


def facts(**changes: object) -> Damage:
    def damage(stage: Usd.Stage) -> None:
        layer = stage.GetRootLayer()
        known = {**layer.customLayerData["balloon_usd"], **changes}
        layer.customLayerData = {"balloon_usd": {k: v for k, v in known.items() if v is not None}}

    return damage


def primvar(name: str, type_name: str, interpolation: str, value: object) -> Damage:
    def damage(stage: Usd.Stage) -> None:
        api = UsdGeom.PrimvarsAPI(mesh(stage))
        api.CreatePrimvar(name, Sdf.ValueTypeNames.Find(type_name), interpolation).Set(value)

    return damage


def indexed(indices: list[int]) -> Damage:
    """Give the mesh a uniform primvar of two values by index, one for each of three faces."""

    def damage(stage: Usd.Stage) -> None:
        count = len(attribute(stage, "faceVertexCounts").Get())
        heat = UsdGeom.PrimvarsAPI(mesh(stage)).CreatePrimvar(
            "heat", Sdf.ValueTypeNames.FloatArray, "uniform"
        )
        heat.Set([0.0, 1.0])
        heat.SetIndices([*indices, *[0] * (count - 3)])

    return damage


def clear_samples(changing: Usd.Attribute) -> None:
    for time in changing.GetTimeSamples():
        changing.ClearAtTime(time)


def faces(change: Callable[[np.ndarray], np.ndarray]) -> Damage:
    """Change the vertex numbers of the quads (Q, 4)."""

    def damage(stage: Usd.Stage) -> None:
        quads = np.array(attribute(stage, "faceVertexIndices").Get()).reshape(-1, 4)
        quads = np.ascontiguousarray(change(quads), dtype=np.int32)
        attribute(stage, "faceVertexIndices").Set(Vt.IntArray.FromNumpy(quads.ravel()))
        attribute(stage, "faceVertexCounts").Set(Vt.IntArray([4] * len(quads)))

    return damage


def velocities(factor: float) -> Damage:
    """Finite differences per second, times a factor."""

    def damage(stage: Usd.Stage) -> None:
        points = mesh(stage).GetPointsAttr()
        for time in points.GetTimeSamples():
            moved = np.asarray(points.Get(time)) - np.asarray(points.Get(max(time - 1, 1)))
            mesh(stage).CreateVelocitiesAttr().Set(
                Vt.Vec3fArray.FromNumpy(moved * np.float32(24 * factor)), time
            )

    return damage


def cloud(widths: list[float], ids: list[int]) -> Damage:
    def damage(stage: Usd.Stage) -> None:
        air = UsdGeom.Points.Define(stage, "/dog/geo/render/air")
        air.CreatePointsAttr([(0, 0, 0)] * len(widths))
        air.CreateWidthsAttr(widths)
        air.CreateIdsAttr(ids)

    return damage


def air(stage: Usd.Stage) -> UsdGeom.Points:
    return UsdGeom.Points.Get(stage, AIR)


def set_air(name: str, time: float | None, change: Callable[[np.ndarray], np.ndarray]) -> Damage:
    """Change the value of an attribute of the particles at one time code."""

    def damage(stage: Usd.Stage) -> None:
        changing = air(stage).GetPrim().GetAttribute(name)
        code = Usd.TimeCode.Default() if time is None else time
        changing.Set(np.ascontiguousarray(change(np.array(changing.Get(code)))), code)

    return damage


def drop_air(name: str) -> Damage:
    return lambda stage: air(stage).GetPrim().RemoveProperty(name)


def bind_subset(family: str) -> Damage:
    def damage(stage: Usd.Stage) -> None:
        subset = UsdGeom.Subset.CreateGeomSubset(
            mesh(stage), "patch", "face", [0, 1], family, "nonOverlapping"
        )
        material = UsdShade.Material.Get(stage, "/dog/mtl/latex_main")
        UsdShade.MaterialBindingAPI.Apply(subset.GetPrim()).Bind(material)
        # Else faces of no subset show the material of the mesh.
        UsdShade.MaterialBindingAPI(mesh(stage)).UnbindDirectBinding()

    return damage


def bind_outside(stage: Usd.Stage) -> None:
    material = UsdShade.Material.Define(stage, "/shop/latex")
    UsdShade.MaterialBindingAPI(mesh(stage)).Bind(material)


def preview_color(value: tuple[float, float, float]) -> Damage:
    def damage(stage: Usd.Stage) -> None:
        stage.GetAttributeAtPath("/dog/mtl/latex_main/preview.inputs:diffuseColor").Set(Gf.Vec3f(value))

    return damage


def normals(stage: Usd.Stage) -> None:
    mesh(stage).CreateNormalsAttr([(0, 0, 1)])


def subset_indices(indices: list[int]) -> Damage:
    return lambda stage: stage.GetAttributeAtPath(f"{MAIN}/nose.indices").Set(Vt.IntArray(indices))


DAMAGES: list[tuple[int, str, Damage]] = [
    (1, "missing reference", lambda s: s.GetDefaultPrim().GetReferences().AddReference("./gone.usda")),
    (1, "missing sublayer", lambda s: s.GetRootLayer().subLayerPaths.append("./gone.usda")),
    (2, "kind", lambda s: s.GetDefaultPrim().SetKind("group")),
    (2, "second root", lambda s: UsdGeom.Xform.Define(s, "/stage_light")),
    (2, "root is a scope", lambda s: s.GetDefaultPrim().SetTypeName("Scope")),
    (2, "no default prim", lambda s: s.ClearDefaultPrim()),
    (3, "Y up", info("upAxis", "Y")),
    (3, "centimetres", info("metersPerUnit", 0.01)),
    (3, "no rate", info("timeCodesPerSecond", None)),
    (3, "no end", info("endTimeCode", None)),
    (4, "rates differ", info("framesPerSecond", 30.0)),
    (4, "an unknown rate", facts(fps=25.0)),
    (5, "gap", lambda s: attribute(s, "points").ClearAtTime(3)),
    (5, "between frames", set_at("points", 3.5, lambda p: p)),
    (5, "outside the range", set_at("points", 99, lambda p: p)),
    (5, "extent without points", set_at("extent", 3.5, lambda e: e)),
    (5, "no stretch samples", lambda s: clear_samples(attribute(s, "primvars:stretch"))),
    (5, "no samples", lambda s: clear_samples(attribute(s, "points"))),
    (5, "an endless range", info("endTimeCode", 1e300)),
    (5, "no range", info("endTimeCode", float("nan"))),
    (5, "stretch without points", set_at("primvars:stretch", 0, lambda x: x)),
    (
        6,
        "absolute texture",
        lambda s: s.GetDefaultPrim().CreateAttribute("t", Sdf.ValueTypeNames.Asset).Set("/a.png"),
    ),
    (
        6,
        "absolute path in a list",
        lambda s: (
            s.GetDefaultPrim().CreateAttribute("t", Sdf.ValueTypeNames.AssetArray).Set(["a.png", "C:/b.png"])
        ),
    ),
    (6, "absolute sublayer", lambda s: s.GetRootLayer().subLayerPaths.append("/tmp/gone.usda")),
    (7, "dangling over", lambda s: s.OverridePrim("/dog/geo/ghost")),
    (7, "typeless def", lambda s: s.DefinePrim("/dog/geo/ghost")),
    (
        8,
        "as large as a house",
        lambda s: UsdGeom.Xformable(s.GetDefaultPrim()).AddScaleOp().Set((100, 100, 100)),
    ),
    (8, "as small as a seed", lambda s: UsdGeom.Xformable(s.GetDefaultPrim()).AddScaleOp().Set((0.01,) * 3)),
    (9, "no recipe", facts(recipe_sha256=None)),
    (9, "host", facts(render_host="blade07")),
    (9, "absolute recipe", facts(recipe="C:\\dog.yaml")),
    (9, "no asset info", lambda s: s.GetDefaultPrim().ClearAssetInfo()),
    (10, "no hint", lambda s: s.GetDefaultPrim().RemoveProperty("extentsHint")),
    (
        10,
        "hint of one frame",
        lambda s: UsdGeom.ModelAPI(s.GetDefaultPrim()).SetExtentsHint([(0, 0, 0), (1, 1, 1)]),
    ),
    (11, "blinking", lambda s: mesh(s).CreateVisibilityAttr().Set("invisible", 2)),
    (12, "a point less at one time", set_at("points", 4, lambda p: p[1:])),
    (12, "vertex out of range", set_at("faceVertexIndices", None, with_row(3, 99999))),
    (12, "counts that do not add up", set_at("faceVertexCounts", None, with_row(3, 5))),
    (13, "NaN in one sample", set_at("points", 7, with_row(2, np.nan))),
    (13, "infinite stretch", set_at("primvars:stretch", 7, with_row(2, np.inf))),
    (13, "NaN in the resting pose", set_at("primvars:pressure", None, with_row(0, np.nan))),
    (14, "loose", set_at("extent", 2, lambda e: e * np.float32(1.1))),
    (14, "too small", set_at("extent", 2, lambda e: e * np.float32(0.9))),
    (15, "hole", faces(lambda q: q[1:])),
    (15, "one face turned", faces(lambda q: np.concatenate([q[:1, ::-1], q[1:]]))),
    (15, "inside out", faces(lambda q: q[:, ::-1])),
    (15, "collapsed at one time", set_at("points", 5, with_row(slice(0, 8), 0.0))),
    (
        15,
        "coincident at one time",
        set_at("points", 5, lambda p: np.concatenate([p[:1], p[:1], p[2:]])),
    ),
    (12, "faces with two corners", set_at("faceVertexCounts", None, lambda c: np.repeat(c // 2, 2))),
    (15, "a corner twice in a face", faces(lambda q: np.concatenate([q[:1, [0, 0, 2, 3]], q[1:]]))),
    (15, "wound for the left hand", lambda s: mesh(s).CreateOrientationAttr("leftHanded")),
    (15, "unused point", set_at("points", 1, lambda p: np.concatenate([p, p[:1] + 1]))),
    (16, "no scheme", lambda s: mesh(s).GetPrim().RemoveProperty("subdivisionScheme")),
    (16, "normals", normals),
    (16, "normals as primvar", primvar("normals", "normal3f[]", "constant", [(0, 0, 1)])),
    (17, "faces with samples", set_at("faceVertexIndices", 1, lambda i: i)),
    (17, "subsets with samples", lambda s: s.GetAttributeAtPath(f"{MAIN}/nose.indices").Set([0, 1], 2)),
    (18, "per frame", velocities(1.0 / 24.0)),
    (18, "none", velocities(0.0)),
    (18, "too few", lambda s: mesh(s).CreateVelocitiesAttr().Set([(0, 0, 1)])),
    (19, "one point jumps", set_at("points", 6, with_row(0, 0.5))),
    (20, "a stretch too few", set_at("primvars:stretch", 4, lambda x: x[1:])),
    (20, "a bubble too many", set_at("primvars:bubble", None, lambda x: np.append(x, 0).astype(np.int32))),
    (20, "half", primvar("heat", "half[]", "constant", [1.0])),
    (20, "scalar", primvar("heat", "float", "constant", 1.0)),
    (20, "double", primvar("heat", "double[]", "constant", [1.0])),
    (20, "an index too large", indexed([0, 1, 9])),
    (20, "an index too few", indexed([0, 1])),
    (20, "names", primvar("note", "string[]", "constant", ["a"])),
    (21, "face without bubble", subset_indices([1, 2])),
    (21, "face in two bubbles", subset_indices(list(range(40)))),
    (21, "no partition", lambda s: UsdGeom.Subset.SetFamilyType(mesh(s), "bubbles", "unrestricted")),
    (21, "no bubbles", lambda s: [s.RemovePrim(f"{MAIN}/{n}") for n in ("nose", "left_ear", "right_ear")]),
    (21, "bound subset in another family", bind_subset("patches")),
    (21, "bound subset leaves faces out", bind_subset("materialBind")),
    (22, "unbound", lambda s: UsdShade.MaterialBindingAPI(mesh(s)).UnbindAllBindings()),
    (22, "binding without schema", lambda s: mesh(s).GetPrim().RemoveAPI(UsdShade.MaterialBindingAPI)),
    (22, "material outside", bind_outside),
    (22, "too bright", preview_color((1.5, 0, 0))),
    (22, "no preview", lambda s: s.RemovePrim("/dog/mtl/latex_main/preview")),
    (23, "no width", cloud([0.0, 1.0], [1, 2])),
    (23, "same ids", cloud([1.0, 1.0], [2, 2])),
    (23, "gprim below gprim", lambda s: UsdGeom.Sphere.Define(s, f"{MAIN}/knot")),
    (24, "first frame at rest", lambda s: attribute(s, "points").Set(attribute(s, "points").Get(1))),
    (24, "first stretch at rest", set_at("primvars:stretch", None, lambda x: x * 0)),
    (24, "no resting pose", lambda s: attribute(s, "points").ClearDefault()),
    (25, "no colour", lambda s: mesh(s).GetPrim().RemoveProperty("primvars:displayColor")),
    (25, "sides left open", lambda s: mesh(s).GetPrim().RemoveProperty("doubleSided")),
]


AIR_DAMAGES: list[tuple[int, str, Damage]] = [
    (
        1,
        "no texture",
        lambda s: s.GetAttributeAtPath("/capsule/mtl/wire/texture.inputs:file").Set("./gone.png"),
    ),
    (5, "a particle sample missing", lambda s: air(s).GetPointsAttr().ClearAtTime(3)),
    (5, "extent without particles", set_air("extent", 3.5, lambda e: e)),
    (5, "clusters between frames", set_air("primvars:cluster", 4.5, lambda c: c)),
    (5, "colours that blend", lambda s: air(s).GetDisplayColorAttr().ClearAtTime(4)),
    (10, "a leak outside the hint", set_air("extent", 2, lambda e: e * np.float32(3))),
    (11, "blinking air", lambda s: air(s).CreateVisibilityAttr().Set("invisible", 2)),
    (12, "a particle less at one time", set_air("points", 4, lambda p: p[1:])),
    (12, "no particles", lambda s: air(s).GetPrim().RemoveProperty("points")),
    (13, "a particle nowhere", set_air("points", 4, with_row(2, np.nan))),
    (14, "an extent of the centres", set_air("extent", 3, lambda e: e + np.float32([[0.0015], [-0.0015]]))),
    (17, "ids with samples", set_air("ids", 2, lambda i: i)),
    (17, "widths with samples", set_air("widths", 2, lambda w: w)),
    (18, "wrong velocities", lambda s: air(s).CreateVelocitiesAttr().Set([(0, 0, 1)] * 24)),
    (20, "a colour too few", set_air("primvars:displayColor", 5, lambda c: c[1:])),
    (20, "a cluster too many", set_air("primvars:cluster", 5, lambda c: np.append(c, c[:1]))),
    (22, "air without material", lambda s: UsdShade.MaterialBindingAPI(air(s)).UnbindAllBindings()),
    (23, "two widths for all", set_air("widths", None, lambda w: np.repeat(w, 2))),
    (23, "an id too few", set_air("ids", None, lambda i: i[1:])),
    (23, "same ids", set_air("ids", None, lambda i: i // 2)),
    (23, "flat particles", set_air("widths", None, lambda w: w * 0)),
    (24, "first frame at rest", lambda s: air(s).GetPointsAttr().Set(air(s).GetPointsAttr().Get(1))),
    (24, "first clusters at rest", set_air("primvars:cluster", None, lambda c: c * 0)),
    (25, "no colour", drop_air("primvars:displayColor")),
]
