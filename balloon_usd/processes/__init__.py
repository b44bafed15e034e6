"""Processes that work for this one: forked or new, connected to it, and gone when it is."""
