"""Maps: regions, surfaces, pictures."""

import pickle
from pathlib import Path

import numpy as np
import pytest

import aspecta


def test_maps_locate_and_pickle(analysis: aspecta.Analysis, tmp_path: Path) -> None:
    found = analysis.domains([1, 3], cells=60, samples=2000)
    assert found.aspects == [1, 3] and found.robot == "five-bar"
    path = tmp_path / "five-bar.aspecta"
    found.save(path)
    for each in (found, aspecta.Map.load(path), pickle.loads(pickle.dumps(found))):
        here, nowhere = each.locate([[4, 7], [40, 7]], "++")
        assert (here.aspect, here.region, here.domains) == (1, 1, (1,)) and nowhere.nowhere == "leg 1 does not reach"
        assert each.locate([4, 7], "++") == here
    assert "uniqueness" in found.domains(1).to_dict() and "Basic regions" in str(found.domains(1))
    assert found.locate([4, 7], "left,left") == found.locate([4, 7], "++")
    for pose, mode in (([4, 7], "+++"), ([4, 7, 1], "++")):
        with pytest.raises(aspecta.Error):
            found.locate(pose, mode)
    for wrong in ({"cells": 1}, {"cells": -1}, {"samples": -1}):
        with pytest.raises(aspecta.Error, match="give a whole number"):
            analysis.domains(1, **wrong)
    with pytest.raises(aspecta.Error, match="masked"):
        found.locate(np.ma.array([4, 7], mask=[0, 1]), "++")
    with pytest.raises(KeyError):
        found.domains(2)
    with pytest.raises(aspecta.Error, match="no aspect 11"):
        analysis.domains(11)
    (tmp_path / "none.aspecta").write_bytes(b"none")
    with pytest.raises(aspecta.Error):
        aspecta.Map.load(tmp_path / "none.aspecta")


@pytest.fixture(scope="module")
def surfaces() -> aspecta.Domains:
    """The first aspect of a robot with three coordinates, coarsely."""
    analysis = aspecta.Robot("3-rpr").analyze(depth=5)
    return analysis.domains(1, cells=20, samples=100, surfaces=True).domains(1)


def test_surfaces_are_where_they_say(surfaces: aspecta.Domains) -> None:
    robot = aspecta.Robot("3-rpr")
    boundary, characteristic = surfaces.surfaces
    assert (boundary.name, characteristic.name) == ("boundary", "characteristic") and "det A = 0" in boundary.faces
    for surface in (boundary, characteristic):
        assert surface.simplices.max() < len(surface.vertices) == len(surface.q) and len(surface.face) == len(
            surface.simplices
        )
        for k in range(0, len(surface.vertices), 500):
            assert np.allclose(robot.ik(surface.vertices[k])[0].q, surface.q[k])
    assert boundary.source is None and characteristic.source is not None
    # Definition 9: a pose of the characteristic surface shares its joint vector with one of the boundary.
    for k in range(0, len(characteristic.vertices), 500):
        assert np.allclose(robot.ik(characteristic.source[k])[0].q, characteristic.q[k], atol=1e-6)
    singular = boundary.simplices[boundary.face == boundary.faces.index("det A = 0")]
    state = robot.state(boundary.vertices[singular[0, 0]], boundary.q[singular[0, 0]])
    assert isinstance(state, aspecta.State) and state.parallel_measure < 1e-6


def test_a_surface_is_a_mesh(surfaces: aspecta.Domains) -> None:
    boundary, _ = surfaces.surfaces
    mesh = boundary.to_trimesh()
    assert mesh.faces.shape == boundary.simplices.shape and np.array_equal(mesh.vertex_attributes["q"], boundary.q)


def test_a_grid_says_what_locate_says(analysis: aspecta.Analysis) -> None:
    found = analysis.domains(1, cells=60, samples=100)
    grid = found.domains(1).grid
    assert grid.coordinates == ["x", "y"] and grid.labels.shape == tuple(len(edge) - 1 for edge in grid.edges)
    middles = [0.5 * (edge[1:] + edge[:-1]) for edge in grid.edges]
    i, j = np.argwhere(grid.labels == 1)[0]
    pose = [middles[0][i], middles[1][j]]
    assert found.locate(pose, "++").aspect == 1
    area = (grid.labels != 0).sum() * np.prod([edge[1] - edge[0] for edge in grid.edges])
    assert np.isclose(area, found.domains(1).measure)


def test_curves_of_two_coordinates_come_by_themselves(analysis: aspecta.Analysis, tmp_path: Path) -> None:
    found = analysis.domains(1, cells=60, samples=100)
    boundary, _ = found.domains(1).surfaces
    assert boundary.simplices.shape[1] == 2
    with pytest.raises(aspecta.Error, match="curve"):
        boundary.to_trimesh()
    written = found.draw(tmp_path / "pictures")
    assert {path.name for path in written} >= {"aspect-1-regions.svg", "aspect-1-sheets.svg"}
    assert "<svg" in found._repr_html_() and "<svg" in found.domains(1)._repr_html_()
    for wrong in ({"hold": 4}, {"meshes": ["stl"]}):
        with pytest.raises(aspecta.Error):
            found.draw(tmp_path, **wrong)  # type: ignore[arg-type]


def test_surfaces_that_were_not_asked_for_are_missed(analysis: aspecta.Analysis, tmp_path: Path) -> None:
    bare = analysis.domains(1, cells=30, samples=100, surfaces=False)
    with pytest.raises(aspecta.Error, match="surfaces=True"):
        _ = bare.domains(1).surfaces
    with pytest.raises(aspecta.Error, match="surfaces=True"):
        bare.draw(tmp_path / "none")
    assert not (tmp_path / "none").exists()
    alone = pickle.loads(pickle.dumps(bare.domains(1)))
    assert alone == bare.domains(1)
    with pytest.raises(aspecta.Error, match="pickle their map"):
        _ = alone.grid


def test_regions_are_drawn(analysis: aspecta.Analysis, surfaces: aspecta.Domains) -> None:
    ax = analysis.domains(1, cells=60, samples=100).domains(1).plot(domain=1)
    assert ax.get_xlabel() == "x [unit]" and len(ax.images) == 1 and len(ax.collections) == 2
    cut = surfaces.plot(at={"phi": 0.1})
    assert cut.get_ylabel() == "y [unit]"
    assert "other regions, or too thin to tell" in cut.get_legend_handles_labels()[1]
    for wrong in ({}, {"at": {"phi": 99.0}}, {"at": {"z": 0.0}}, {"at": {"phi": 0.1}, "domain": 1000}):
        with pytest.raises(aspecta.Error):
            surfaces.plot(**wrong)  # type: ignore[arg-type]
    with pytest.raises(aspecta.Error, match="1 coordinate left to vary"):
        surfaces.plot(at={"phi": 0.1, "x": 0.0})


def test_aspects_are_named_by_themselves_or_by_number(analysis: aspecta.Analysis, tmp_path: Path) -> None:
    first, third = (a for a in analysis.aspects if a.id in (1, 3))
    found = analysis.domains([first, np.int64(3)], cells=20, samples=0)
    assert found.aspects == [1, 3] == analysis.domains(np.array([1, 3]), cells=20, samples=0).aspects
    assert found.domains(third) == found.domains(np.int32(3)) == found.domains(3)  # type: ignore[arg-type]
    assert found.draw(tmp_path, first, meshes=[]) == found.draw(tmp_path, np.int8(1), meshes=[])  # type: ignore[arg-type]
    for wrong in ({"aspects": 1.5}, {"aspects": 1, "mode": "--"}, {"aspects": 1, "samples": 10**9}):
        with pytest.raises(aspecta.Error, match=r"aspect|samples"):
            analysis.domains(**wrong)  # type: ignore[arg-type]


def test_errors_of_files_name_them(analysis: aspecta.Analysis, tmp_path: Path) -> None:
    found, certificate = analysis.domains(1, cells=20, samples=0), aspecta.Certificate("{}")
    missing, directory = tmp_path / "missing" / "file", tmp_path / "directory"
    directory.mkdir()
    for write in (found.save, certificate.save, aspecta.Map.load):
        for path in (missing, directory):
            with pytest.raises(aspecta.Error, match=f"`{path}`: "):
                write(path)
    assert not missing.parent.exists()
    (tmp_path / "file").write_text("")
    with pytest.raises(aspecta.Error, match="file`: "):
        found.draw(tmp_path / "file")
