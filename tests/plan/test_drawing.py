"""The plan as an SVG drawing."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import pytest

from balloon_usd.plan import plan_svg
from balloon_usd.plan.drawing import SCALE

SVG = "{http://www.w3.org/2000/svg}"


def shapes(drawing: str, tag: str, kind: str) -> list[ET.Element]:
    return [shape for shape in ET.fromstring(drawing).iter(SVG + tag) if shape.get("class") == kind]


def test_every_bubble_is_drawn_to_scale(dog):
    bubbles = shapes(plan_svg(dog), "rect", "bubble")
    assert [float(shape.get("width")) / SCALE for shape in bubbles] == pytest.approx(
        [bubble.length for bubble in dog.bubbles], abs=1e-4
    )


def test_the_flat_tube_shows_what_is_left_empty(dog):
    (empty,) = shapes(plan_svg(dog), "rect", "empty")
    assert float(empty.get("width")) / SCALE == pytest.approx(0.1, abs=1e-4)


def test_every_edge_and_joint_of_the_graph_is_drawn(dog):
    drawing = plan_svg(dog)
    assert len(shapes(drawing, "path", "edge")) == 10
    assert len(shapes(drawing, "circle", "joint")) == 5
    assert len(shapes(drawing, "circle", "merged")) == 3


def test_the_drawing_is_the_same_every_time(dog):
    assert plan_svg(dog) == plan_svg(dog)


def test_titles_cannot_break_the_drawing(planned):
    drawing = plan_svg(planned("""
        title: '<b> & "c"'
        balloons: {a: {size: 260, tail: 10, color: "#1f5fd0"}}
        steps: [{loop: {b: 20}}, {loop: {c: 20}}]
        """))  # fmt: skip
    assert shapes(drawing, "text", "head")[0].text == '<b> & "c"'
    assert {shape.get("fill") for shape in shapes(drawing, "rect", "bubble")} == {"#1f5fd0"}


def test_what_is_popped_is_drawn_empty_and_what_is_pushed_through_is_told(planned):
    drawing = plan_svg(planned("""
        balloons: {a: {size: 260, tail: 12}}
        steps:
          - bubbles: {nose: 5, left: 8, right: 8}
          - lock: [left, right]
          - push: {bubble: nose, through: [left, right]}
          - rest: spare
          - pop: spare
        """))  # fmt: skip
    (popped,) = shapes(drawing, "rect", "popped")
    assert popped.get("fill") is None
    assert len(shapes(drawing, "rect", "bubble")) == 3
    told = [text.text for text in ET.fromstring(drawing).iter(SVG + "text")]
    assert "pushes nose through left, right" in told
    assert any(each.startswith("spare ") and each.endswith(", popped") for each in told)
