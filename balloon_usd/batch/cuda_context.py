"""The context of a GPU, made while a process imports what it needs."""

from __future__ import annotations

import ctypes
import re
import sys
import threading

DRIVER = "nvcuda.dll" if sys.platform == "win32" else "libcuda.so.1"


def wake_gpu(device: str) -> threading.Thread:
    """Let the driver make the context of a device, in a thread that ends with that.

    Warp takes the context that it finds; calls into the driver let other threads of Python run.
    """
    number = re.search(r"\d+", device)
    thread = threading.Thread(target=_make_context, args=(int(number[0]) if number else 0,), daemon=True)
    thread.start()
    return thread


def _make_context(number: int) -> None:
    try:
        driver = ctypes.CDLL(DRIVER)
        device, context = ctypes.c_int(), ctypes.c_void_p()
        if driver.cuInit(0) == 0 and driver.cuDeviceGet(ctypes.byref(device), number) == 0:
            driver.cuDevicePrimaryCtxRetain(ctypes.byref(context), device)
    except (OSError, AttributeError):
        # There is no driver, or an old one: Warp tells if it is needed.
        return
