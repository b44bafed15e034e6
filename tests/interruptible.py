"""Child processes that heed Ctrl-C and a closed terminal, also where the tests run in the background."""

from __future__ import annotations

import signal
import subprocess


def start(words, ignoring=(), **options):
    """Start a process with its pipes open, interruptible as one that a user types.

    `ignoring`: signals that it is started to ignore, as by nohup.
    """
    pipe = subprocess.PIPE

    def heed():
        # What ignores a signal hands that on to its children, unless they are told otherwise.
        for number in (signal.SIGINT, signal.SIGHUP):
            signal.signal(number, signal.SIG_IGN if number in ignoring else signal.SIG_DFL)

    return subprocess.Popen(words, stdout=pipe, stderr=pipe, text=True, preexec_fn=heed, **options)
