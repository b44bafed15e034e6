from __future__ import annotations

import shutil

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade, Vt

from balloon_usd.preview import PreviewError, read_stage
from balloon_usd.stage import write_stage
from tests.stage.tubes import frames, sculpture

CUBE = np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)], dtype=np.float32)
QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])


def new_stage(up: str = "Z", metres: float = 1.0):
    stage = Usd.Stage.CreateInMemory()
    UsdGeom.SetStageUpAxis(stage, up)
    UsdGeom.SetStageMetersPerUnit(stage, metres)
    stage.SetDefaultPrim(UsdGeom.Xform.Define(stage, "/toy").GetPrim())
    return stage


def add_cube(stage, path="/toy/cube", points=CUBE):
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreateFaceVertexCountsAttr([4] * 6)
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(QUADS.astype(np.int32).ravel()))
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(np.ascontiguousarray(points, dtype=np.float32)))
    return mesh


def add_points(stage, path="/toy/air", points=((0, 0, 0), (1, 2, 3)), widths=(0.5,), colors=None):
    cloud = UsdGeom.Points.Define(stage, path)
    cloud.CreatePointsAttr([Gf.Vec3f(*point) for point in points])
    if widths:
        cloud.CreateWidthsAttr(list(widths))
    if colors:
        cloud.CreateDisplayColorPrimvar("vertex").Set([Gf.Vec3f(*color) for color in colors])
    return cloud


def paint(stage, prim, name, color):
    material = UsdShade.Material.Define(stage, f"/toy/{name}")
    shader = UsdShade.Shader.Define(stage, f"/toy/{name}/preview")
    shader.CreateIdAttr("UsdPreviewSurface")
    shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*color))
    material.CreateSurfaceOutput().ConnectToSource(shader.CreateOutput("surface", Sdf.ValueTypeNames.Token))
    UsdShade.MaterialBindingAPI.Apply(prim).Bind(material)


@pytest.fixture
def save(tmp_path):
    def write(stage):
        path = tmp_path / "toy.usda"
        stage.GetRootLayer().Export(str(path))
        return path

    return write


def test_points_are_read_in_metres_with_z_up(save):
    stage = new_stage("Y", 0.01)
    add_cube(stage, points=CUBE * [100, 200, 300])
    (points,) = read_stage(save(stage)).points(1)
    # y points up, so the 200 units of y become 2 m of height, and z comes towards the viewer: -y.
    assert np.allclose(np.abs(points).max(axis=0), [1, 3, 2])
    assert np.allclose(points[1], [-1, -3, -2])


def test_moving_parents_move_the_points(save):
    stage = new_stage()
    add_cube(stage)
    move = UsdGeom.Xformable(stage.GetPrimAtPath("/toy")).AddTranslateOp()
    move.Set(Gf.Vec3d(0, 0, 0), 1)
    move.Set(Gf.Vec3d(0, 0, 9), 10)
    scene = read_stage(save(stage))
    assert np.allclose(scene.points(10)[0] - scene.points(1)[0], [0, 0, 9])


def test_points_follow_their_time_samples(save):
    stage = new_stage()
    mesh = add_cube(stage)
    for time in (1, 2):
        mesh.GetPointsAttr().Set(Vt.Vec3fArray.FromNumpy(CUBE * np.float32(time)), time)
    assert np.allclose(read_stage(save(stage)).points(2)[0], 2 * CUBE)


def test_guides_proxies_and_hidden_meshes_are_not_drawn(save):
    stage = new_stage()
    add_cube(stage)
    for name, purpose in (("guide", "guide"), ("proxy", "proxy")):
        add_cube(stage, f"/toy/{name}").CreatePurposeAttr(purpose)
    add_cube(stage, "/toy/hidden").MakeInvisible()
    assert [mesh.path for mesh in read_stage(save(stage)).meshes] == ["/toy/cube"]


def test_a_left_handed_mesh_is_turned_outside_out(save):
    stage = new_stage()
    add_cube(stage).CreateOrientationAttr("leftHanded")
    (mesh,) = read_stage(save(stage)).meshes
    assert mesh.corners.reshape(-1, 4).tolist() == QUADS[:, ::-1].tolist()


@pytest.mark.parametrize(
    ("interpolation", "count"), [("constant", 1), ("uniform", 6), ("vertex", 8), ("faceVarying", 24)]
)
def test_display_colors_of_every_interpolation_reach_the_faces(save, interpolation, count):
    stage = new_stage()
    primvar = add_cube(stage).CreateDisplayColorPrimvar(interpolation)
    primvar.Set([Gf.Vec3f(0.25, 0.5, 0.75)] * count)
    (mesh,) = read_stage(save(stage)).meshes
    assert np.allclose(mesh.colors, np.tile([0.25, 0.5, 0.75], (6, 1)))


def test_a_bound_material_is_stronger_than_the_display_color_and_a_subset_stronger_still(save):
    stage = new_stage()
    cube = add_cube(stage)
    cube.CreateDisplayColorAttr([Gf.Vec3f(1, 1, 1)])
    paint(stage, cube.GetPrim(), "red", (1, 0, 0))
    subset = UsdShade.MaterialBindingAPI(cube).CreateMaterialBindSubset("lid", Vt.IntArray([2, 5]))
    paint(stage, subset.GetPrim(), "green", (0, 1, 0))
    (mesh,) = read_stage(save(stage)).meshes
    assert mesh.colors[[0, 2, 5]].tolist() == [[1, 0, 0], [0, 1, 0], [0, 1, 0]]


def test_a_mesh_without_a_colour_gets_one(save):
    stage = new_stage()
    add_cube(stage)
    assert read_stage(save(stage)).meshes[0].colors.shape == (6, 3)


def test_the_title_is_the_documentation_or_else_the_root(save):
    stage = new_stage()
    add_cube(stage)
    assert read_stage(save(stage)).title == "toy"
    stage.GetRootLayer().documentation = "Toy cube\nmore"
    assert read_stage(save(stage)).title == "Toy cube"


def test_what_is_no_stage_is_refused_in_one_line(tmp_path, save):
    text = tmp_path / "text.usda"
    text.write_text("hello")
    for path, words in (
        (tmp_path / "none.usd", "is not a file"),
        (tmp_path, "is not a file"),
        (text, "is not a USD file"),
        (save(new_stage()), "shows no mesh"),
    ):
        with pytest.raises(PreviewError, match=words) as caught:
            read_stage(path)
        assert "\n" not in str(caught.value)


def test_faces_that_name_missing_points_are_refused(save):
    stage = new_stage()
    add_cube(stage, points=CUBE[:7])
    with pytest.raises(PreviewError, match="/toy/cube has too few points"):
        read_stage(save(stage)).points(1)


def test_particles_are_read_in_metres_with_z_up(save):
    stage = new_stage("Y", 0.01)
    add_cube(stage)
    add_points(stage, colors=((1, 0, 0), (0, 0, 1)))
    particles = read_stage(save(stage)).particles(1)
    assert np.allclose(particles.centres, [[0, 0, 0], [0.01, -0.03, 0.02]])
    assert np.allclose(particles.radii, 0.0025)
    assert particles.colors.tolist() == [[1, 0, 0], [0, 0, 1]]


def test_particles_grow_with_what_they_stand_in(save):
    stage = new_stage()
    add_cube(stage)
    add_points(stage, widths=(0.5, 1.0))
    UsdGeom.Xformable(stage.GetPrimAtPath("/toy")).AddScaleOp().Set(Gf.Vec3f(3, 3, 3))
    particles = read_stage(save(stage)).particles(1)
    assert np.allclose(particles.centres[1], [3, 6, 9])
    assert np.allclose(particles.radii, [0.75, 1.5])


def test_particles_follow_their_time_samples_and_may_come_and_go(save):
    stage = new_stage()
    add_cube(stage)
    cloud = add_points(stage)
    cloud.GetPointsAttr().Set([], 1)
    cloud.GetPointsAttr().Set([Gf.Vec3f(4, 0, 0)], 2)
    scene = read_stage(save(stage))
    assert len(scene.particles(1).radii) == 0
    assert scene.particles(2).centres.tolist() == [[4, 0, 0]]


def test_particles_without_widths_and_colours_get_some(save):
    stage = new_stage()
    add_cube(stage)
    add_points(stage, widths=())
    particles = read_stage(save(stage)).particles(1)
    assert (particles.radii > 0).all()
    assert particles.radii.max() < 0.1
    assert particles.colors.shape == (2, 3)


def test_hidden_particles_are_not_drawn(save):
    stage = new_stage()
    add_cube(stage)
    add_points(stage).MakeInvisible()
    add_points(stage, "/toy/hint").CreatePurposeAttr("guide")
    scene = read_stage(save(stage))
    assert scene.clouds == ()
    assert len(scene.particles(1).radii) == 0


def test_a_stage_is_read_in_its_own_look_or_the_one_asked_for(springs):
    own, latex = read_stage(springs), read_stage(springs, "recipe")
    assert (own.look, len(own.clouds), len(own.particles(3).radii)) == ("thesis", 1, 108)
    assert (latex.look, latex.clouds) == ("recipe", ())
    assert [mesh.wire for mesh in (*own.meshes, *latex.meshes)] == [True, False]
    assert np.allclose(own.meshes[0].colors[0], [0.871, 0.216, 0.005])
    assert np.allclose(latex.meshes[0].colors[0], [0.8, 0.05, 0.08])
    assert read_stage(springs).look == "thesis"


def test_a_look_that_is_not_there_is_refused_with_those_that_are(springs, save):
    with pytest.raises(
        PreviewError, match=r'has no look "wood", only chrome, clay, clear, print, recipe, stress, thesis$'
    ):
        read_stage(springs, "wood")
    with pytest.raises(PreviewError, match=r'has no look "Crome", did you mean "chrome"\?$'):
        read_stage(springs, "Crome")
    stage = new_stage()
    add_cube(stage)
    assert read_stage(save(stage)).look == ""
    with pytest.raises(PreviewError, match=r'toy.usda has no look "latex", nor any other$'):
        read_stage(save(stage), "latex")


def rate(value):
    return lambda stage, _: stage.SetTimeCodesPerSecond(value)


def counts(*values):
    return lambda _, cube: cube.GetFaceVertexCountsAttr().Set(list(values))


def corners(*values):
    return lambda _, cube: cube.GetFaceVertexIndicesAttr().Set([*QUADS.ravel().tolist()[:20], *values])


def colors(interpolation, count):
    return lambda _, cube: cube.CreateDisplayColorPrimvar(interpolation).Set([Gf.Vec3f(1, 0, 0)] * count)


def subset_of(*faces):
    def bind(stage, cube):
        subset = UsdShade.MaterialBindingAPI.Apply(cube.GetPrim()).CreateMaterialBindSubset(
            "lid", list(faces)
        )
        paint(stage, subset.GetPrim(), "green", (0, 1, 0))

    return bind


@pytest.mark.parametrize(
    ("spoil", "words"),
    [
        (rate(0), "toy.usda has 0 time codes per second"),
        (rate(-24), "toy.usda has -24 time codes per second"),
        (rate(float("nan")), "toy.usda has nan time codes per second"),
        (lambda stage, _: stage.SetEndTimeCode(float("inf")), "toy.usda has the time codes 0 to inf"),
        (counts(4, 4, 4, 4, 4, -4), "/toy/cube has a face with -4 corners"),
        (counts(4, 4, 4, 4, 4, 2, 2), "/toy/cube has a face with 2 corners"),
        (counts(4, 4), "/toy/cube has 24 corners but its faces need 8"),
        (corners(1, 1, 1, 1), "/toy/cube has a face with fewer than 3 different corners, number 5"),
        (corners(1, 3, 1, 3), "/toy/cube has a face with fewer than 3 different corners, number 5"),
        (corners(1, 3, -1, 2), "/toy/cube has a face with vertex -1"),
        (colors("vertex", 5), "/toy/cube has 5 colours, but needs 8"),
        (colors("uniform", 5), "/toy/cube has 5 colours, but needs 6"),
        (colors("faceVarying", 23), "/toy/cube has 23 colours, but needs 24"),
        (subset_of(0, 6), "/toy/cube/lid names faces that its mesh has not"),
    ],
)
def test_a_stage_that_is_not_right_is_refused_in_one_line(spoil, words, save):
    stage = new_stage()
    spoil(stage, add_cube(stage))
    with pytest.raises(PreviewError) as caught:
        read_stage(save(stage))
    assert str(caught.value).endswith(words)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"widths": (1.0, 1.0, 1.0)}, "/toy/air has 3 widths for 2 points at time code 1"),
        ({"colors": ((1, 0, 0),) * 3}, "/toy/air has 3 colours for 2 points at time code 1"),
    ],
)
def test_particles_that_are_not_right_are_refused_in_one_line(given, words, save):
    stage = new_stage()
    add_cube(stage)
    add_points(stage, **given)
    with pytest.raises(PreviewError, match=words):
        read_stage(save(stage)).particles(1)


def test_an_end_before_the_start_is_no_trouble(save):
    stage = new_stage()
    add_cube(stage)
    stage.SetStartTimeCode(5)
    assert (read_stage(save(stage)).start, read_stage(save(stage)).end) == (5, 5)


@pytest.mark.parametrize(
    ("lost", "told", "look"),
    [
        ("payload/draft.usda", "for payload", None),
        ("payload/draft.usda", "for payload", "stress"),
        ("payload/draft_sim.usdc", "sublayer", None),
        ("payload/draft_stress.usdc", "for reference", "stress"),
    ],
)
def test_a_stage_that_lacks_a_file_is_refused_in_one_line(lost, told, look, springs, tmp_path, capfd):
    shutil.copytree(springs.parent, tmp_path / "capsule")
    (tmp_path / "capsule" / lost).unlink()
    with pytest.raises(PreviewError) as caught:
        read_stage(tmp_path / "capsule" / "capsule.usda", look)
    (line,) = str(caught.value).splitlines()
    assert line.startswith(f"{tmp_path / 'capsule' / 'capsule.usda'} is not whole: Could not ")
    assert lost in line
    assert told in line
    assert capfd.readouterr().err == ""


def test_of_a_shot_only_the_sculpture_is_drawn(tmp_path):
    write_stage(sculpture(), frames(3), tmp_path, shot=True)
    scene = read_stage(tmp_path / "dog_shot.usda")
    assert [mesh.path.rpartition("/")[2] for mesh in scene.meshes] == ["main", "second"]
    assert (scene.start, scene.end, scene.fps) == (1, 3, 24)
