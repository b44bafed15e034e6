"""Measurements of speed, with what is promised beside what was measured."""
