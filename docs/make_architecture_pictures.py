#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Draws the two pictures of docs/architecture.md: folders with their arrows, from the includes of the sources, and the
frame as stages with a thumbnail of each, from frames that the program renders.

Usage: docs/make_architecture_pictures.py [PROGRAM]    (after third_party/install.sh --tests)
"""

import base64
import collections
import html
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np
from skimage.io import imread, imsave

ROOT = pathlib.Path(__file__).resolve().parent.parent

# What each folder is for, in a line; the order of a row is that of this table.
FOLDERS = {
    "renderer/base": "errors, files, hashes, names",
    "renderer/image": "pictures, files, metrics",
    "renderer/scene": "glTF, procedural scenes, poses",
    "renderer/bvh": "the tree over all triangles",
    "renderer/gl": "contexts, programs, textures",
    "renderer/resources": "who owns pixels",
    "renderer/passes": "who owns programs",
    "renderer/filters": "a row of the table each",
    "renderer/pipeline": "the order of a frame",
    "app/base": "output, JSON, progress",
    "app/scenario": "what happens when",
    "app/measure": "ground truth, metrics, response",
    "app/bench": "times, rays, trees, memory",
    "app/report": "pages and sheets",
    "app/experiment": "runs",
    "app/workbench": "the window's state and actions",
    "app/ui": "panels (Dear ImGui)",
    "app/window": "input, frames (GLFW)",
    "app/commands": "the command line",
}
BOX_WIDTH, BOX_HEIGHT, GAP_X, GAP_Y, MARGIN = 236, 78, 30, 50, 40


def sources(folder):
    return sorted(p for p in (ROOT / folder).rglob("*") if p.suffix in {".h", ".cpp"})


def arrows():
    """Pairs (a, b): a file of folder a includes one of folder b."""
    pairs = collections.Counter()
    for folder in FOLDERS:
        for path in sources(folder):
            for other in re.findall(r'#include "((?:renderer|app)/\w+)/', path.read_text()):
                if other != folder and other in FOLDERS:
                    pairs[folder, other] += 1
    return pairs


def reaches(pairs, start, end):
    """Whether a way of two arrows or more leads from start to end."""
    todo, seen = [b for a, b in pairs if a == start and b != end], set()
    while todo:
        at = todo.pop()
        if at == end:
            return True
        if at not in seen:
            seen.add(at)
            todo += [b for a, b in pairs if a == at]
    return False


def rows_of(pairs, half):
    """The row of each folder of one half of the program: one above all of it that it knows."""
    rows = {}

    def row(folder, path=()):
        if folder in path:
            raise SystemExit(f"a circle of includes: {' -> '.join(path + (folder,))}")
        if folder not in rows:
            known = [b for a, b in pairs if a == folder and b.startswith(half)]
            rows[folder] = 1 + max((row(b, path + (folder,)) for b in known), default=-1)
        return rows[folder]

    for folder in FOLDERS:
        if folder.startswith(half):
            row(folder)
    return rows


def folders_picture():
    pairs = arrows()
    needed = [pair for pair in pairs if not reaches(pairs, *pair)]
    halves = [rows_of(pairs, "renderer"), rows_of(pairs, "app")]
    top = max(max(rows.values()) for rows in halves)
    half_width = 2 * BOX_WIDTH + GAP_X + 150
    width, height = 2 * half_width + 2 * MARGIN, (top + 1) * (BOX_HEIGHT + GAP_Y) - GAP_Y + 2 * MARGIN
    at = {}
    for number, rows in enumerate(halves):
        members = collections.defaultdict(list)
        for folder in FOLDERS:
            if folder in rows:
                members[rows[folder]].append(folder)
        for row, folders in members.items():
            left = MARGIN + number * half_width + (half_width - len(folders) * (BOX_WIDTH + GAP_X) + GAP_X) / 2
            for i, folder in enumerate(folders):
                at[folder] = (left + i * (BOX_WIDTH + GAP_X), MARGIN + (top - row) * (BOX_HEIGHT + GAP_Y))
    rows = halves[0] | halves[1]
    parts = []
    for a, b in sorted(needed):
        (ax, ay), (bx, by) = at[a], at[b]
        kind = a.split("/")[0]
        if not b.startswith(kind):  # from one half to the other
            x0, y0, x1, y1 = ax, ay + BOX_HEIGHT / 2, bx + BOX_WIDTH + 5, by + BOX_HEIGHT / 2
            middle = (x0 + x1) / 2
            curve = f"M{x0},{y0} C{middle},{y0} {middle},{y1} {x1},{y1}"
        else:
            x0, y0, x1, y1 = ax + BOX_WIDTH / 2, ay + BOX_HEIGHT, bx + BOX_WIDTH / 2, by - 5
            skipped = rows[a] - rows[b] - 1
            # An arrow over several rows goes around the boxes between.
            center = MARGIN + half_width * (0.5 if kind == "renderer" else 1.5)
            bend = (-1 if x0 + x1 < 2 * center else 1) * (BOX_WIDTH * 0.62 + 34 * skipped) if skipped else 0
            middle = (y0 + y1) / 2
            curve = (f"M{x0},{y0} C{x0 + bend},{y0 + 46} {x1 + bend},{y1 - 46} {x1},{y1}" if skipped else
                     f"M{x0},{y0} C{x0},{middle} {x1},{middle} {x1},{y1}")
        parts.append(f'<path class="arrow {kind}" d="{curve}" marker-end="url(#head-{kind})"/>')
    for folder, (x, y) in at.items():
        lines = sum(len(p.read_text().split("\n")) for p in sources(folder))
        kind = folder.split("/")[0]
        parts.append(
            f'<rect class="box {kind}" x="{x}" y="{y}" width="{BOX_WIDTH}" height="{BOX_HEIGHT}" rx="10"/>'
            f'<text class="name" x="{x + 16}" y="{y + 32}">{folder}</text>'
            f'<text class="lines" x="{x + BOX_WIDTH - 16}" y="{y + 32}">{lines:,}</text>'
            f'<text class="what" x="{x + 16}" y="{y + 57}">{html.escape(FOLDERS[folder])}</text>')
    heads = "".join(f'<marker id="head-{k}" viewBox="0 0 10 10" refX="8" refY="5" markerWidth="8" markerHeight="8" '
                    f'orient="auto"><path d="M0,0 L10,5 L0,10 z" class="head {k}"/></marker>' for k in ("app", "renderer"))
    style = """
        body { margin: 0; background: #14161b }
        svg { font-family: Roboto, sans-serif; display: block }
        .box { stroke-width: 1.5 } .box.app { fill: #20303f; stroke: #5aa9e6 } .box.renderer { fill: #332a1d; stroke: #e6a85a }
        .name { fill: #f2f4f8; font-size: 19px; font-weight: 500 } .what { fill: #b9c0cc; font-size: 15px }
        .lines { fill: #8d96a5; font-size: 15px; text-anchor: end }
        .arrow { fill: none; stroke-width: 2; opacity: .85 } .arrow.app { stroke: #5aa9e6 } .arrow.renderer { stroke: #e6a85a }
        .head.app { fill: #5aa9e6 } .head.renderer { fill: #e6a85a }"""
    page = (f'<style>{style}</style><svg width="{width}" height="{height}"><defs>{heads}</defs>{"".join(parts)}</svg>')
    return page, int(width), int(height)


# --- the frame ---------------------------------------------------------------------------------------------------

STAGES = [  # heading, [(title, image, how it is colored)]
    ("What is seen", [("visibility buffer", "instance", "labels"), ("shading normal", "normal", "signed"),
                      ("depth", "depth", "range"), ("albedo", "albedo", "color")]),
    ("Light, one sample", [("raw signal", "raw", "color"), ("gradient sample, placed", "samples", "range"),
                           ("delta, as sampled", "gradient_sample", "difference"), ("Delta, as sampled", "gradient_sample_max", "range")]),
    ("Change of light", [("delta, reconstructed", "gradient", "difference"), ("Delta, reconstructed", "gradient_max", "range"),
                         ("lambda", "lambda", "unit"), ("alpha'", "alpha", "unit")]),
    ("Time", [("history, as fetched", "history_luminance", "range"), ("accumulated", "accumulated", "color"),
              ("history length N", "history", "range"), ("variance", "variance", "root")]),
    ("Space, and the picture", [("after five a-trous iterations", "filtered", "color"), ("times albedo, plus emission", "color", "color"),
                                ("display image", "display", "display")]),
]


def read_pfm(path):
    with open(path, "rb") as file:
        kind, size, scale = file.readline().strip(), file.readline().split(), float(file.readline())
        width, height = map(int, size)
        channels = 3 if kind == b"PF" else 1
        data = np.frombuffer(file.read(), "<f4" if scale < 0 else ">f4").reshape(height, width, channels)
    return data[::-1].astype(np.float64)


def srgb(linear):
    x = np.clip(linear, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.power(x, 1 / 2.4) - 0.055)


def ramp(x, stops):
    x = np.clip(x, 0, 1) * (len(stops) - 1)
    low = np.minimum(x.astype(int), len(stops) - 2)
    stops = np.array(stops) / 255
    return stops[low] + (x - low)[..., None] * (stops[low + 1] - stops[low])


HEAT = [(12, 14, 20), (49, 61, 116), (45, 131, 140), (146, 195, 90), (253, 231, 120)]
DIVERGING = [(74, 158, 255), (20, 42, 70), (14, 15, 18), (82, 44, 16), (255, 160, 66)]


def colored(image, how):
    if how == "color":
        return srgb(image / max(np.percentile(image, 97), 1e-6))
    if how == "signed":
        return image * 0.5 + 0.5
    x = image[..., 0]
    if how == "labels":
        turn = (x * 0.618034) % 1
        wheel = 0.5 + 0.35 * np.cos(2 * np.pi * (turn[..., None] + np.array([0, 1 / 3, 2 / 3])))
        return np.where(x[..., None] == 0, 0.06, wheel)
    if how == "difference":
        return ramp(0.5 + 0.5 * x / max(np.percentile(np.abs(x), 98), 1e-6), DIVERGING)
    if how == "root":
        x = np.sqrt(np.maximum(x, 0))
    if how != "unit":
        x = x / max(np.percentile(x, 99), 1e-6)
    return ramp(x, HEAT)


def picture_code(image):
    with tempfile.NamedTemporaryFile(suffix=".png") as file:
        imsave(file.name, (np.clip(image, 0, 1) * 255 + 0.5).astype(np.uint8), check_contrast=False)
        return base64.b64encode(pathlib.Path(file.name).read_bytes()).decode()


def frame_picture(program):
    names = sorted({image for _, cards in STAGES for _, image, _ in cards if image != "display"})
    with tempfile.TemporaryDirectory() as folder:
        frame = 20
        subprocess.run([program, "render", "hall", "--filter", "asvgf", "--frames", str(frame + 1), "--last", "--size", "480x270",
                        "--light", f"key=off@{frame}", "--aov", ",".join(names), "--format", "pfm", "--context", "osmesa",
                        "--out", folder], check=True, stdout=subprocess.DEVNULL)
        rows = []
        for number, (heading, cards) in enumerate(STAGES, 1):
            row = [f'<div class="heading"><b>{number}</b>{html.escape(heading)}</div>']
            for title, image, how in cards:
                if how == "display":
                    pixels = imread(f"{folder}/color_{frame:04}.png")[..., :3] / 255
                    image = "color.png"
                else:
                    pixels = colored(read_pfm(f"{folder}/{image}_{frame:04}.pfm"), how)
                row.append(f'<div class="card"><img src="data:image/png;base64,{picture_code(pixels)}">'
                           f'<div class="title">{html.escape(title)}</div><code>{image}</code></div>')
            rows.append(f'<div class="row">{"<i>&#8594;</i>".join(row)}</div>')
    style = """
        body { margin: 0; background: #14161b; color: #f2f4f8; font-family: Roboto, sans-serif }
        main { padding: 26px 34px; width: 1532px }
        .row { display: flex; align-items: center; margin: 16px 0 }
        .heading { width: 150px; font-size: 19px; font-weight: 500; line-height: 1.25 }
        .heading b { display: block; color: #5aa9e6; font-size: 30px; font-weight: 700 }
        i { font-style: normal; color: #6d7686; font-size: 22px; width: 34px; text-align: center }
        .card { width: 312px } img { width: 312px; height: 175.5px; image-rendering: pixelated; border-radius: 6px; display: block }
        .title { font-size: 16px; margin-top: 6px; display: inline-block }
        code { float: right; font-size: 13px; margin-top: 8px; color: #9aa3b2; font-family: Roboto Mono, monospace }"""
    return f"<style>{style}</style><main>{''.join(rows)}</main>", 1600, 5 * 217 + 52


def screenshot(page, width, height, target):
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "page.html"
        source.write_text(f"<!doctype html><meta charset=utf-8>{page}")
        subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
                        "--disable-background-networking", "--disable-component-update", "--disable-sync", "--hide-scrollbars",
                        f"--user-data-dir={folder}/profile", f"--window-size={width},{height}", f"--screenshot={target}",
                        f"file://{source}"], check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)


def main():
    program = sys.argv[1] if len(sys.argv) > 1 else str(ROOT / "build/release/bin/afterglow")
    screenshot(*folders_picture(), ROOT / "docs/images/architecture.png")
    screenshot(*frame_picture(program), ROOT / "docs/images/frame.png")


if __name__ == "__main__":
    main()
