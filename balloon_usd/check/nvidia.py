"""NVIDIA's validator, where it is installed."""

from __future__ import annotations

from enum import Enum
from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.check.fault import NVIDIA, Fault

if TYPE_CHECKING:
    from collections.abc import Iterator

PACKAGE = "usd_validation_nvidia"
REMEDY = "see NVIDIA's asset requirements for what this rule wants"
INSTALL = "pip install 'balloon-usd[check]'"


def nvidia_installed() -> bool:
    """Whether NVIDIA's validator can be asked."""
    return find_spec(PACKAGE) is not None


def nvidia_name() -> str:
    """Name and version of NVIDIA's validator."""
    return f"usd-validation-nvidia {import_module('importlib.metadata').version('usd-validation-nvidia')}"


class Asked(Enum):
    """What NVIDIA's validator is asked about."""

    ALL = "all"
    """Every rule."""
    SHAPES = "shapes"
    """Rules about geometry: those of single frames."""
    LOOKS = "looks"
    """All other rules: those of variants that differ in materials."""


GEOMETRY, LAYERS, EXTENTS = "Geometry", "Layer", "ExtentsChecker"
"""Categories of rules that read all samples, and one more such rule."""


def ask_nvidia(stage: Any, asked: Asked = Asked.ALL) -> Iterator[Fault]:
    """Everything that NVIDIA's validator says about a stage in the variants that are selected."""
    package = import_module(PACKAGE)
    engine = package.ValidationEngine(init_rules=False, variants=False)
    for rule in _rules(package.CategoryRuleRegistry(), asked):
        engine.enable_rule(rule)
    # What is not finite is told as a fault, not as a warning of the arithmetic.
    with np.errstate(all="ignore"):
        issues = engine.validate(stage).issues()
    for issue in issues:
        named = issue.rule.__name__ if issue.rule else "ValidationEngine"
        text = " ".join(str(issue.message).split())
        remedy = str(issue.suggestion.message) if issue.suggestion else REMEDY
        yield Fault(NVIDIA, named, text, _where(issue.at), None, remedy)


def _rules(registry: Any, asked: Asked) -> list[Any]:
    """The rules that are asked for."""
    rules = [(rule, category) for category in registry.categories for rule in registry.get_rules(category)]
    reading = {rule for rule, category in rules if category == GEOMETRY or rule.__name__ == EXTENTS}
    if asked is Asked.SHAPES:
        return [rule for rule, _ in rules if rule in reading]
    if asked is Asked.LOOKS:
        return [rule for rule, category in rules if rule not in reading and category != LAYERS]
    return [rule for rule, _ in rules]


def _where(at: Any) -> str:
    """Path of the prim or property that an issue is about."""
    first = at[0] if isinstance(at, list | tuple) and at else at
    path = getattr(first, "path", None)
    return str(path) if path else ""
