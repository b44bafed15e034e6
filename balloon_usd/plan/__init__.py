"""The plan room: what a recipe means, in lengths, joints, gas and warnings, before any physics runs."""

from __future__ import annotations

from balloon_usd.operations.caution import Caution
from balloon_usd.plan.after_step import AfterStep, after_step, after_step_json, after_step_text
from balloon_usd.plan.budget import Budget
from balloon_usd.plan.drawing import plan_svg
from balloon_usd.plan.graph import SculptureGraph
from balloon_usd.plan.model import Plan
from balloon_usd.plan.planning import plan
from balloon_usd.plan.report import plan_json, plan_text
from balloon_usd.plan.strip import PlannedBubble, Strip

__all__ = [
    "AfterStep",
    "Budget",
    "Caution",
    "Plan",
    "PlannedBubble",
    "SculptureGraph",
    "Strip",
    "after_step",
    "after_step_json",
    "after_step_text",
    "plan",
    "plan_json",
    "plan_svg",
    "plan_text",
]
