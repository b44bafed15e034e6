"""Motions of the latex model, and its table of them."""
