"""Ray casting of shiny, slightly translucent latex, of foil and clay, and of balls."""

import warp as wp

from balloon_usd.preview.kernels.balls import Balls, first_ball
from balloon_usd.preview.kernels.display import encode, tone
from balloon_usd.preview.kernels.studio import Studio, smooth_step, studio_radiance

FAR = wp.constant(1.0e6)
"""Length of a ray (m)."""
SKIN = wp.constant(4.0e-4)
"""Offset of a ray's origin from the surface (m), above the gap between a fine wall and its smooth normal."""
FRESNEL_0 = wp.constant(0.043)
"""Reflectance of rubber at normal incidence, index 1.52: ((n - 1) / (n + 1))^2."""
BOUNCE = wp.constant(0.55)
"""Share of the light that another balloon's wall sends back, in its own colour."""
GLOW = wp.constant(0.16)
"""Light that comes through the wall from the inside, in the wall's colour."""
EXPOSURE = wp.constant(0.50)
"""Share of the gathered light that leaves the wall again, before its colour."""
SOFT_LAMP = wp.constant(1.5)
"""Radiance at which the lamps are cut off on the floor: a picture of form wants no hard cast shadow."""
TURNED_AWAY = wp.constant(-0.2)
"""Cosine to the eye below which no pixel can see a vertex."""
BALL_STRIDE = wp.constant(12)
"""Every so many directions light a ball, pixel by pixel: it is small."""
WALLS = wp.constant(24)
"""Walls behind each other through which a ray is followed."""
OPAQUE = wp.constant(0.999)
"""Opacity from which on nothing shows through."""
EDGE = wp.constant(0.035)
"""Difference between neighbouring pixels, of a channel 0..1, that shows as a stair step."""


@wp.struct
class Scene:
    """Triangles of all balloons, with what each vertex and triangle carries, and balls."""

    mesh: wp.uint64
    triangles: wp.array2d[wp.int32]
    normals: wp.array[wp.vec3]
    light: wp.array[wp.vec3]
    colors: wp.array[wp.vec3]
    finishes: wp.array[wp.vec3]
    """Metallic, opacity and shine of each triangle, 0..1."""
    directions: wp.array[wp.vec3]
    """Fixed unit directions all over the sphere."""
    radiances: wp.array[wp.float32]
    """What the empty studio sends from each direction."""
    balls: Balls


@wp.struct
class Camera:
    """A pinhole camera; `right` and `up` are scaled by the tangent of half the field of view."""

    eye: wp.vec3
    forward: wp.vec3
    right: wp.vec3
    up: wp.vec3


@wp.struct
class Floor:
    """The baked shadow: `shade` covers the rectangle from `corner` with cells of `cell` metres."""

    corner: wp.vec3
    cell: float
    shade: wp.array2d[wp.vec3]


@wp.func
def blend(
    values: wp.array[wp.vec3], triangles: wp.array2d[wp.int32], face: int, u: float, v: float
) -> wp.vec3:
    """Interpolate a vertex quantity at barycentric (u, v) of a triangle."""
    a = values[triangles[face, 0]]
    b = values[triangles[face, 1]]
    c = values[triangles[face, 2]]
    return wp.vec3(u * a + v * b + (1.0 - u - v) * c)


@wp.kernel
def measure_studio(studio: Studio, directions: wp.array[wp.vec3], radiances: wp.array[wp.float32]):
    """Measure the empty studio in every direction."""
    i = wp.tid()
    radiances[i] = studio_radiance(studio, directions[i])


@wp.func
def gathered_light(scene: Scene, origin: wp.vec3, normal: wp.vec3, stride: int) -> wp.vec3:
    """Return the cosine-weighted mean radiance (rgb) that arrives from every `stride`th direction."""
    total = wp.vec3(0.0, 0.0, 0.0)
    weight = float(0.0)
    for i in range(0, scene.directions.shape[0], stride):
        direction = scene.directions[i]
        facing = wp.dot(direction, normal)
        if facing > 0.0:
            arriving = scene.radiances[i] * wp.vec3(1.0, 1.0, 1.0)
            hit = wp.mesh_query_ray(scene.mesh, origin, direction, FAR)
            if hit.result:
                color = scene.colors[hit.face]
                arriving = BOUNCE * color
            total += facing * arriving
            weight += facing
    return wp.vec3(total / wp.max(weight, 1.0e-6))


@wp.kernel
def light_vertices(
    scene: Scene,
    eye: wp.vec3,
    points: wp.array[wp.vec3],
    normals: wp.array[wp.vec3],
    gathered: wp.array[wp.vec3],
):
    """Bake the light that arrives at each vertex; coarsely where only a reflection can show it."""
    i = wp.tid()
    normal = normals[i]
    stride = wp.where(wp.dot(wp.normalize(eye - points[i]), normal) < TURNED_AWAY, 4, 1)
    gathered[i] = gathered_light(scene, points[i] + SKIN * normal, normal, stride)


@wp.kernel
def light_floor(scene: Scene, floor: Floor, shade: wp.array2d[wp.vec3]):
    """Bake the light on the floor, as a share of what an empty floor gets."""
    row, column = wp.tid()
    up = wp.vec3(0.0, 0.0, 1.0)
    origin = floor.corner + floor.cell * wp.vec3(float(column) + 0.5, float(row) + 0.5, 0.0)
    total = wp.vec3(0.0, 0.0, 0.0)
    empty = float(0.0)
    for i in range(scene.directions.shape[0]):
        direction = scene.directions[i]
        facing = wp.dot(direction, up)
        if facing > 0.0:
            radiance = facing * wp.min(scene.radiances[i], SOFT_LAMP)
            empty += radiance
            hit = wp.mesh_query_ray(scene.mesh, origin, direction, FAR)
            if hit.result:
                # A lit balloon is no black blocker: some light comes through in its colour.
                finish = scene.finishes[hit.face]
                dyed = 0.30 * (1.0 - 0.7 * finish[0]) * scene.colors[hit.face]
                total += radiance * wp.lerp(wp.vec3(1.0, 1.0, 1.0), dyed, finish[1])
            elif first_ball(scene.balls, origin, direction, FAR).ball < 0:
                total += radiance * wp.vec3(1.0, 1.0, 1.0)
    shade[row, column] = total / empty


@wp.kernel
def soften_floor(sharp: wp.array2d[wp.vec3], soft: wp.array2d[wp.vec3]):
    """Blur the floor over 7 x 7 cells: the few directions of the light leave steps in a shadow."""
    row, column = wp.tid()
    total = wp.vec3(0.0, 0.0, 0.0)
    weight = float(0.0)
    for k in range(49):
        i = k // 7 - 3
        j = k % 7 - 3
        share = wp.exp(-0.22 * float(i * i + j * j))
        total += (
            share
            * sharp[wp.clamp(row + i, 0, sharp.shape[0] - 1), wp.clamp(column + j, 0, sharp.shape[1] - 1)]
        )
        weight += share
    soft[row, column] = total / weight


@wp.func
def latex_body(scene: Scene, face: int, u: float, v: float, facing: float) -> wp.vec3:
    """Return the diffuse and translucent light that leaves a wall at a cosine to its normal."""
    # Light that leaves at a flat angle has come a longer way through the dyed wall.
    depth = 1.0 + 0.35 * (1.0 - facing) * (1.0 - facing)
    dye = scene.colors[face]
    color = wp.vec3(wp.pow(dye[0], depth), wp.pow(dye[1], depth), wp.pow(dye[2], depth))
    light = blend(scene.light, scene.triangles, face, u, v)
    return wp.cw_mul(color, EXPOSURE * light + GLOW * wp.vec3(1.0, 1.0, 1.0))


@wp.func
def reflectance(color: wp.vec3, finish: wp.vec3, facing: float) -> wp.vec3:
    """Return the share (rgb) that a wall mirrors at a cosine to its normal: foil in its own colour."""
    straight = wp.lerp(FRESNEL_0 * wp.vec3(1.0, 1.0, 1.0), color, finish[0])
    grazing = wp.pow(1.0 - facing, 5.0)
    return wp.vec3(finish[2] * (straight + grazing * (wp.vec3(1.0, 1.0, 1.0) - straight)))


@wp.func
def mirrored_wall(scene: Scene, studio: Studio, ray: wp.vec3, face: int, u: float, v: float) -> wp.vec3:
    """Return the radiance of a wall that is seen in another one."""
    finish = scene.finishes[face]
    body = latex_body(scene, face, u, v, 1.0)
    normal = wp.normalize(blend(scene.normals, scene.triangles, face, u, v))
    onward = ray - 2.0 * wp.dot(ray, normal) * normal
    foil = studio_radiance(studio, onward) * scene.colors[face]
    return wp.vec3(wp.lerp(body, foil, finish[0]))


@wp.func
def wall(
    scene: Scene, studio: Studio, position: wp.vec3, ray: wp.vec3, face: int, u: float, v: float
) -> wp.vec3:
    """Return the radiance of a wall seen along a ray: what its body hides, under a clear, reflecting skin."""
    finish = scene.finishes[face]
    normal = wp.normalize(blend(scene.normals, scene.triangles, face, u, v))
    if finish[1] < OPAQUE and wp.dot(ray, normal) > 0.0:
        normal = -normal
    facing = wp.max(-wp.dot(ray, normal), 0.0)
    share = reflectance(scene.colors[face], finish, facing)
    onward = ray - 2.0 * wp.dot(ray, normal) * normal
    seen = wp.vec3(1.0, 1.0, 1.0) * studio_radiance(studio, onward)
    hit = wp.mesh_query_ray(scene.mesh, position + SKIN * normal, onward, FAR)
    if hit.result:
        seen = mirrored_wall(scene, studio, onward, hit.face, hit.u, hit.v)
    body = finish[1] * (1.0 - finish[0]) * latex_body(scene, face, u, v, facing)
    return wp.vec3(wp.cw_mul(wp.vec3(1.0, 1.0, 1.0) - share, body) + wp.cw_mul(share, seen))


@wp.func
def ball_radiance(scene: Scene, studio: Studio, position: wp.vec3, ray: wp.vec3, ball: int) -> wp.vec3:
    """Return the radiance of a ball seen along a ray: body colour under a reflecting skin."""
    normal = wp.normalize(position - scene.balls.centres[ball])
    facing = wp.max(-wp.dot(ray, normal), 0.0)
    fresnel = FRESNEL_0 + (1.0 - FRESNEL_0) * wp.pow(1.0 - facing, 5.0)
    light = gathered_light(scene, position + SKIN * normal, normal, BALL_STRIDE)
    body = wp.cw_mul(scene.balls.colors[ball], EXPOSURE * light + GLOW * wp.vec3(1.0, 1.0, 1.0))
    mirrored = studio_radiance(studio, ray - 2.0 * wp.dot(ray, normal) * normal)
    return wp.vec3((1.0 - fresnel) * body + fresnel * mirrored * wp.vec3(1.0, 1.0, 1.0))


@wp.func
def floor_shade(floor: Floor, position: wp.vec3) -> wp.vec3:
    """Return the baked shade at a point of the floor, fading to none at the border."""
    rows = floor.shade.shape[0]
    columns = floor.shade.shape[1]
    x = (position[0] - floor.corner[0]) / floor.cell - 0.5
    y = (position[1] - floor.corner[1]) / floor.cell - 0.5
    none = wp.vec3(1.0, 1.0, 1.0)
    if x <= 0.0 or y <= 0.0 or x >= float(columns - 1) or y >= float(rows - 1):
        return none
    i = wp.int32(x)
    j = wp.int32(y)
    near = wp.lerp(floor.shade[j, i], floor.shade[j, i + 1], x - float(i))
    far = wp.lerp(floor.shade[j + 1, i], floor.shade[j + 1, i + 1], x - float(i))
    inside_x = wp.min(x / float(columns - 1), 1.0 - x / float(columns - 1))
    inside_y = wp.min(y / float(rows - 1), 1.0 - y / float(rows - 1))
    return wp.lerp(none, wp.lerp(near, far, y - float(j)), smooth_step(0.0, 0.15, wp.min(inside_x, inside_y)))


@wp.func
def backdrop(across: float, height: float) -> wp.vec3:
    """Return the paper behind the sculpture for screen coordinates -1..1: pale, brighter in the middle."""
    spread = 1.0 - 0.08 * (across * across + 0.8 * height * height)
    return wp.vec3(0.86 * spread, 0.87 * spread, 0.885 * spread)


@wp.func
def behind(
    studio: Studio, camera: Camera, floor: Floor, ray: wp.vec3, across: float, height: float
) -> wp.vec3:
    """Return what a ray sees where nothing is in its way: the paper, with the shadow on it."""
    radiance = backdrop(across, height)
    if ray[2] < -1.0e-4:
        distance = (studio.floor - camera.eye[2]) / ray[2]
        radiance = wp.cw_mul(radiance, floor_shade(floor, camera.eye + distance * ray))
    return radiance


@wp.func
def seen_through(
    scene: Scene, studio: Studio, camera: Camera, floor: Floor, across: float, height: float
) -> wp.vec3:
    """Return the display-referred rgb at screen coordinates -1..1."""
    ray = wp.normalize(camera.forward + across * camera.right + height * camera.up)
    origin = camera.eye
    seen = wp.vec3(0.0, 0.0, 0.0)
    through = float(1.0)
    for _ in range(WALLS):
        if through > 1.0 - OPAQUE:
            hit = wp.mesh_query_ray(scene.mesh, origin, ray, FAR)
            nearest = first_ball(scene.balls, origin, ray, wp.where(hit.result, hit.t, FAR))
            if nearest.ball >= 0:
                position = origin + nearest.distance * ray
                seen += through * tone(ball_radiance(scene, studio, position, ray, nearest.ball))
                through = 0.0
            elif hit.result:
                position = origin + hit.t * ray
                seen += through * tone(wall(scene, studio, position, ray, hit.face, hit.u, hit.v))
                through *= 1.0 - scene.finishes[hit.face][1]
                origin = position + SKIN * ray
            else:
                seen += through * behind(studio, camera, floor, ray, across, height)
                through = 0.0
    return encode(seen)


@wp.kernel
def draw(scene: Scene, studio: Studio, camera: Camera, floor: Floor, picture: wp.array2d[wp.vec3]):
    """Draw each pixel from one ray through its middle, as display-referred rgb 0..1."""
    row, column = wp.tid()
    across = (float(column) + 0.5) / float(picture.shape[1]) * 2.0 - 1.0
    height = 1.0 - (float(row) + 0.5) / float(picture.shape[0]) * 2.0
    picture[row, column] = seen_through(scene, studio, camera, floor, across, height)


@wp.func
def contrast(picture: wp.array2d[wp.vec3], row: int, column: int) -> float:
    """Return the largest difference of a channel between a pixel and its eight neighbours."""
    here = picture[row, column]
    most = float(0.0)
    for k in range(9):
        i = wp.clamp(row + k // 3 - 1, 0, picture.shape[0] - 1)
        j = wp.clamp(column + k % 3 - 1, 0, picture.shape[1] - 1)
        change = picture[i, j] - here
        most = wp.max(most, wp.max(wp.abs(change)))
    return most


@wp.kernel
def smooth_edges(
    scene: Scene,
    studio: Studio,
    camera: Camera,
    floor: Floor,
    samples: int,
    picture: wp.array2d[wp.vec3],
    smoothed: wp.array2d[wp.vec3],
):
    """Draw the pixels that differ from a neighbour again, from samples x samples rays."""
    row, column = wp.tid()
    if contrast(picture, row, column) < EDGE:
        smoothed[row, column] = picture[row, column]
        return
    total = wp.vec3(0.0, 0.0, 0.0)
    for k in range(samples * samples):
        x = float(column) + (float(k % samples) + 0.5) / float(samples)
        y = float(row) + (float(k // samples) + 0.5) / float(samples)
        across = x / float(picture.shape[1]) * 2.0 - 1.0
        height = 1.0 - y / float(picture.shape[0]) * 2.0
        total += seen_through(scene, studio, camera, floor, across, height)
    smoothed[row, column] = total / float(samples * samples)
