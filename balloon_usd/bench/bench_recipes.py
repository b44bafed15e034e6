"""What is measured; it stays the same from version to version, whatever the shipped recipes become."""

from __future__ import annotations

CLASSIC_DOG = """\
format: 1
name: dog
units: cm
balloons:
  main: {size: 260, tail: 10}
steps:
  - bubbles: {nose: 10, left_ear: 10, right_ear: 10}
  - lock: [left_ear, right_ear]
    point: up
  - bubbles: {neck: 7, left_foreleg: 12, right_foreleg: 12}
  - lock: [left_foreleg, right_foreleg]
    point: down
  - bubbles: {body: 15, left_hindleg: 12, right_hindleg: 12}
  - lock: [left_hindleg, right_hindleg]
    point: down
  - rest: tail
"""

MOUSE = """\
format: 1
name: mouse
units: cm
balloons:
  main: {size: 260, tail: 28}
steps:
  - bubbles: {nose: 4, left_ear: 5, right_ear: 5}
  - lock: [left_ear, right_ear]
    point: up
  - rest: tail
"""

PAIR = """\
format: 1
name: pair
units: cm
balloons:
  one: {size: 260, tail: 20}
  two: {size: 160, tail: 20}
steps:
  - bubbles: {head: 10, body: 12}
    balloon: one
  - bubbles: {left: 8, right: 8}
    balloon: two
  - rest: tail_one
    balloon: one
  - rest: tail_two
    balloon: two
"""

MIXED = {"dog": CLASSIC_DOG, "mouse": MOUSE, "pair": PAIR}
"""Different recipes of one frame rate that advance together: one balloon or two, long and short."""

EXPERIMENT = """\
format: 1
name: experiment
units: cm
balloons:
  main: {{size: 260, capsule: {length:g}}}
steps:
  - wait: 60
physics: {{model: kosaka}}
"""
"""The thesis's capsule of springs and air particles (Kosaka 2008, 4.1), and longer ones."""

LENGTHS = (20.0, 40.0, 80.0, 150.0)
"""Lengths of capsules that are measured, cm: the thesis's up to a whole 260."""
