"""The exchange room: meshes leave for other formats and come in from them, through meshio.

Out: `balloon_usd.exchange.export.export_stage`. In: `balloon_usd.exchange.read_shape.read_shape`. What reads
needs no USD, so each is imported by its own name.
"""
