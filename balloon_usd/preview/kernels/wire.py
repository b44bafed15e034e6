"""Drawing of strokes and balls in front of the paper, each pixel from the nearest to the farthest."""

import warp as wp

from balloon_usd.preview.kernels.display import encode
from balloon_usd.preview.kernels.raycast import Camera, Floor, backdrop, floor_shade

CLEAR = wp.constant(0.004)
"""Share of the light that comes through beyond which nothing can be seen, half a step of a display."""
LAMP = wp.constant(wp.vec3(-0.46, 0.62, 0.635))
"""Where the light on a ball comes from: right, up and towards the eye."""
HALFWAY = wp.constant(wp.vec3(-0.254, 0.343, 0.904))
"""Unit vector midway between the lamp and the eye."""


@wp.struct
class Sheet:
    """Straight lines and balls on the picture (pixels, y down), nearest first."""

    ends: wp.array[wp.vec4]
    """Both ends (x, y, x, y); a ball has its middle twice."""
    reach: wp.array[wp.float32]
    """Half the width of a line, radius of a ball."""
    paint: wp.array[wp.vec4]
    """Linear rgb and opacity."""
    is_ball: wp.array[wp.int32]
    tile: int
    """Pixels along the side of a tile."""
    across: int
    """Tiles side by side."""
    starts: wp.array[wp.int32]
    """First entry of each tile in `order`, and the number of entries."""
    order: wp.array[wp.int32]
    """Strokes that touch each tile, nearest first."""


@wp.func
def overlap(place: float, low: float, high: float) -> float:
    """Return the share of the unit interval round a place that lies between two others."""
    return wp.clamp(wp.min(place + 0.5, high) - wp.max(place - 0.5, low), 0.0, 1.0)


@wp.func
def line_cover(ends: wp.vec4, half: float, x: float, y: float) -> float:
    """Return how much of a pixel a line covers; its ends are cut straight, so that they do not pile up."""
    ahead = wp.vec2(ends[2] - ends[0], ends[3] - ends[1])
    length = wp.length(ahead)
    if length < 1.0e-3:
        return 0.0
    ahead = ahead / length
    away = wp.vec2(x - ends[0], y - ends[1])
    along = wp.dot(away, ahead)
    beside = away[0] * ahead[1] - away[1] * ahead[0]
    return overlap(along, 0.0, length) * overlap(beside, -half, half)


@wp.func
def ball_paint(color: wp.vec3, x: float, y: float) -> wp.vec3:
    """Return the radiance of a ball at an offset from its middle (radii, y up): matt, with one highlight."""
    flat = wp.min(x * x + y * y, 1.0)
    normal = wp.vec3(x, y, wp.sqrt(1.0 - flat))
    lit = 0.42 + 0.78 * wp.max(wp.dot(normal, LAMP), 0.0)
    shine = 0.55 * wp.pow(wp.max(wp.dot(normal, HALFWAY), 0.0), 48.0)
    return lit * color + shine * wp.vec3(1.0, 1.0, 1.0)


@wp.kernel
def draw_sheet(sheet: Sheet, camera: Camera, floor: Floor, height: float, picture: wp.array2d[wp.vec3]):
    """Draw each pixel as display-referred rgb 0..1; the floor lies at `height` (m)."""
    row, column = wp.tid()
    x = float(column) + 0.5
    y = float(row) + 0.5
    tile = (row // sheet.tile) * sheet.across + column // sheet.tile
    through = float(1.0)
    radiance = wp.vec3(0.0, 0.0, 0.0)
    k = sheet.starts[tile]
    while k < sheet.starts[tile + 1] and through > CLEAR:
        stroke = sheet.order[k]
        ends = sheet.ends[stroke]
        reach = sheet.reach[stroke]
        paint = sheet.paint[stroke]
        color = wp.vec3(paint[0], paint[1], paint[2])
        cover = float(0.0)
        if sheet.is_ball[stroke] == 1:
            right = x - ends[0]
            up = ends[1] - y
            cover = wp.clamp(reach + 0.5 - wp.sqrt(right * right + up * up), 0.0, wp.min(1.0, 2.0 * reach))
            if cover > 0.0:
                color = ball_paint(color, right / reach, up / reach)
        else:
            cover = line_cover(ends, reach, x, y)
        radiance += through * cover * paint[3] * color
        through *= 1.0 - cover * paint[3]
        k += 1
    sideways = x / float(picture.shape[1]) * 2.0 - 1.0
    upwards = 1.0 - y / float(picture.shape[0]) * 2.0
    paper = backdrop(sideways, upwards)
    ray = wp.normalize(camera.forward + sideways * camera.right + upwards * camera.up)
    if ray[2] < -1.0e-4:
        distance = (height - camera.eye[2]) / ray[2]
        paper = wp.cw_mul(paper, floor_shade(floor, camera.eye + distance * ray))
    picture[row, column] = encode(radiance + through * paper)
