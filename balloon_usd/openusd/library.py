"""The library of OpenUSD, loaded without the interpreter's lock.

What the library makes while it is loaded it makes without the interpreter's lock, and takes that again in
the middle of the system's loader, which has a lock of its own. A thread that imports any compiled module
meanwhile has the interpreter's lock and waits for the loader's, so that neither goes on. A thread that loads
the library without having the interpreter's lock does not ask for it.
"""

from __future__ import annotations

import ctypes
import os
import sys
from importlib.machinery import EXTENSION_SUFFIXES
from importlib.util import find_spec
from pathlib import Path


def load_library() -> None:
    """Load the first compiled module of `pxr`, and with it the library; does nothing where there is none.

    On Windows it is left to the import of that module.
    """
    if sys.platform == "win32":
        return
    dlopen = ctypes.CDLL(None).dlopen
    dlopen.argtypes, dlopen.restype = (ctypes.c_char_p, ctypes.c_int), ctypes.c_void_p
    package = find_spec("pxr")
    for folder in (package and package.submodule_search_locations) or ():
        for module in (Path(folder, "Tf", f"_tf{ending}") for ending in EXTENSION_SUFFIXES):
            if module.is_file():
                # Unlike an import, a call of a foreign function is made without the interpreter's lock.
                dlopen(os.fsencode(module), os.RTLD_NOW)
