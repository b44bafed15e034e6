"""OpenUSD, one thread at a time: its modules, its first calls, and every stretch of work in it.

Two threads that use OpenUSD at once may wait for each other for ever: one holds the interpreter's lock and
waits for an object of C++ that is made on its first use; the other makes that object and waits for the
interpreter's lock. Modules of `pxr` that two threads import at once wait so, too, or lack half their names.
Therefore

- modules of `pxr` are imported from here, never by themselves. Python lets one thread import this package,
  which imports them all and makes the first calls; other threads wait for it;
- every entry point of the rooms that use them works within `usd_access`. A caller's frames are waited for
  outside of it: they may come from another thread.
"""

from __future__ import annotations

from balloon_usd.endings import endings_wait
from balloon_usd.openusd.access import each_step_alone, usd_access
from balloon_usd.openusd.library import load_library

with endings_wait():
    load_library()
    from pxr import (
        Ar,
        Gf,
        Kind,
        Pcp,
        Sdf,
        Tf,
        Usd,
        UsdGeom,
        UsdLux,
        UsdShade,
        UsdUtils,
        UsdValidation,
        Vt,
    )

from balloon_usd.openusd.first_calls import make_first_calls

make_first_calls()

__all__ = [
    "Ar",
    "Gf",
    "Kind",
    "Pcp",
    "Sdf",
    "Tf",
    "Usd",
    "UsdGeom",
    "UsdLux",
    "UsdShade",
    "UsdUtils",
    "UsdValidation",
    "Vt",
    "each_step_alone",
    "usd_access",
]
