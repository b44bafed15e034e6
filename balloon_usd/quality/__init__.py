"""The quality room: how a finished figure compares with its plan, in a few measures with limits.

Needs no USD: `watch.QualityWatch` takes frames as they come, counts the crossings of walls in some of them,
and looks closely at the last one. Many frames are counted by Warp, which needs no GPU for it.
"""
