"""The table of all device arrays: structs in which kernels take them, each array with its shape and unit."""
