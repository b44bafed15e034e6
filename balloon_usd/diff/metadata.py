"""Metadata of stages, prims and properties, compared key by key."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.diff.difference import ONLY
from balloon_usd.diff.values import alike
from balloon_usd.openusd import Sdf

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

LONGEST = 60
"""Characters of a value that are shown."""
ASSET_INFO, IDENTIFIER = "assetInfo", "identifier"
APPLIED = "apiSchemas"


def metadata_differences(one: Mapping[str, Any], other: Mapping[str, Any]) -> Iterator[tuple[str, str]]:
    """What differs between two dictionaries of metadata: its key, nested ones joined by ":", and a text."""
    for key in sorted({*one, *other}):
        values = [one.get(key), other.get(key)]
        if all(isinstance(value, dict) or value is None for value in values):
            for inner, text in metadata_differences(values[0] or {}, values[1] or {}):
                yield f"{key}:{inner}", text
        elif key not in one or key not in other:
            yield key, f"{shown(one.get(key, other.get(key)))} {ONLY[key not in one]}"
        elif not alike(*values):
            yield key, both(*values)


def stage_metadata(stage: Any) -> dict[str, Any]:
    """Return what a stage says about itself."""
    return dict(stage.GetPseudoRoot().GetAllAuthoredMetadata())


def prim_metadata(prim: Any, *, identifier: bool) -> dict[str, Any]:
    """Return what a prim is, apart from its properties, and perhaps its asset's identifier."""
    found = dict(prim.GetAllAuthoredMetadata())
    found["specifier"] = prim.GetSpecifier().displayName.lower()
    found[APPLIED] = list(prim.GetAppliedSchemas())
    info = dict(found.get(ASSET_INFO, {}))
    if not identifier and info.pop(IDENTIFIER, None) is not None:
        found[ASSET_INFO] = info
    return found


def variant_metadata(prim: Any) -> dict[str, Any]:
    """Return the variant sets of a prim: what each offers, and what is selected."""
    sets = prim.GetVariantSets()
    found: dict[str, Any] = {"variantSets": list(sets.GetNames())}
    for name in sets.GetNames():
        found[f"variants of {name}"] = list(sets.GetVariantSet(name).GetVariantNames())
        found[f"selected {name}"] = sets.GetVariantSelection(name)
    return found


def both(one: Any, other: Any) -> str:
    """Name two values, as far as they can be told apart."""
    short = shown(one), shown(other)
    if short[0] == short[1]:
        short = shown(one, precise=True), shown(other, precise=True)
    return f"{short[0]} and {short[1]}" if short[0] != short[1] else f"two values that begin {short[0]}"


def shown(value: Any, *, precise: bool = False) -> str:
    """Write a value for people, shortened."""
    if isinstance(value, Sdf.AssetPath):
        text = f"@{value.path}@"
    elif isinstance(value, float):
        text = repr(value) if precise else f"{value:g}"
    elif isinstance(value, (list, tuple)):
        text = ", ".join(shown(item) for item in value) or "none"
    else:
        text = " ".join(str(value).removeprefix("Sdf.").split()) or '""'
    return text if precise or len(text) <= LONGEST else f"{text[: LONGEST - 3]}..."
