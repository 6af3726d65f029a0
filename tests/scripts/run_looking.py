#!/usr/bin/env python3
"""Runs two small scenes, one of them plane, and looks at them as a user does: pictures, animations, curves, the report in a browser.

    run_looking.py TITIN [FOLDER]      FOLDER keeps what is made, to be looked at

Skipped (exit 77) where the Python environment of the drawing scripts is not installed; the browser's part where there is no chromium.
"""
import base64
import contextlib
import html.parser
import io
import json
import os
import pathlib
import re
import runpy
import shutil
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from python_environment_there import SCRIPTS, skip_without_environment  # noqa: E402

skip_without_environment(enter=True)
sys.path.insert(0, str(SCRIPTS))
import imageio_ffmpeg  # noqa: E402
import numpy as np  # noqa: E402
from PIL import Image, ImageSequence  # noqa: E402

CONFIGS = SCRIPTS.parent / "configs"
TITLE = "Block <b>&amp;"  # must come out as it went in
BLOCK = [CONFIGS / "muscle" / "block.toml", "mesh.cells=[2, 1, 1]", 'averages.slab.lower="0, 0, 0 mm"', "time.end=0.2 s",
         "output.every=2", f'title="{TITLE}"', 'petsc.no_such_option="1"']  # fmt: skip
PLANE = [CONFIGS / "lagrange" / "sod.toml", "mesh.cells=[16, 2]", "output.every=20"]
# As root and without a network: chromium's own wishes are turned off, so that what is asked for is the page's.
BROWSER = ["--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run", "--disable-background-networking",
           "--disable-component-update", "--disable-sync", "--hide-scrollbars"]  # fmt: skip


class Looks:
    def __init__(self, titin, folder):
        self.titin, self.folder, self.wrong, self.checks = titin, folder, [], 0

    def check(self, is_right, what, shown=""):
        self.checks += 1
        if not is_right:
            self.wrong.append(f"{what}: {shown}")

    def run(self, name, words):
        folder = self.folder / name
        found = subprocess.run([self.titin, "run", *words, "-o", folder], capture_output=True, text=True, stdin=subprocess.DEVNULL)
        self.check(found.returncode == 0, f"{name} runs", found.stdout + found.stderr)
        return folder

    def script(self, name, *words):
        """What a script prints, and the sentence with which it gives up ("" if it does not)."""
        said, argv = io.StringIO(), sys.argv
        sys.argv, sentence = [str(SCRIPTS / name), *map(str, words)], ""
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            try:
                runpy.run_path(sys.argv[0], run_name="__main__")
            except SystemExit as end:
                sentence = str(end.code) if isinstance(end.code, str) else "" if not end.code else said.getvalue().strip().splitlines()[-1]
        sys.argv = argv
        return said.getvalue(), sentence


def pixels(path):
    return np.asarray(Image.open(path).convert("RGB")).astype(int)


def colours(image):
    return len(np.unique(image.reshape(-1, 3), axis=0))


def pictures(looks, run):
    one, rest = looks.folder / "one.png", looks.folder / "rest.png"
    said, sentence = looks.script("view.py", run, "-o", one, "--size", 480, 360, "--field", "pressure")
    looks.check(sentence == "" and "pressure" in said, "view draws a picture", said + sentence)
    image = pixels(one)
    looks.check(image.shape == (360, 480, 3) and colours(image) > 500, "in its size, in many colours", f"{image.shape} {colours(image)}")
    looks.check(0.05 < np.mean(np.any(image < 250, axis=2)) < 0.95, "of a body before a white ground")
    looks.script("view.py", run, "-o", rest, "--size", 480, 360, "--field", "pressure", "--warp", 0)
    moved = np.mean(np.any(np.abs(pixels(rest) - image) > 40, axis=2))
    looks.check(moved > 0.02, "deformed is not at rest", moved)
    said, _ = looks.script("view.py", run, "--list")
    looks.check("5 times from 0 to 0.2 s" in said and "fibre stretch" in said, "view lists fields and times", said)


def animations(looks, run):
    gif, mp4 = looks.folder / "block.gif", looks.folder / "block.mp4"
    looks.script("view.py", run, "-o", gif, "--size", 240, 180)
    frames = [np.asarray(frame.convert("RGB")).astype(int) for frame in ImageSequence.Iterator(Image.open(gif))]
    looks.check(len(frames) == 5, "a frame for each saved time", len(frames))
    changes = [np.mean(np.any(np.abs(a - b) > 40, axis=2)) for a, b in zip(frames, frames[1:])]
    looks.check(min(changes) > 1e-3, "in which something moves", changes)
    looks.script("view.py", run, "-o", mp4, "--size", 240, 180, "--field", "displacement", "--component", "x", "--fps", 5)
    facts, *film = imageio_ffmpeg.read_frames(str(mp4))
    looks.check(len(film) == 5 and facts["size"] == (240, 180) and facts["codec"] == "h264", "a film that plays", facts)


def refusals(looks, run):
    empty = looks.folder / "empty"
    empty.mkdir()
    cases = [
        ("view.py", [looks.folder / "nowhere"], "is no folder; give that of a run, such as results/block"),
        ("view.py", [empty], "holds no saved fields; did the scene say output.fields = false?"),
        ("view.py", [run, "--field", "temperature"], "view: there is no field 'temperature'; there are "),
        ("view.py", [run, "-o", "a.jpeg"], "view: a.jpeg: pictures are .png, animations .gif or .mp4"),
        ("view.py", [run, "--from", 0, 0, 0], "--from 0 0 0 is no direction"),
        ("view.py", [run, "--range", 2, 1], "--range: the least must be below the most"),
        ("report.py", [empty], "holds no run.json; is it the folder of a run?"),
        ("plot_compare.py", [run, run], "plot: two runs have the same label; is a folder named twice?"),
        ("plot_compare.py", [run, run, "--labels", "a"], "1 labels for 2 runs"),
        ("plot_compare.py", [run, empty, "--labels", "a", "b"], "history.csv is not there"),
    ]
    for name, words, answer in cases:
        _, sentence = looks.script(name, *words)
        looks.check(answer in sentence, f"{name} {' '.join(map(str, words))}", sentence)


def curves(looks, run):
    stiff = looks.run("stiff", [*BLOCK, "materials.muscle.terms.base.c1=80 kPa"])
    picture = looks.folder / "compared.png"
    said, sentence = looks.script("plot_compare.py", run, stiff, "-o", picture, "--labels", "soft", "stiff", "--dpi", 60)
    looks.check(sentence == "" and "reaction_" in said, "plot compares runs", said + sentence)
    found = re.search(r"reaction_x\S* \[N\]: stiff differs from soft by (\S+) of", said)
    looks.check(found is not None and float(found[1]) > 0.05, "and says how far they differ", said)
    looks.check(colours(pixels(picture)) > 50, "with curves in it")
    alone = looks.folder / "plot.png"
    looks.script("plot_run.py", run, "-o", alone, "--dpi", 60)
    looks.check(colours(pixels(alone)) > 500, "plot draws one run")


class Page(html.parser.HTMLParser):
    """The text of a page, and all that it refers to."""

    def __init__(self, text):
        super().__init__()
        self.references, self.policy, self.words = [], "", []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.references += [value for name, value in attributes.items() if name.split(":")[-1] in ("src", "href", "srcset", "data", "action")]
        if tag == "script" or any(name.startswith("on") for name in attributes):
            self.references.append(f"<{tag}> that runs")
        if attributes.get("http-equiv", "").lower() == "content-security-policy":
            self.policy = attributes["content"]

    def handle_data(self, data):
        self.words.append(data)


def report(looks, run):
    path = looks.folder / "report.html"
    said, sentence = looks.script("report.py", run, "-o", path)
    looks.check(sentence == "" and path.exists(), "report is written", said + sentence)
    page = Page(path.read_text())
    outside = [r for r in page.references if not r.startswith(("data:image/png;base64,", "#"))]
    looks.check(not outside, "it refers to nothing outside", outside)
    looks.check(page.policy.startswith("default-src 'none'"), "and forbids the browser to ask", page.policy)
    words = " ".join(page.words)
    summary = json.loads((run / "run.json").read_text())
    scene = (run / "resolved.toml").read_text()
    for wanted in (TITLE, "finished", "no_such_option", "Newton iterations", *summary["timers"], *summary["conservation"]):
        looks.check(wanted in words, f"the report tells {wanted}")
    looks.check(scene in words, "the scene is in it, letter for letter")
    picture = next(r for r in page.references if r.startswith("data:"))
    image = np.asarray(Image.open(io.BytesIO(base64.b64decode(picture.partition(",")[2]))).convert("RGB"))
    looks.check(colours(image) > 500, "and a picture of the body", colours(image))
    return path


def asked_for(chromium, page, folder, screenshot):
    """Addresses that the browser asks for on behalf of the page; its own wishes have "not an origin"."""
    log = folder / f"{page.stem}.netlog.json"
    with tempfile.TemporaryDirectory() as profile:
        command = [chromium, *BROWSER, f"--user-data-dir={profile}", f"--log-net-log={log}", f"--screenshot={screenshot}",
                   "--window-size=1200,3200", "--timeout=20000", page.as_uri()]  # fmt: skip
        subprocess.run(command, capture_output=True, timeout=300, stdin=subprocess.DEVNULL)
    text = log.read_text().rstrip()
    try:
        events = json.loads(text)["events"]
    except ValueError:  # ended before the end of the list
        events = json.loads(text.rstrip(",") + "]}")["events"]
    requests = [event["params"] for event in events if isinstance(event.get("params"), dict) and "initiator" in event["params"]]
    return {r["url"] for r in requests if r["initiator"] != "not an origin" and re.match(r"(https?|wss?|ftp):", r.get("url", ""))}


def in_the_browser(looks, path):
    chromium = os.environ.get("CHROMIUM") or shutil.which("chromium") or shutil.which("chromium-browser")
    if not chromium:
        return print("no chromium here: the report was not opened")
    shot = looks.folder / "report.png"
    asked = asked_for(chromium, path, looks.folder, shot)
    looks.check(asked == set(), "the browser asks nobody", asked)
    image = pixels(shot)
    rows = [colours(image[k : k + 400]) for k in range(0, 1600, 400)]
    looks.check(min(rows) > 100, "and shows text and pictures from top to bottom", rows)
    # That this would be seen: the same page with a picture from elsewhere, and allowed to ask.
    leak = looks.folder / "leak.html"
    text = re.sub(r"<meta http-equiv[^>]*>", "", path.read_text())
    leak.write_text(text.replace("<main>", "<main><img src='http://127.0.0.1:9/elsewhere.png'>"))
    asked = asked_for(chromium, leak, looks.folder, looks.folder / "leak.png")
    looks.check(any("elsewhere" in address for address in asked), "a request would have been seen", asked)


def plane(looks):
    run = looks.run("sod", PLANE)
    picture = looks.folder / "sod.png"
    said, sentence = looks.script("view.py", run, "-o", picture, "--size", 480, 360)
    image = pixels(picture)
    looks.check(sentence == "" and colours(image) > 100, "a plane body is drawn", said + sentence)


def other_formats(looks, run):
    """The same picture and report from VTKHDF files as from VTU files."""
    seen = looks.folder / "seen.png"
    words = ["--size", 240, 180, "--field", "pressure"]
    looks.script("view.py", run, "-o", seen, *words)
    listed, _ = looks.script("view.py", run, "--list")
    for name in "vtkhdf", "vtkhdf_transient":
        other = looks.run(name, [*BLOCK, f"output.format={name}"])
        picture = looks.folder / f"{name}.png"
        said, sentence = looks.script("view.py", other, "-o", picture, *words)
        differs = np.mean(np.any(np.abs(pixels(picture) - pixels(seen)) > 8, axis=2)) if picture.exists() else 1
        looks.check(sentence == "" and differs < 1e-3, f"view draws {name} as it draws VTU", f"{differs} {said}{sentence}")
        fields, _ = looks.script("view.py", other, "--list")
        looks.check(fields.splitlines()[1:] == listed.splitlines()[1:], "and lists its fields and times", fields + listed)
    page = looks.folder / "hdf.html"
    said, sentence = looks.script("report.py", other, "-o", page)
    looks.check(sentence == "" and "data:image/png" in page.read_text(), "a report of a VTKHDF run has pictures", said + sentence)


def main():
    titin = str(pathlib.Path(sys.argv[1]).absolute())
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(sys.argv[2] if len(sys.argv) > 2 else scratch).absolute()
        folder.mkdir(parents=True, exist_ok=True)
        looks = Looks(titin, folder)
        run = looks.run("block", BLOCK)
        for part in (pictures, animations, refusals, curves):
            part(looks, run)
        other_formats(looks, run)
        plane(looks)
        in_the_browser(looks, report(looks, run))
    print("\n".join(looks.wrong) or f"{looks.checks} checks passed")
    return 1 if looks.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
