"""Draws a body: its deformed surface coloured by a field, the edges of its cells, its outline at rest."""
import numpy as np
import pyvista as pv
from plot_style import COLOUR_MAP, INK

AT_REST = "#8a93a3"


def is_plane(grid):
    low_x, high_x, low_y, high_y, low_z, high_z = grid.bounds
    return high_z - low_z < 1e-9 * max(high_x - low_x, high_y - low_y)


def displacement_of(grid):
    return next((name for name in grid.point_data if name.split(" [")[0] == "displacement"), None)


def warped(grid, warp):
    name = displacement_of(grid)
    return grid.warp_by_vector(name, factor=warp) if name else grid


def surface_of(grid, subdivision):
    return grid.extract_surface(nonlinear_subdivision=subdivision, algorithm="dataset_surface").triangulate()


def edges_of_cells(surface):
    """Lines on a tessellated surface where two cells, or two faces of one, meet."""
    triangles = surface.regular_faces
    owner = np.asarray(surface.cell_data["vtkOriginalCellIds"])
    normals = np.asarray(surface.compute_normals(cell_normals=True, point_normals=False, auto_orient_normals=False,
                                                 consistent_normals=False, split_vertices=False).cell_data["Normals"])  # fmt: skip
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    triangle = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort((sides[:, 1], sides[:, 0]))
    sides, triangle = sides[order], triangle[order]
    same = np.all(sides[:-1] == sides[1:], axis=1)
    twins = np.flatnonzero(same)
    a, b = triangle[twins], triangle[twins + 1]
    seen = (owner[a] != owner[b]) | (np.einsum("ij,ij->i", normals[a], normals[b]) < 0.7)
    alone = ~(np.append(same, False) | np.insert(same, 0, False))  # the rim of a plane body
    lines = np.concatenate([sides[twins[seen]], sides[alone]])
    return pv.PolyData(surface.points, lines=np.hstack([np.full((len(lines), 1), 2), lines]).ravel())


def add_body(plotter, grid, clim, warp, edges=True):
    """The grid has an array "shown" (saved_fields.show). Returns what turns its values into colours."""
    surface = surface_of(warped(grid, warp), 3).clean(tolerance=1e-8)
    if displacement_of(grid) and not is_plane(grid):
        outline = surface_of(grid, 2).extract_feature_edges(40, boundary_edges=False)
        if outline.n_points:
            plotter.add_mesh(outline, color=AT_REST, line_width=2)
    smooth = {"smooth_shading": True, "split_sharp_edges": True} if "shown" in surface.point_data else {}
    light = {"lighting": False} if is_plane(grid) else {"ambient": 0.55, "diffuse": 0.52, "specular": 0.06, "specular_power": 12}
    actor = plotter.add_mesh(surface, scalars="shown", cmap=COLOUR_MAP, clim=clim, show_scalar_bar=False, **smooth, **light)
    if edges:
        plotter.add_mesh(edges_of_cells(surface), color=INK, line_width=1.8, opacity=0.5)
    return actor.mapper


def new_plotter(size):
    plotter = pv.Plotter(off_screen=True, window_size=size)
    plotter.set_background("white")
    plotter.enable_anti_aliasing("ssaa")
    plotter.enable_parallel_projection()
    return plotter


def aim(plotter, plane, direction=None, bounds=None, zoom=1.25):
    if direction is not None:
        up = (0, 1, 0) if abs(direction[2]) > 0.99 * np.linalg.norm(direction) else (0, 0, 1)
        plotter.view_vector(direction, up)
    elif plane:
        plotter.view_xy()
    else:
        plotter.view_vector((-0.5, -1.0, 0.5), (0, 0, 1))
    plotter.reset_camera(bounds=bounds)
    plotter.camera.zoom(zoom)


def limits(least, largest):
    """Of the colours: never of no width."""
    if largest - least < 1e-9 * max(abs(least), abs(largest), 1e-30):
        return least - 0.5, largest + 0.5
    return least, largest


def render(grid, clim, warp, size=(1500, 1150)):
    """The body as an RGBA array without empty rims."""
    plotter = new_plotter(size)
    add_body(plotter, grid, clim, warp)
    aim(plotter, is_plane(grid))
    image = plotter.screenshot(return_img=True, transparent_background=True)
    plotter.close()
    rows, columns = np.nonzero(image[:, :, 3])
    return image[rows.min() : rows.max() + 1, columns.min() : columns.max() + 1]
