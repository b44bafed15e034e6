"""The quality of a figure in one line, for people."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.quality.crossing_history import pair_text
from balloon_usd.quality.measures import Verdict

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    Data = Mapping[str, Any]

MILLI, CENTI = 1e3, 1e2
"""Millimetres and centimetres in a metre; a hundredth is a per cent."""
SYMMETRIC = ("symmetric_volume", "symmetric_length", "symmetric_place")


def quality_line(data: Data) -> str:
    """Return a quality, as `QualityWatch.data` gives it, in one line; what is off names the worst bubble."""
    return ", ".join(_parts(data))


def _parts(data: Data) -> Iterator[str]:
    for key, unit in (("gas", "%"), ("tail", "cm")):
        if data[key]["verdict"] != Verdict.NONE:
            yield _difference(key, data[key], unit)
    # Records of earlier versions do not tell what is squeezed.
    if _off(found := data.get("squeezed", {"verdict": Verdict.NONE})):
        yield f"{found['worst']} squeezed by {CENTI * found['value']:.0f} %"
    yield _speed(data["speed"])
    yield from _creep(data["creep"])
    # Nor how figures stand.
    if (lean := data.get("lean", {"value": None}))["value"] is not None:
        yield f"{'fell over' if _off(lean) else 'stands'}, leaning {lean['value']:.1f} degrees"
    yield from _joints(data["joints"])
    # Nor what lies in rings.
    yield from _passed(data.get("passed", {}))
    # Nor what is wound.
    yield from _wound(data.get("unwound", {}))
    yield _crossings(data["crossings"], data["depth"])
    # Nor how far necks reach.
    yield from _necks(data.get("necks", {"verdict": Verdict.NONE}))
    yield from _symmetry(data)


def _off(result: Data) -> bool:
    return bool(result["verdict"] == Verdict.OFF)


def _difference(what: str, result: Data, unit: str) -> str:
    amount = f"{CENTI * result['value']:.1f} {unit}"
    return f"{what} {amount} off ({result['worst']})" if _off(result) else f"{what} within {amount}"


def _speed(result: Data) -> str:
    if result["verdict"] == Verdict.NONE:
        return "falls"
    return f"{'moving' if _off(result) else 'calm'} ({MILLI * result['value']:.1f} mm/s)"


def _creep(result: Data) -> Iterator[str]:
    if result["verdict"] == Verdict.NONE:
        yield f"comes undone ({', '.join(result['undone'])})"
    else:
        yield f"{'crept' if _off(result) else 'stays'} ({MILLI * result['value']:.1f} mm)"


def _joints(result: Data) -> Iterator[str]:
    if result["verdict"] == Verdict.NONE:
        return
    lost = f" ({', '.join(result['lost'])} not)" if result["lost"] else ""
    yield f"{result['held']} of {result['meant']} joints held{lost}"


def _passed(result: Data) -> Iterator[str]:
    if "through" in result:
        slipped = f" ({', '.join(result['slipped'])} not)" if result["slipped"] else ""
        count = len(result["through"])
        yield f"{count - result['value']} of {count} stay where others hold them{slipped}"


def _wound(result: Data) -> Iterator[str]:
    for name, (turns, asked) in result.get("turns", {}).items():
        yield f"{name} wound {turns:.1f} of {asked:g} turns"


def _crossings(result: Data, depth: Data) -> str:
    # Records of earlier versions do not tell where there were most.
    most = result.get("most", 0)
    earlier = [f"{most} in frame {result['most_at']}"] if most > result["value"] else []
    if frames := result.get("led_frames", 0):
        earlier.append(f"led apart by up to {MILLI * result['led_apart']:.1f} mm in {frames} frames")
    if not result["value"]:
        return f"0 crossings ({', '.join(earlier)})" if earlier else "0 crossings"
    a, b = result["bubbles"][0]["pair"]
    told = [pair_text((a, b)), f"{MILLI * depth['value']:.1f} mm", *earlier]
    return f"{result['value']} crossings ({', '.join(told)})"


def _necks(result: Data) -> Iterator[str]:
    if _off(result):
        yield f"wall drawn in {MILLI * result['away']:.1f} mm at {result['joint']}"


def _symmetry(data: Data) -> Iterator[str]:
    if data[SYMMETRIC[0]]["verdict"] == Verdict.NONE:
        return
    off = [key for key in SYMMETRIC if _off(data[key])]
    if not off:
        yield f"symmetric to {MILLI * data['symmetric_place']['value']:.1f} mm"
    for key in off:
        scale, unit = (MILLI, "mm") if key == "symmetric_place" else (CENTI, "%")
        yield f"{key.replace('_', ' ')} {scale * data[key]['value']:.1f} {unit} off ({data[key]['worst']})"
