"""The exchange room: the meshes of a stage leave for other formats, through meshio."""
