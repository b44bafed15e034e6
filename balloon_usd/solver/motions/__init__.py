"""Motions: what hands do over time, one file a move of a plan; those of one model lie beside that model."""
