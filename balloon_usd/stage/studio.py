"""What stands round the sculpture in a shot: cameras, lamps and a ground that curves up behind it."""

from __future__ import annotations

from math import cos, pi, radians, sin, tan
from typing import TYPE_CHECKING, Any

import numpy as np

from balloon_usd.openusd import Gf, Sdf, UsdGeom, UsdLux, UsdShade, Vt
from balloon_usd.stage.lamp import Lamp
from balloon_usd.stage.shaders import preview_surface
from balloon_usd.stage.shot_camera import ASPECT, FOCAL_LENGTH, SENSOR_WIDTH

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from balloon_usd.stage.shot_camera import Viewpoint

TENTHS = 10.0
"""USD gives lenses in tenths of the scene's unit."""
NEAR, FAR = 0.01, 1000.0
"""What the camera sees [m]."""

SHUTTER = 0.25
"""How long a camera exposes before and after a time code, in frames."""

DECIMALS = 6
"""Of all places and directions: micrometres are enough, and the last bit of a sine reaches no file."""

SKY = 0.22
"""Radiance all around, relative to a white wall at 1."""


LAMPS = (
    Lamp("key", radians(-48.0), radians(46.0), radians(20.0), radians(25.0), 6.0),
    Lamp("rim", radians(125.0), radians(30.0), radians(12.0), radians(30.0), 5.0),
    Lamp("top", radians(160.0), radians(72.0), radians(35.0), radians(22.0), 2.0),
)
"""A big key from the upper left, a strip behind on the right for the edge, a bank overhead."""
AWAY = 1.6
"""Distance of the lamps, in diagonals of the sculpture's room."""

GROUND_COLOR = (0.58, 0.57, 0.55)
GROUND_ROUGHNESS = 0.9
CLEARANCE = 1e-4
"""Gap between the lowest point and the ground [m]."""
FORWARD, BEHIND, SIDE, RADIUS, WALL = 8.0, 2.0, 8.0, 1.5, 5.0
"""Ground towards the camera and behind the middle up to where it curves, half its width, the radius of the
curve, and the wall above it, in diagonals of the sculpture's room."""
CURVE = 12
"""Faces along the curve: with smooth normals a few look round, and the file stays small enough for text."""


def author_camera(stage: Any, path: Any, view: Viewpoint) -> None:
    """Author a camera at a viewpoint."""
    camera = UsdGeom.Camera.Define(stage, path)
    camera.CreateFocalLengthAttr(TENTHS * FOCAL_LENGTH)
    camera.CreateHorizontalApertureAttr(TENTHS * SENSOR_WIDTH)
    camera.CreateVerticalApertureAttr(TENTHS * SENSOR_WIDTH / ASPECT)
    camera.CreateClippingRangeAttr(Gf.Vec2f(NEAR, FAR))
    # All is sharp, and half a frame is exposed: readers take no blur at all where nothing is said.
    camera.CreateFStopAttr(0.0)
    camera.CreateShutterOpenAttr(-SHUTTER)
    camera.CreateShutterCloseAttr(SHUTTER)
    _stand(camera, view.right, view.up, view.eye)


def author_lights(stage: Any, root: Any, extent: NDArray[np.float32], ahead: NDArray[np.float64]) -> None:
    """Author the lamps round a box (2, 3) [m], for a camera that looks along the level direction `ahead`."""
    lights = root.AppendChild("lights")
    UsdGeom.Scope.Define(stage, lights)
    sky = UsdLux.DomeLight.Define(stage, lights.AppendChild("sky"))
    sky.CreateIntensityAttr(SKY)
    # Blender takes the colour of its own default world where none is authored.
    sky.CreateColorAttr(Gf.Vec3f(1.0))
    side, vertical = np.cross(ahead, (0.0, 0.0, 1.0)), np.array([0.0, 0.0, 1.0])
    middle, away = extent.mean(axis=0, dtype=np.float64), AWAY * _diagonal(extent)
    for lamp in LAMPS:
        level = -cos(lamp.azimuth) * ahead + sin(lamp.azimuth) * side
        towards = cos(lamp.elevation) * level + sin(lamp.elevation) * vertical
        right = np.cross(vertical, level)
        light = UsdLux.RectLight.Define(stage, lights.AppendChild(lamp.name))
        light.CreateIntensityAttr(lamp.radiance)
        light.CreateWidthAttr(round(2.0 * away * tan(lamp.width), DECIMALS))
        light.CreateHeightAttr(round(2.0 * away * tan(lamp.height), DECIMALS))
        # A lamp shines along its -z.
        _stand(light, right, np.cross(towards, right), middle + away * towards)


def author_ground(stage: Any, root: Any, extent: NDArray[np.float32], ahead: NDArray[np.float64]) -> None:
    """Author the ground below a box (2, 3) [m]; it curves up to a wall in the direction `ahead`."""
    mesh = UsdGeom.Mesh.Define(stage, root.AppendChild("ground"))
    points, normals = _swept(extent, ahead)
    rows = len(points) // 2
    first = 2 * np.arange(rows - 1, dtype=np.int32)[:, None]
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
    mesh.CreateNormalsAttr(Vt.Vec3fArray.FromNumpy(normals))
    mesh.SetNormalsInterpolation(UsdGeom.Tokens.vertex)
    mesh.CreateExtentAttr(Vt.Vec3fArray.FromNumpy(np.stack([points.min(axis=0), points.max(axis=0)])))
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray(rows - 1, 4))
    mesh.CreateFaceVertexIndicesAttr(
        Vt.IntArray.FromNumpy((first + np.array([0, 1, 3, 2], np.int32)).ravel())
    )
    mesh.CreateSubdivisionSchemeAttr(UsdGeom.Tokens.none)
    mesh.CreateDoubleSidedAttr(True)
    color = Gf.Vec3f(*GROUND_COLOR)
    mesh.CreateDisplayColorAttr(Vt.Vec3fArray([color]))
    scope = root.AppendChild("mtl")
    UsdGeom.Scope.Define(stage, scope)
    UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(_paper(stage, scope.AppendChild("paper"), color))


def _swept(
    extent: NDArray[np.float32], ahead: NDArray[np.float64]
) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    """Points (V, 3) and normals (V, 3) of the ground, two a row from the camera to the top of the wall."""
    size = _diagonal(extent)
    turn = np.linspace(0.0, 0.5 * pi, CURVE + 1)
    along = np.concatenate([[-FORWARD], BEHIND + RADIUS * np.sin(turn), [BEHIND + RADIUS]])
    above = np.concatenate([[0.0], RADIUS * (1.0 - np.cos(turn)), [RADIUS + WALL]])
    facing = np.concatenate([[0.0], turn, [0.5 * pi]])
    vertical = np.array([0.0, 0.0, 1.0])
    across = SIDE * np.cross(ahead, vertical)
    middle = extent.mean(axis=0, dtype=np.float64)
    middle[2] = float(extent[0, 2]) - CLEARANCE
    line = np.outer(along, ahead) + np.outer(above, vertical)
    normal = np.outer(np.cos(facing), vertical) - np.outer(np.sin(facing), ahead)
    points = middle + size * np.stack([line - across, line + across], axis=1).reshape(-1, 3)
    return _rounded(points), _rounded(np.repeat(normal, 2, axis=0))


def _paper(stage: Any, path: Any, color: Any) -> Any:
    """A matt material."""
    material, surface = preview_surface(stage, path)
    surface.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(color)
    surface.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(GROUND_ROUGHNESS)
    return material


def _stand(
    prim: Any, right: NDArray[np.float64], up: NDArray[np.float64], place: NDArray[np.float64]
) -> None:
    """Place a camera or a lamp, which look along their -z."""
    rows = np.zeros((4, 4))
    rows[:3, :3] = [right, up, np.cross(right, up)]
    rows[3] = [*place, 1.0]
    matrix = Gf.Matrix4d(*np.round(rows, DECIMALS).ravel().tolist())
    UsdGeom.Xformable(prim).AddTransformOp().Set(matrix)


def _diagonal(extent: NDArray[np.float32]) -> float:
    return float(np.linalg.norm(extent[1].astype(np.float64) - extent[0]))


def _rounded(values: NDArray[np.float64]) -> NDArray[np.float32]:
    # Adding zero turns -0 into 0.
    return (np.round(values, DECIMALS) + 0.0).astype(np.float32)
