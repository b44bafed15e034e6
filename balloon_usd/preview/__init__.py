"""The preview room: pictures of sculptures as shiny latex or as wire, from arrays or from any USD stage."""

from __future__ import annotations

from balloon_usd.preview.cage import Cage
from balloon_usd.preview.camera import VIEWS, View
from balloon_usd.preview.contact_sheet import draw_contact_sheet, spread_moments
from balloon_usd.preview.error import PictureNotWrittenError, PreviewError
from balloon_usd.preview.particles import Particles
from balloon_usd.preview.raycast import Raycaster
from balloon_usd.preview.read_stage import StageScene, read_stage
from balloon_usd.preview.render import quad_surface, render_mesh, render_meshes
from balloon_usd.preview.shot import Shot
from balloon_usd.preview.wireframe import Wireframe

__all__ = [
    "VIEWS",
    "Cage",
    "Particles",
    "PictureNotWrittenError",
    "PreviewError",
    "Raycaster",
    "Shot",
    "StageScene",
    "View",
    "Wireframe",
    "draw_contact_sheet",
    "quad_surface",
    "read_stage",
    "render_mesh",
    "render_meshes",
    "spread_moments",
]
