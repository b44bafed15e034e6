"""The validators that usd-core brings; none of them looks at a time sample."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from balloon_usd.check.fault import USD_CORE, Fault
from balloon_usd.openusd import Usd, UsdValidation

if TYPE_CHECKING:
    from collections.abc import Iterator

NAME = f"usd-core {'.'.join(map(str, Usd.GetVersion()[1:]))}"
REMEDY = "see the validators of OpenUSD for what this rule wants"


def ask_usd_core(stage: Any) -> Iterator[Fault]:
    """Everything that the validators of usd-core say about a stage."""
    validators = UsdValidation.ValidationRegistry().GetOrLoadAllValidators()
    for error in UsdValidation.ValidationContext(validators).Validate(stage):
        validator = error.GetValidator()
        rule = validator.GetMetadata().name if validator else error.GetName()
        yield Fault(USD_CORE, rule, " ".join(error.GetMessage().split()), _where(error), None, REMEDY)


def _where(error: Any) -> str:
    """Path of the first prim or property that an error is about."""
    for site in error.GetSites():
        if site.IsProperty():
            return str(site.GetProperty().GetPath())
        if site.IsPrim():
            return str(site.GetPrim().GetPath())
    return ""
