"""The 32 properties: what each says, for which stages it holds, where it is tested, what to do about it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from balloon_usd.stage.properties import composition, looks, primvars, size, surface, timing
from balloon_usd.stage.properties.kinds import StageKind

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from balloon_usd.stage.properties.finding import Finding
    from balloon_usd.stage.properties.shape import Moment, Value

ON_THE_STAGE = "on the stage"
IN_THE_FOLDER = "in the folder of the stage"
ON_A_FLATTENED_FRAME = "on its first, middle and last frame, flattened"
IN_EVERY_VARIANT = "by all the other properties in every variant"
BY_TWO_RUNS = "with two runs of one recipe"
IN_BLENDER = "with Blender"
BY_PICTURES = "with a contact sheet, as `balloon-usd preview` draws it"

ALL = frozenset(StageKind)
SCULPTURES = frozenset({StageKind.ASSET, StageKind.PACKAGE})
"""Kinds that hold one sculpture; in a shot there is more, and the sculptures have stages of their own."""


@dataclass(frozen=True)
class Property:
    """Something that is true of every stage that is written here."""

    says: str
    """The property in one sentence."""
    remedy: str
    """What to do where it is not true."""
    where: str = ON_THE_STAGE
    """How it is tested."""
    kinds: frozenset[StageKind] = ALL
    """Stages that have it."""
    of_stage: tuple[Callable[[Any], Iterator[Finding]], ...] = ()
    """Look at an open stage."""
    of_values: tuple[Callable[[Value], Iterator[Finding]], ...] = ()
    """Look at every value of every attribute."""
    at_moments: tuple[Callable[[Moment], Iterator[Finding]], ...] = ()
    """Look at every mesh and cloud of points at every sample of its points."""


PROPERTIES: dict[int, Property] = {
    1: Property(
        "Opens without composition error; no unresolved asset.",
        "put the missing file back, or remove the reference to it",
        of_stage=(composition.opens_whole,),
    ),
    2: Property(
        "One root prim, which is the default prim, an Xform, kind component (a shot: assembly).",
        "make one Xform of that kind the only root and the defaultPrim",
        of_stage=(composition.one_component_root,),
    ),
    3: Property(
        "Up axis, metersPerUnit 1, both rates, start and end authored on the root layer.",
        "author it on the root layer: Z up (a package: Y), metersPerUnit 1, both rates, start and end",
        of_stage=(composition.units_and_times_authored,),
    ),
    4: Property(
        "timeCodesPerSecond equals framesPerSecond; 24 unless the recipe says otherwise.",
        "author both rates alike, as the frame rate of the recipe",
        of_stage=(composition.rates_agree,),
    ),
    5: Property(
        "One points sample per whole time code of the range, none outside; the same times on its fellows.",
        "author a sample at each whole time code from startTimeCode to endTimeCode, and nowhere else",
        of_stage=(timing.one_sample_per_time_code, timing.no_hidden_samples),
    ),
    6: Property(
        "Only relative asset paths; the folder can be moved and still opens.",
        "write the path relative to the file that holds it, and keep what it names in the folder",
        of_stage=(composition.only_relative_paths,),
    ),
    7: Property(
        "No typeless def, no dangling over.",
        "give the prim a type and the specifier def, or remove it",
        of_stage=(composition.nothing_undefined,),
    ),
    8: Property(
        "The size in metres is plausible.",
        "author metres; a sculpture in centimetres is a hundred times too large",
        kinds=SCULPTURES,
        of_stage=(size.plausible_size,),
    ),
    9: Property(
        "Provenance complete and free of facts of the run; assetInfo name and identifier.",
        "write the stage with `balloon-usd run`, or author customLayerData.balloon_usd and assetInfo",
        kinds=SCULPTURES,
        of_stage=(composition.provenance_complete,),
    ),
    10: Property(
        "extentsHint on the payload's prim, equal to the union over time.",
        "author extentsHint as the smallest and largest corner over all time codes",
        kinds=SCULPTURES,
        of_stage=(size.extents_hint_is_union,),
    ),
    11: Property(
        "No animated visibility.",
        "remove the samples: DCC tools show the prim all the time, or never",
        of_stage=(composition.no_animated_visibility,),
    ),
    12: Property(
        "Valid topology at every sample, constant count of points.",
        "author faces of three corners or more, all of them points, and as many points in every sample",
        of_stage=(surface.points_authored,),
        of_values=(surface.faces_fit_points,),
        at_moments=(surface.count_constant,),
    ),
    13: Property(
        "No NaN or infinity anywhere.",
        "simulate again: a value that is no number spreads; `--detail` or more substeps may help",
        of_values=(surface.all_finite,),
    ),
    14: Property(
        "Extent per sample, enclosing and tight.",
        "compute extent anew from the points of its time code",
        at_moments=(surface.extents_tight,),
    ),
    15: Property(
        "Watertight, consistent winding, outward, no zero-area face, no unused or coincident point.",
        "close and weld the mesh, and wind its faces counter-clockwise, seen from outside",
        of_values=(surface.edges_closed,),
        at_moments=(surface.surface_whole,),
    ),
    16: Property(
        "subdivisionScheme authored; no normals on subdivided meshes.",
        "author subdivisionScheme: without it every mesh is a Catmull-Clark cage",
        of_stage=(surface.subdivision_authored,),
    ),
    17: Property(
        "Topology not time-sampled.",
        "author it as a default",
        of_stage=(timing.static_topology,),
    ),
    18: Property(
        "Velocities absent, or per second and within a factor 2 of the finite difference.",
        "leave velocities out, or author the way of one second, not of one frame",
        at_moments=(timing.velocities_true,),
    ),
    19: Property(
        "No teleport between frames.",
        "look at the frame before: points were put in another order, or a frame is missing or broken",
        at_moments=(timing.no_teleport,),
    ),
    20: Property(
        "Primvar lengths fit their interpolation at every sample; DCC-safe types only.",
        "author as many values as the interpolation has elements",
        of_stage=(primvars.types_of_schemas, primvars.types_arrive),
        of_values=(primvars.lengths_fit,),
    ),
    21: Property(
        "Bubble subsets partition the faces; bound ones, family materialBind, cover a mesh without material.",
        "put every face into one subset of the family",
        of_stage=(looks.bubbles_partition,),
    ),
    22: Property(
        "All that is visible has one material inside the asset, a UsdPreviewSurface with colours in 0..1.",
        "give the material a UsdPreviewSurface with linear colours from 0 to 1",
        of_stage=(looks.materials_bound,),
    ),
    23: Property(
        "Points: widths above 0, ids unique. No gprim below a gprim.",
        "author a width above 0 and an id of its own for each particle; keep gprims side by side",
        of_stage=(looks.points_and_nesting,),
    ),
    24: Property(
        "Default points equal the last sample: still viewers show the finished sculpture.",
        "author the default as the value of the last sample",
        of_stage=(timing.default_is_last,),
    ),
    25: Property(
        "displayColor and doubleSided authored.",
        "author it: readers without materials need it",
        of_stage=(looks.color_and_sides_authored,),
    ),
    26: Property("Arrives in Blender bit for bit, materials and attributes too.", "", IN_BLENDER),
    27: Property("Blender's positions equal the simulator's own.", "", IN_BLENDER),
    28: Property(
        "The contact sheet shows something coloured in each frame, and frames differ.", "", BY_PICTURES
    ),
    29: Property("Two runs of one recipe give byte-identical files.", "", BY_TWO_RUNS),
    30: Property(
        "No half-written file is left.",
        "remove what a killed run has left, or run the recipe again, which does it",
        IN_THE_FOLDER,
    ),
    31: Property(
        "The flattened layer equals the composed stage.",
        "write it without instances, for readers that do not compose",
        ON_A_FLATTENED_FRAME,
        SCULPTURES,
    ),
    32: Property(
        "Each selection of variants validates.",
        "write the missing variant with `balloon-usd run`",
        IN_EVERY_VARIANT,
        SCULPTURES,
    ),
}
"""All properties by number."""


def properties_of(kind: StageKind) -> dict[int, Property]:
    """Properties that stages of a kind have."""
    return {number: told for number, told in PROPERTIES.items() if kind in told.kinds}
