"""What validators say that is no fault of a stage."""

from __future__ import annotations

UNKNOWN_NODE = "MaterialX nodes are unknown to usd-core, whose wheel has no MaterialX"
REPEATED = "primvars with repeated values, which an index would hardly make smaller"
RAMP = "colours of a ramp that no vertex has: it stands there once for all frames"
SPECULATIVE = "overs are found by property 7, except below classes, where they are meant"
BROKE_DOWN = "rules of the validator that broke down themselves, as over points of one width for all"


def why_not_counted(rule: str, text: str) -> str:
    """Return why what a validator said does not count, "" if it counts."""
    if "ShaderSdrCompliance" in rule and "'ND_" in text:
        return UNKNOWN_NODE
    if rule == "IndexedPrimvarChecker":
        return REPEATED
    if rule == "UnusedPrimvarChecker" and text.startswith("primvars:displayColor contains values not"):
        return RAMP
    if rule == "DanglingOverPrimChecker":
        return SPECULATIVE
    if text.startswith("Uncaught error"):
        return BROKE_DOWN
    return ""
