"""Which prims are sculptures, and which the scene around them."""

from __future__ import annotations

from typing import Any

from balloon_usd.openusd import Kind


def in_component(prim: Any) -> bool:
    """Whether a prim belongs to a component model, as every sculpture is one."""
    while prim:
        if Kind.Registry.IsA(prim.GetKind(), Kind.Tokens.component):
            return True
        prim = prim.GetParent()
    return False
