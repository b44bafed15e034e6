"""Selections of variants of a stage's root prim, each as a small file that Blender can open."""

from __future__ import annotations

from pathlib import Path

from pxr import Sdf, Usd

HEAD = (
    "upAxis",
    "metersPerUnit",
    "timeCodesPerSecond",
    "framesPerSecond",
    "startTimeCode",
    "endTimeCode",
)


def authored_selection(file: Path) -> dict[str, str]:
    """The variants that the file itself selects, by set."""
    stage = Usd.Stage.Open(str(file))
    sets = stage.GetDefaultPrim().GetVariantSets()
    return {name: sets.GetVariantSelection(name) for name in sets.GetNames()}


def all_selections(file: Path) -> list[dict[str, str]]:
    """Every combination of variants, also of sets that only another variant brings."""
    stage = Usd.Stage.Open(str(file), Usd.Stage.LoadAll)
    stage.SetEditTarget(stage.GetSessionLayer())
    return list(_from(stage.GetDefaultPrim(), {}))


def _from(root, chosen):
    left = [name for name in root.GetVariantSets().GetNames() if name not in chosen]
    if not left:
        yield dict(chosen)
        return
    choice = root.GetVariantSet(left[0])
    for variant in choice.GetVariantNames():
        choice.SetVariantSelection(variant)
        yield from _from(root, {**chosen, left[0]: variant})
    choice.ClearVariantSelection()


def select(file: Path, selection: dict[str, str], folder: Path) -> Path:
    """Write a layer over the file that selects variants, as a shot does, and return it."""
    below = Sdf.Layer.FindOrOpen(str(file))
    layer = Sdf.Layer.CreateNew(str(folder / f"{file.stem}_selected.usda"))
    layer.subLayerPaths = [str(file.absolute())]
    layer.defaultPrim = below.defaultPrim
    for key in HEAD:
        if below.pseudoRoot.HasInfo(key):
            layer.pseudoRoot.SetInfo(key, below.pseudoRoot.GetInfo(key))
    root = Sdf.CreatePrimInLayer(layer, f"/{below.defaultPrim}")
    for name, variant in selection.items():
        root.variantSelections[name] = variant
    layer.Save()
    return Path(layer.realPath)
