"""What can be wrong with an asset in layers: damages by the number of the property that must find them."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
from pxr import Sdf, Usd, UsdGeom, UsdShade, Vt

MAIN = "/dog/geo/render/main"
Damage = Callable[[Path], object]


def edited(file: str, edit: Callable[[Usd.Stage], object]) -> Damage:
    """Edit one layer of the asset by itself."""

    def damage(folder: Path) -> None:
        stage = Usd.Stage.Open(str(folder / file))
        edit(stage)
        stage.GetRootLayer().Save()

    return damage


def replaced(file: str, old: str, new: str) -> Damage:
    """Replace some text of a layer that is text."""

    def damage(folder: Path) -> None:
        text = (folder / file).read_text()
        assert old in text
        (folder / file).write_text(text.replace(old, new))

    return damage


def sample(file: str, path: str, time: float, change: Callable[[np.ndarray], np.ndarray]) -> Damage:
    """Change one sample in a layer."""

    def damage(folder: Path) -> None:
        layer = Sdf.Layer.FindOrOpen(str(folder / file))
        changed = np.ascontiguousarray(change(np.array(layer.QueryTimeSample(path, time))))
        integers, vectors = changed.dtype.kind == "i", changed.ndim == 2
        kind = Vt.IntArray if integers else Vt.Vec3fArray if vectors else Vt.FloatArray
        layer.SetTimeSample(path, time, kind.FromNumpy(changed))
        layer.Save()

    return damage


def without_sample(file: str, path: str, time: float) -> Damage:
    def damage(folder: Path) -> None:
        layer = Sdf.Layer.FindOrOpen(str(folder / file))
        layer.EraseTimeSample(path, time)
        layer.Save()

    return damage


def default(file: str, path: str, change: Callable[[np.ndarray], np.ndarray] | None) -> Damage:
    """Change the default of an attribute in a layer; None removes the attribute with its samples."""

    def damage(folder: Path) -> None:
        layer = Sdf.Layer.FindOrOpen(str(folder / file))
        spec = layer.GetAttributeAtPath(path)
        if change is None:
            spec.owner.RemoveProperty(spec)
        else:
            spec.default = np.ascontiguousarray(change(np.array(spec.default)))
        layer.Save()

    return damage


def first_row(value: float) -> Callable[[np.ndarray], np.ndarray]:
    def change(values: np.ndarray) -> np.ndarray:
        values[0] = value
        return values

    return change


def geometry_above_samples(folder: Path) -> None:
    layer = Sdf.Layer.FindOrOpen(str(folder / "payload" / "draft.usda"))
    layer.subLayerPaths = list(reversed(layer.subLayerPaths))
    layer.Save()


def hide_stretch(stage: Usd.Stage) -> None:
    stage.OverridePrim(MAIN).CreateAttribute("primvars:stretch", Sdf.ValueTypeNames.FloatArray).Set([1.0])


def hide_shades(stage: Usd.Stage) -> None:
    shades = stage.OverridePrim(MAIN).CreateAttribute(SHADES, Sdf.ValueTypeNames.IntArray)
    shades.Set(Vt.IntArray(len(UsdGeom.Mesh.Get(stage, MAIN).GetPointsAttr().Get())))


def absolute_sublayer(folder: Path) -> None:
    studio = folder / "payload" / "studio.usda"
    Sdf.Layer.CreateNew(str(studio)).Save()
    edited("dog.usda", lambda stage: stage.GetRootLayer().subLayerPaths.append(str(studio)))(folder)


def layer_outside(folder: Path) -> None:
    Sdf.Layer.CreateNew(str(folder.parent / "studio.usda")).Save()
    edited("dog.usda", lambda stage: stage.GetRootLayer().subLayerPaths.append("../studio.usda"))(folder)


def without_variant(file: str, prim: str, variant_set: str, variant: str) -> Damage:
    def damage(folder: Path) -> None:
        layer = Sdf.Layer.FindOrOpen(str(folder / file))
        variants = layer.GetPrimAtPath(prim).variantSets[variant_set]
        variants.RemoveVariant(variants.variants[variant])
        layer.Save()

    return damage


def unbound(look: str) -> Damage:
    def damage(folder: Path) -> None:
        layer = Sdf.Layer.FindOrOpen(str(folder / "payload" / "materials.usda"))
        mesh = layer.GetPrimAtPath(f"/dog{{look={look}}}{MAIN.removeprefix('/dog/')}")
        mesh.RemoveProperty(mesh.properties["material:binding"])
        layer.Save()

    return damage


def outside_material(stage: Usd.Stage) -> None:
    material = UsdShade.Material.Define(stage, "/shop/latex")
    binding = UsdShade.MaterialBindingAPI(stage.OverridePrim(MAIN))
    binding.Bind(material, bindingStrength=UsdShade.Tokens.strongerThanDescendants)


def instanced(stage: Usd.Stage) -> None:
    twin = UsdGeom.Xform.Define(stage, "/dog/twin").GetPrim()
    twin.GetReferences().AddReference("./payload/draft.usda", "/dog/geo")
    twin.SetInstanceable(True)


def killed_run(folder: Path) -> None:
    (folder.parent / ".dog.a1b2c3d4.writing").mkdir()


SIM, GEO = "payload/draft_sim.usdc", "payload/draft_geo.usdc"
STRESS = "payload/draft_stress.usdc"
SHADES = "primvars:displayColor:indices"
STILL_SHADES = f"/__finished__{MAIN.removeprefix('/dog')}.{SHADES}"

LAYERED_DAMAGES: list[tuple[int, str, Damage]] = [
    (2, "a material beside the root", edited("dog.usda", outside_material)),
    (3, "no unit", replaced("dog.usda", "metersPerUnit = 1", "")),
    (3, "centimetres", replaced("dog.usda", "metersPerUnit = 1", "metersPerUnit = 0.01")),
    (5, "geometry above samples", geometry_above_samples),
    (5, "a default that hides samples", edited("dog.usda", hide_stretch)),
    (5, "a missing sample", without_sample(SIM, f"{MAIN}.points", 4)),
    (5, "a missing extent", without_sample(SIM, f"{MAIN}.extent", 4)),
    (5, "a missing colour of stress", without_sample(STRESS, f"{MAIN}.{SHADES}", 4)),
    (5, "a default that hides the colours of stress", edited("dog.usda", hide_shades)),
    (5, "a longer range", replaced("dog.usda", "endTimeCode = 12", "endTimeCode = 13")),
    (6, "an absolute sublayer", absolute_sublayer),
    (6, "a layer outside", layer_outside),
    (7, "a dangling over", edited("payload/materials.usda", lambda s: s.OverridePrim("/dog/geo/ghost"))),
    (9, "no provenance", replaced("dog.usda", "string recipe_sha256", "string hash")),
    (10, "a hint of another room", replaced("dog.usda", "(0.32", "(0.42")),
    (13, "NaN in one sample", sample(SIM, f"{MAIN}.points", 7, first_row(np.nan))),
    (14, "a loose extent", sample(SIM, f"{MAIN}.extent", 3, lambda e: e * np.float32(1.2))),
    (19, "a teleport", sample(SIM, f"{MAIN}.points", 6, first_row(0.9))),
    (20, "a stretch too few", sample(SIM, f"{MAIN}.primvars:stretch", 5, lambda x: x[1:])),
    (20, "a colour of stress too few", sample(STRESS, f"{MAIN}.{SHADES}", 5, lambda x: x[1:])),
    (20, "a colour beyond the ramp", sample(STRESS, f"{MAIN}.{SHADES}", 5, first_row(256))),
    (20, "a colour before the ramp", sample(STRESS, f"{MAIN}.{SHADES}", 5, first_row(-1))),
    (20, "no colours chosen from the ramp", default(STRESS, f"{MAIN}.{SHADES}", None)),
    (20, "a ramp of one colour", default(STRESS, f"{MAIN}.primvars:displayColor", lambda c: c[:1])),
    (20, "no colours chosen in the still", default(STRESS, STILL_SHADES, None)),
    (20, "a colour of the still too few", default(STRESS, STILL_SHADES, lambda x: x[1:])),
    (20, "a colour of the still beyond the ramp", default(STRESS, STILL_SHADES, first_row(256))),
    (22, "a material outside", edited("dog.usda", outside_material)),
    (22, "clay not bound", unbound("clay")),
    (22, "chrome not bound", unbound("chrome")),
    (24, "a resting pose of its own", sample(SIM, f"{MAIN}.points", 12, lambda p: p + np.float32(0.001))),
    (24, "resting colours of its own", default(STRESS, f"{MAIN}.{SHADES}", lambda x: x * 0)),
    (30, "a killed run", killed_run),
    (31, "an instance", edited("dog.usda", instanced)),
    (32, "no clay", without_variant("payload/materials.usda", "/dog", "look", "clay")),
    (32, "no finished state", without_variant("dog.usda", "/dog{detail=draft}", "state", "finished")),
]
