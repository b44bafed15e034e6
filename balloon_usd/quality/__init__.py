"""The quality room: how a finished figure compares with its plan, in a few measures with limits.

Needs no USD and no device: `watch.QualityWatch` takes frames as they come, and looks closely at the last one.
"""
