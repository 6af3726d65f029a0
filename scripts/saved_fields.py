"""The fields that a run has saved, whatever the format: ParaView collections (.pvd), series of VTKHDF files, one transient file."""
import json
import os
import pathlib
import re
import subprocess
import sys


def draw_without_a_screen():
    """Without a screen VTK draws in software, through OSMesa (Debian: libosmesa6) or EGL."""
    if os.environ.get("DISPLAY") or "VTK_DEFAULT_OPENGL_WINDOW" in os.environ:
        return
    libraries = subprocess.run(["/sbin/ldconfig", "-p"], capture_output=True, text=True).stdout
    if "libOSMesa" in libraries:
        os.environ["VTK_DEFAULT_OPENGL_WINDOW"] = "vtkOSOpenGLRenderWindow"
    elif "libEGL" not in libraries:
        sys.exit("error: drawing without a screen needs libosmesa6 (or libegl1)")


draw_without_a_screen()
import numpy as np  # noqa: E402
import pyvista as pv  # noqa: E402
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline  # noqa: E402
from vtkmodules.vtkIOHDF import vtkHDFReader  # noqa: E402

# What a field is called in a picture; those worth one come first, best first.
TITLES = {
    "fibre_stretch": "fibre stretch", "pressure": "pressure", "displacement": "displacement", "velocity": "speed",
    "density": "density",
}  # fmt: skip
UNITS = {"pressure": "Pa", "displacement": "m", "velocity": "m/s", "fibre_rate": "1/s", "cauchy_stress": "Pa",
         "density": "kg/m^3", "internal_energy": "J/kg"}  # fmt: skip


class SavedFields:
    """Times, and the mesh with its fields at each of them. Empty (no times) where a run saved none."""

    def __init__(self, folder):
        self.times, self.read_raw = [], None
        for pattern, open_index in (("*.pvd", self._open_collection), ("*.series", self._open_series), ("*.vtkhdf", self._open_file)):
            found = sorted(pathlib.Path(folder).rglob(pattern))
            if found:
                open_index(found[0])
                break
        self.times = np.array(self.times)

    def _open_collection(self, path):
        reader = pv.PVDReader(str(path))
        self.times = reader.time_values

        def read(k):
            reader.set_active_time_value(self.times[k])
            return reader.read()

        self.read_raw = read

    def _open_series(self, path):
        files = json.loads(path.read_text())["files"]
        self.times = [file["time"] for file in files]
        self.read_raw = lambda k: pv.read(path.parent / files[k]["name"])

    def _open_file(self, path):
        reader = vtkHDFReader()  # PyVista's knows no times
        reader.SetFileName(str(path))
        reader.UpdateInformation()
        self.times = reader.GetOutputInformation(0).Get(vtkStreamingDemandDrivenPipeline.TIME_STEPS()) or (0.0,)

        def read(k):
            reader.UpdateTimeStep(self.times[k])
            return pv.wrap(reader.GetOutputDataObject(0)).copy()

        self.read_raw = read

    def nearest(self, time):
        """Number of the saved time nearest to this one (None: the last)."""
        return len(self.times) - 1 if time is None else int(np.argmin(np.abs(self.times - time)))

    def read(self, k):
        """One grid. Each cell is written with nodes of its own: they are merged, so that faces inside are known to be inside."""
        grid = self.read_raw(k)
        grid = grid.combine() if isinstance(grid, pv.MultiBlock) else grid
        return grid.clean(tolerance=1e-9)


def name_and_unit(array):
    """ "pressure [Pa]" or "pressure"."""
    found = re.fullmatch(r"(.+?) \[(.*)\]", array)
    return (found[1], found[2]) if found else (array, UNITS.get(array, ""))


def choose_field(grid, wanted=None):
    """The name of the array: the one that was asked for, or the one most worth a picture. None when it is not there."""
    names = {name_and_unit(array)[0]: array for data in (grid.cell_data, grid.point_data) for array in data}
    if wanted:
        return wanted if wanted in names.values() else names.get(wanted)
    return next((names[name] for name in TITLES if name in names), next(iter(names.values()), None))


def title_and_unit(array):
    name, unit = name_and_unit(array)
    return TITLES.get(name, name.replace("_", " ")), unit


def show(grid, array, component=None, factor=1.0):
    """Adds the array "shown": the field times the factor, of a vector its length or one component."""
    where = grid.point_data if array in grid.point_data else grid.cell_data
    values = np.asarray(where[array])
    if values.ndim > 1:
        values = np.linalg.norm(values, axis=1) if component is None else values[:, component]
    where["shown"] = values * factor
    return where["shown"]
