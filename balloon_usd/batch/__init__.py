"""Batches: any number of recipes becomes stages, with all cores and GPUs of a machine.

A scheduler (this process) hands out work; simulator processes leave frames in shared memory, writer processes
make stages of them. OpenUSD is only used by writers, each of which has one thread.
"""
