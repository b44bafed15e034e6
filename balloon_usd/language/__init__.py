"""The language that recipes are written in: YAML with places, names, quantities with units, choices."""
