"""The mesh file room: a balloon's unstressed shape from a file of any format that meshio reads."""
