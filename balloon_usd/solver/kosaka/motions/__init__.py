"""Motions of the thesis's model, and its table of them."""
