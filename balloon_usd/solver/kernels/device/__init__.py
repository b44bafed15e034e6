"""Access to the device beyond Warp's own words: arrays, coherent loads, shared memory, warps and barriers."""
