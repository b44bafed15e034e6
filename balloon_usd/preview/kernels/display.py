"""From linear light to what a display shows."""

import warp as wp


@wp.func
def tone(radiance: wp.vec3) -> wp.vec3:
    """Compress highlights with a smooth shoulder, as film does."""
    return wp.vec3(shoulder(radiance[0]), shoulder(radiance[1]), shoulder(radiance[2]))


@wp.func
def shoulder(x: float) -> float:
    """Leave values below 0.6 as they are and bend what is above towards 1."""
    if x <= 0.6:
        return x
    return 1.0 - 0.4 * wp.exp(-(x - 0.6) / 0.4)


@wp.func
def encode(radiance: wp.vec3) -> wp.vec3:
    """Encode linear light for the display (sRGB, IEC 61966-2-1)."""
    return wp.vec3(encode_channel(radiance[0]), encode_channel(radiance[1]), encode_channel(radiance[2]))


@wp.func
def encode_channel(x: float) -> float:
    """Encode one channel of linear light."""
    c = wp.clamp(x, 0.0, 1.0)
    if c <= 0.0031308:
        return 12.92 * c
    return 1.055 * wp.pow(c, 1.0 / 2.4) - 0.055
