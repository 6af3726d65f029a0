#!/usr/bin/env python3
"""Draws the body of a run, without a screen: one picture, or an animation of all saved times.

    scripts/view.py results/block                                  writes results/block/view.png: the last saved time
    scripts/view.py results/block --field pressure --time 0.3 -o pressure.png
    scripts/view.py results/block -o block.mp4 --fps 10            the motion; .gif too
    scripts/view.py results/block --list                           which fields and times there are

The first call puts PyVista and others (from PyPI) into a virtual environment in the cache; it takes about a minute.
"""
import argparse
import itertools
import pathlib
import sys

import environment

environment.enter()
import body  # noqa: E402
import imageio_ffmpeg  # noqa: E402
import numpy as np  # noqa: E402
from PIL import Image  # noqa: E402
from plot_style import INK, prefixed_unit  # noqa: E402
from saved_fields import SavedFields, choose_field, show, title_and_unit  # noqa: E402

COMPONENTS = {"x": 0, "y": 1, "z": 2}


def fail(message):
    sys.exit(f"view: {message}")


def parse_arguments():
    parser = argparse.ArgumentParser(prog="scripts/view.py", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=pathlib.Path, help="folder of a run, such as results/block")
    parser.add_argument("-o", "--output", type=pathlib.Path, help="what to write: .png, .gif or .mp4 (default: view.png in that folder)")
    parser.add_argument("--field", help="field that colours the body (default: the one most worth a picture)")
    parser.add_argument("--component", choices=COMPONENTS, help="of a vector, instead of its length")
    parser.add_argument("--time", type=float, help="of a picture: the saved time nearest to this one, in s (default: the last)")
    parser.add_argument("--range", nargs=2, type=float, metavar=("LEAST", "MOST"), help="of the colours, in SI (default: what there is)")
    parser.add_argument("--warp", type=float, default=1.0, help="displacements are drawn times this; 0: the body at rest (default: 1)")
    parser.add_argument("--from", dest="direction", nargs=3, type=float, metavar=("X", "Y", "Z"), help="where the eye is, seen from the body")
    parser.add_argument("--size", nargs=2, type=int, default=(1280, 960), metavar=("WIDTH", "HEIGHT"), help="in pixels")
    parser.add_argument("--fps", type=float, default=10.0, help="of an animation: saved times shown a second (default: 10)")
    parser.add_argument("--no-edges", action="store_true", help="leave out the edges of the cells")
    parser.add_argument("--list", action="store_true", help="say which fields and times there are, and draw nothing")
    options = parser.parse_args()
    if options.direction and not any(options.direction):
        parser.error("--from 0 0 0 is no direction")
    if options.range and not options.range[0] < options.range[1]:
        parser.error("--range: the least must be below the most")
    if not options.fps > 0 or min(options.size) < 16:
        parser.error("--fps must be positive, and --size at least 16 16")
    return options


def open_fields(folder):
    if not folder.is_dir():
        fail(f"{folder} is no folder; give that of a run, such as results/block")
    saved = SavedFields(folder)
    if not len(saved.times):
        fail(f"{folder} holds no saved fields; did the scene say output.fields = false?")
    return saved


def print_list(saved):
    grid = saved.read(0)
    fields = [f"{title_and_unit(name)[0]} ({name})" for name in sorted({*grid.point_data, *grid.cell_data})]
    print(f"{len(saved.times)} times from {saved.times[0]:g} to {saved.times[-1]:g} s; {grid.n_cells} cells")
    print("\n".join(fields))


class Frames:
    """Pictures of the body at saved times, alike in colours, camera and size."""

    def __init__(self, saved, numbers, options):
        self.saved, self.numbers, self.options = saved, numbers, options
        grid = saved.read(numbers[0])
        self.array = choose_field(grid, options.field)
        if self.array is None:
            fail(f"there is no field '{options.field}'; there are {', '.join(sorted({*grid.point_data, *grid.cell_data}))}")
        self.component = COMPONENTS.get(options.component)
        self.survey()

    def survey(self):
        """Range of the colours and box of the body over all the times."""
        lows, highs, boxes = [], [], []
        for k in self.numbers:
            grid = self.saved.read(k)
            values = show(grid, self.array, self.component)
            lows.append(float(np.min(values)))
            highs.append(float(np.max(values)))
            boxes += [body.warped(grid, self.options.warp).bounds, grid.bounds]
        low, high = self.options.range or (min(lows), max(highs))
        self.title, self.unit = title_and_unit(self.array)
        self.factor, self.unit = prefixed_unit([np.array([low, high])], self.unit)
        self.limits = body.limits(low * self.factor, high * self.factor)
        self.title += f" {self.options.component}" if self.options.component else ""
        self.title += f" [{self.unit}]" if self.unit else ""
        boxes = np.array(boxes)
        self.box = [*zip(boxes[:, ::2].min(axis=0), boxes[:, 1::2].max(axis=0))]

    def draw(self, k):
        grid = self.saved.read(k)
        show(grid, self.array, self.component, self.factor)
        plotter = body.new_plotter(tuple(self.options.size))
        mapper = body.add_body(plotter, grid, self.limits, self.options.warp, not self.options.no_edges)
        bounds = [value for pair in self.box for value in pair]
        body.aim(plotter, body.is_plane(grid), self.options.direction, bounds, zoom=1.1)
        self.add_legend(plotter, mapper, self.saved.times[k])
        image = plotter.screenshot(return_img=True)
        plotter.close()
        return np.ascontiguousarray(image[:, :, :3])

    def add_legend(self, plotter, mapper, time):
        height = self.options.size[1]
        plotter.add_scalar_bar(self.title, mapper=mapper, n_labels=4, fmt="%.3g", color=INK, width=0.5, height=0.06, position_x=0.25,
                               position_y=0.02, title_font_size=height // 50, label_font_size=height // 56, vertical=False)  # fmt: skip
        factor = "" if self.options.warp == 1 else f", displacements times {self.options.warp:g}"
        plotter.add_text(f"t = {time:.4g} s{factor}", position=(0.02, 0.95), viewport=True, font_size=max(6, height // 80), color=INK)


def write_gif(path, frames, fps):
    images = [Image.fromarray(frame).convert("P", palette=Image.Palette.ADAPTIVE) for frame in frames]
    images[0].save(path, save_all=True, append_images=images[1:], duration=1000 / fps, loop=0)


def write_mp4(path, frames, fps):
    first = next(frames)
    height, width = (n - n % 2 for n in first.shape[:2])  # as the pixel format wants
    writer = imageio_ffmpeg.write_frames(str(path), (width, height), fps=fps, codec="libx264", pix_fmt_out="yuv420p",
                                         quality=8, macro_block_size=2, ffmpeg_log_level="error")  # fmt: skip
    writer.send(None)
    for frame in itertools.chain([first], frames):
        writer.send(np.ascontiguousarray(frame[:height, :width]))
    writer.close()


def main():
    options = parse_arguments()
    saved = open_fields(options.folder)
    if options.list:
        return print_list(saved)
    output = options.output or options.folder / "view.png"
    kind = output.suffix.lower()
    if kind not in (".png", ".gif", ".mp4"):
        fail(f"{output}: pictures are .png, animations .gif or .mp4")
    numbers = [saved.nearest(options.time)] if kind == ".png" else range(len(saved.times))
    frames = Frames(saved, list(numbers), options)
    output.parent.mkdir(parents=True, exist_ok=True)
    pictures = (frames.draw(k) for k in numbers)
    if kind == ".png":
        Image.fromarray(next(pictures)).save(output)
    else:
        {".gif": write_gif, ".mp4": write_mp4}[kind](output, pictures, options.fps)
    print(f"[view] wrote {output}: {frames.title}, {len(numbers)} time{'s' * (len(numbers) > 1)}")


if __name__ == "__main__":
    main()
