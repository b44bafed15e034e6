"""The look of a stage: the variant of its root prim that says what the rubber is drawn as."""

from __future__ import annotations

from difflib import get_close_matches
from typing import TYPE_CHECKING, Any

from balloon_usd.preview.error import PreviewError
from balloon_usd.stage.variant_sets import LOOK

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path


def select_look(stage: Any, look: str | None, path: str | Path) -> str:
    """Select a look in the stage's session, None for the stage's own; returns the one selected or "".

    Raises:
        PreviewError: the stage, which the message calls `path`, has no such look.
    """
    root = stage.GetDefaultPrim() or stage.GetPseudoRoot()
    variants = root.GetVariantSet(LOOK)
    names = variants.GetVariantNames()
    if look is not None:
        if look not in names:
            raise PreviewError(f'{path} has no look "{look}", {_instead(look, names)}')
        stage.SetEditTarget(stage.GetSessionLayer())
        variants.SetVariantSelection(look)
    return str(variants.GetVariantSelection())


def _instead(look: str, names: Sequence[str]) -> str:
    """Name the look that was probably meant, or those that there are."""
    meant = get_close_matches(look.lower(), names, n=1)
    if meant:
        return f'did you mean "{meant[0]}"?'
    return f"only {', '.join(names)}" if names else "nor any other"
