"""Draws the last time of two runs with ParaView and compares what it finds in them; scripts/paraview_picture starts it in pvpython.

    paraview_picture.py FOLDER PICTURE      FOLDER/vtu/fields/fields.pvd, FOLDER/vtkhdf/fields/fields.vtkhdf.series
"""
import os
import pathlib
import sys

from paraview import simple

FILES = {"vtu": "vtu/fields/fields.pvd", "vtkhdf": "vtkhdf/fields/fields.vtkhdf.series"}
SAME = 1e-12  # of the larger end of a range: both files hold doubles
SIZE = [760, 460]  # of one view


def ranges(source):
    """(points or cells, name, component) -> range of values."""
    found = {}
    for kind, data in ("points", source.PointData), ("cells", source.CellData):
        for array in data:
            for component in range(array.GetNumberOfComponents()):
                found[kind, array.GetName(), component] = array.GetRange(component)
    return found


def opened(path):
    # ParaView 5.11 reads VTKHDF, but does not find the reader by the name of the file.
    is_hdf = path.suffix == ".series"
    source = simple.VTKHDFReader(FileName=[str(path)]) if is_hdf else simple.OpenDataFile(str(path))
    source.UpdatePipelineInformation()
    times = list(source.TimestepValues)
    source.UpdatePipeline(times[-1])
    return source, times


def differences(one, other):
    for key in sorted(set(one) ^ set(other)):
        yield f"{key} is in one file only"
    for key in sorted(set(one) & set(other)):
        scale = max(abs(x) for x in one[key] + other[key]) or 1
        if any(abs(a - b) > SAME * scale for a, b in zip(one[key], other[key])):
            yield f"{key}: {one[key]} and {other[key]}"


def draw(source, time, title, layout, place):
    view = simple.CreateView("RenderView")
    layout.AssignView(place, view)
    view.Background = [1, 1, 1]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesVisibility = 0
    view.ViewTime = time
    warped = simple.WarpByVector(source)
    warped.Vectors = ["POINTS", "displacement"]
    shown = simple.Show(warped, view)
    shown.SetRepresentationType("Surface With Edges")
    shown.NonlinearSubdivisionLevel = 3
    simple.ColorBy(shown, ("POINTS", "displacement", "Magnitude"))
    shown.RescaleTransferFunctionToDataRange(False)
    bar = simple.GetScalarBar(simple.GetColorTransferFunction("displacement"), view)
    bar.Title, bar.ComponentTitle = "displacement [m]", ""
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.Visibility = 1
    text = simple.Show(simple.Text(Text=title), view)
    text.Color = [0, 0, 0]
    simple.ResetCamera(view)
    camera = view.GetActiveCamera()
    camera.Elevation(25)
    camera.Azimuth(-30)
    simple.ResetCamera(view)
    simple.Render(view)


def main():
    folder, picture = pathlib.Path(sys.argv[1]), sys.argv[2]
    layout = simple.CreateLayout("both")
    layout.SplitHorizontal(0, 0.5)
    found, times = {}, {}
    for place, (name, file) in enumerate(FILES.items(), 1):
        source, times[name] = opened(folder / file)
        found[name] = ranges(source)
        cells = source.GetDataInformation().GetNumberOfCells()
        print(f"{file}: {len(times[name])} times to {times[name][-1]:g} s, {cells} cells, {len(found[name])} components of arrays")
        version = simple.GetParaViewVersion()
        draw(source, times[name][-1], f"{name}, ParaView {version.major}.{version.minor}", layout, place)
    layout.SetSize(2 * SIZE[0], SIZE[1])
    simple.SaveScreenshot(picture, layout, ImageResolution=[2 * SIZE[0], SIZE[1]])
    wrong = list(differences(*found.values()))
    if len({tuple(t) for t in times.values()}) != 1:
        wrong.append(f"other times: {times}")
    if not any(name == "displacement" for _, name, _ in found["vtu"]):
        wrong.append("no displacement")
    print("\n".join(wrong) or "the same times, arrays and ranges in both")
    sys.stdout.flush()
    os._exit(1 if wrong else 0)  # without ParaView's own end, which stumbles over views that the server has dropped


main()
