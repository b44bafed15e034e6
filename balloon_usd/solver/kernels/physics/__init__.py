"""Rubber, gas, joints and contact: the kernels of the latex model, some of which both models share."""
