"""Colours of a report: those of the contact sheet's paper and ink, and one for each bubble."""

from __future__ import annotations

Color = tuple[int, int, int]

PAPER: Color = (247, 247, 249)
PANEL: Color = (255, 255, 255)
INK: Color = (38, 40, 46)
PALE_INK: Color = (120, 124, 134)
RULE: Color = (229, 230, 235)
STEP_RULE: Color = (196, 199, 208)
ALARM: Color = (200, 30, 40)

BUBBLE_COLORS: tuple[Color, ...] = (
    (31, 95, 190),
    (222, 107, 18),
    (20, 135, 70),
    (190, 35, 110),
    (104, 72, 190),
    (0, 145, 160),
    (172, 132, 0),
    (130, 72, 40),
    (95, 105, 120),
    (120, 150, 20),
)
"""sRGB: neighbours on a balloon differ in hue, and all are dark enough for text on white."""
PALER = 0.38
"""Share of white that every further round of the table takes."""


def bubble_color(index: int) -> Color:
    """Return the colour of a bubble by its number in plan order; after ten the hues return, paler."""
    rounds, place = divmod(index, len(BUBBLE_COLORS))
    white = 1.0 - (1.0 - PALER) ** min(rounds, 1)
    red, green, blue = (round(channel + white * (255 - channel)) for channel in BUBBLE_COLORS[place])
    return red, green, blue
