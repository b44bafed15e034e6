"""The optional `kosaka:` block of the physics: constants of the particle model, after the thesis.

Forces are accelerations, as of bodies of unit mass (Kosaka 2008, chapter 3). What is absent is chosen by the
model so that its motion is stable.
"""

from collections.abc import Mapping
from typing import Annotated

from balloon_usd.language.quantities import Between, LengthWithin, length_entry
from balloon_usd.operations.modifiers import Entries

Offset = Annotated[float, LengthWithin(0.0, 0.1)]

KOSAKA_LENGTHS = ("gamma", "re", "air_offset", "contact_offset", "leak_offset", "spacing")
"""Keys that are lengths."""


class Kosaka(Entries):
    """Constants of springs and air particles; None is chosen by the model."""

    swell: Annotated[float, Between(0.001, 0.5)] = 0.03
    """How much thicker the air makes the balloon at rest, as a share of its radius."""
    natural: Annotated[float, Between(0.05, 1.0)] | None = None
    """Natural length of the springs, as a share of their length at the start."""
    ks: Annotated[float, Between(1.0, 1e9, "1/s2")] | None = None
    """Stiffness of the springs, 1/s2 (eq. 3.1)."""
    kd: Annotated[float, Between(0.0, 1e6, "1/s")] | None = None
    """Damping of the springs, 1/s (eq. 3.1)."""
    alpha: Annotated[float, Between(0.0, 1e9, "1/s2")] | None = None
    """Repulsion of air particles, 1/s2 (eq. 3.4)."""
    beta: Annotated[float, Between(0.0, 1e6, "m/s2")] | None = None
    """Push of the rubber on an air particle, m/s2 (eq. 3.12)."""
    push: Annotated[float, Between(0.0, 1e6, "m/s2")] | None = None
    """Push of an air particle on the rubber, m/s2: the unit of force of eq. 3.10."""
    gamma: Offset | None = None
    """How far a leaked air particle is moved back, m in Python (eq. 3.13)."""
    re: Offset | None = None
    """Reach of an air particle's repulsion, m in Python (eq. 3.3)."""
    air_offset: Offset | None = None
    """Thickness of the offset region in which air and rubber push each other, m in Python."""
    contact_offset: Offset | None = None
    """Thickness of the offset region in which rubber meets rubber, m in Python."""
    leak_offset: Offset | None = None
    """Thickness of the outer offset region in which leaked air is found, m in Python."""
    spacing: Annotated[float, LengthWithin(0.001, 0.1, low_included=True)] | None = None
    """Distance of neighbouring air particles once they are spread, m in Python."""
    drag: Annotated[float, Between(0.0, 1e4, "1/s")] | None = None
    """Drag on air particles, 1/s; the thesis has none."""
    grading: Annotated[float, Between(0.0, 1.0)] | None = None
    """How far the push between air and rubber fades with depth; 0 is the thesis's sharp region."""
    calming: Annotated[float, Between(0.0, 1e6, "1/s")] | None = None
    """Damping of the springs' ends across the spring, 1/s; the thesis has none."""
    force_limit: Annotated[float, Between(0.001, 1e9, "m/s2")] | None = None
    """Largest external force on a vertex, m/s2."""
    elongation_limit: Annotated[float, Between(0.01, 10.0)] | None = None
    """Largest elongation of a spring, as a share of its natural length."""


def kosaka_entries(settings: Mapping[str, object], units: str | None) -> dict[str, object]:
    """Plain data of some constants (lengths in m, or texts) as they stand in a recipe with these `units`."""
    return {
        key: length_entry(float(value), units)
        if key in KOSAKA_LENGTHS and isinstance(value, (int, float))
        else value
        for key, value in settings.items()
    }
