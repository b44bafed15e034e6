"""Variants: their names and selections always count, what is in them on demand."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from pxr import Usd, UsdGeom

from balloon_usd.diff import compare_files

TEXT = """#usda 1.0
(
    defaultPrim = "a"
)
def Xform "a" (
    prepend variantSets = ["detail"]
    variants = {{
        string detail = "draft"
        string state = "made"
    }}
)
{{
    variantSet "detail" = {{
        "draft" (
            prepend variantSets = ["state"]
        ) {{
            double size = 1
            variantSet "state" = {{
                "made" {{ double done = 0 }}
                "finished" {{ double done = {draft} }}
            }}
        }}
        "full" (
            prepend variantSets = ["state"]
        ) {{
            double size = {full}
            variantSet "state" = {{
                "made" {{ double done = 0 }}
                "finished" {{ double done = {fine} }}
            }}
        }}
    }}
}}
"""


@pytest.fixture
def pair(tmp_path: Path) -> Callable[..., tuple[Path, Path]]:
    """Two stages with variants in variants; the second as the numbers say."""

    def write(**changes: int) -> tuple[Path, Path]:
        as_it_was = {"draft": 1, "full": 2, "fine": 1}
        files = tmp_path / "one.usda", tmp_path / "other.usda"
        for file, numbers in zip(files, (as_it_was, {**as_it_was, **changes}), strict=True):
            # Braces on one line need a break in USD's text.
            lines = TEXT.format(**numbers).replace("{ double", "{\n double").replace(" }\n", "\n}\n")
            file.write_text(lines)
        return files

    return write


def told(pair: tuple[Path, Path], *, variants: bool) -> list[str]:
    return [str(difference) for difference in compare_files(*pair, variants=variants).differences]


def test_what_is_in_other_variants_is_compared_on_demand(pair: Callable[..., tuple[Path, Path]]) -> None:
    files = pair(full=3)
    assert told(files, variants=False) == []
    assert told(files, variants=True) == [
        "[detail=full, state=finished] /a.size: 2 and 3",
    ], "told once, under the first selection that shows it"


def test_variants_inside_variants_are_gone_through(pair: Callable[..., tuple[Path, Path]]) -> None:
    assert told(pair(draft=4, fine=5), variants=True) == [
        "[detail=draft, state=finished] /a.done: 1 and 4",
        "[detail=full, state=finished] /a.done: 1 and 5",
    ]


def test_stages_that_are_the_same_are_so_in_all_their_variants(
    pair: Callable[..., tuple[Path, Path]], written: Path
) -> None:
    assert told(pair(), variants=True) == []
    assert told((written / "dog", written / "dog"), variants=True) == []


def test_names_and_selections_of_variants_count(pair: Callable[..., tuple[Path, Path]]) -> None:
    files = pair()
    stage = Usd.Stage.Open(str(files[1]))
    detail = stage.GetPrimAtPath("/a").GetVariantSet("detail")
    detail.AddVariant("preview")
    detail.SetVariantSelection("full")
    UsdGeom.Xform.Define(stage, "/a").GetPrim().GetVariantSets().AddVariantSet("look")
    stage.GetRootLayer().Save()
    assert told(files, variants=False)[:4] == [
        "/a: selected detail: draft and full",
        '/a: selected look: "" only in the second stage',
        "/a: variantSets: detail, state and detail, look, state",
        "/a: variants of detail: draft, full and draft, full, preview",
    ]


def test_a_variant_that_is_not_whole_cannot_be_compared(pair: Callable[..., tuple[Path, Path]]) -> None:
    from balloon_usd.diff import DiffError  # noqa: PLC0415

    files = pair()
    for file in files:
        file.write_text(file.read_text().replace('"full" (', '"full" (\n prepend references = @./gone.usda@'))
    assert told(files, variants=False) == []
    with pytest.raises(DiffError, match=r"one\.usda is not whole: Could not open asset .*gone\.usda"):
        compare_files(*files, variants=True)
