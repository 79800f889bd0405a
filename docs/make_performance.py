#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Makes docs/performance.md and its two pictures: runs `afterglow bench` over sizes of the picture and over numbers of
triangles, and draws how times and rays grow with both.

Usage: docs/make_performance.py [--quick] [--program PROGRAM] [--context NAME] [--out FOLDER]
(after third_party/install.sh --tests; a quarter of an hour on two cores without a GPU, which nothing else may use)

--quick measures little and is for trying the script: give it a folder of its own.
"""

import argparse
import html
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile
import textwrap

import numpy as np

from make_architecture_pictures import screenshot

ROOT = pathlib.Path(__file__).resolve().parent.parent
SIZES = ["160x90", "320x180", "480x270", "640x360", "960x540", "1280x720"]
TRIANGLES = [10_000, 30_000, 100_000, 300_000, 1_000_000, 3_000_000]
FILTERS = ["none", "fixed", "svgf", "asvgf"]
KINDS = ["shadow", "ao", "closest", "bounce", "bounce_shadow"]
COLORS = ["#5aa9e6", "#e6a85a", "#7bc96f", "#d97bb6", "#b9a3f0", "#e06c5a"]


# --- a scene of any number of triangles ----------------------------------------------------------------------------

def grid(columns, rows, surface):
    """Corners and triangles of a surface over [0, 1] x [0, 1]."""
    u, v = np.meshgrid(np.linspace(0, 1, columns + 1), np.linspace(0, 1, rows + 1))
    positions = surface(u.ravel(), v.ravel()).astype("<f4")
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)[None, :]).ravel()
    a, b, c, d = first, first + 1, first + columns + 2, first + columns + 1
    return positions, np.concatenate([np.stack([a, d, c], 1), np.stack([a, c, b], 1)]).astype("<u4")


def floor(u, v):
    height = 0.12 * np.sin(23 * u) * np.sin(19 * v) + 0.03 * np.sin(140 * u + 3 * v) * np.sin(110 * v)
    return np.stack([10 * u - 5, height, 10 * v - 5], 1)


def ball(center, radius):
    def surface(u, v):
        along, up = 2 * math.pi * u, math.pi * (0.002 + 0.996 * v)  # at a pole triangles have no area
        r = radius * (1 + 0.03 * np.sin(17 * along) * np.sin(up) * np.sin(13 * up))
        return np.array(center) + np.stack([r * np.sin(up) * np.cos(along), -r * np.cos(up), r * np.sin(up) * np.sin(along)], 1)
    return surface


def quad(corner, a, b):
    return lambda u, v: np.array(corner) + u[:, None] * np.array(a) + v[:, None] * np.array(b)


def write_scene(path, triangles):
    """A room with a bumpy floor and twelve bumpy balls that have about so many triangles together, half and half."""
    side = max(2, round(math.sqrt(triangles / 4)))
    rings = max(3, round(math.sqrt(triangles / 2 / 12 / 4)))
    parts = [(grid(side, side, floor), 0)]
    for i in range(12):
        angle = i * 2.399963
        reach = 0.9 + 0.25 * i
        center = (reach * math.cos(angle), 0.7 + 0.25 * (i % 4), reach * math.sin(angle))
        parts.append((grid(2 * rings, rings, ball(center, 0.55)), 1))
    for corner, a, b in [((-5, -1, -5), (10, 0, 0), (0, 6, 0)), ((-5, -1, 5), (0, 0, -10), (0, 6, 0)),
                         ((5, -1, -5), (0, 0, 10), (0, 6, 0)), ((-5, 5, -5), (10, 0, 0), (0, 0, 10))]:
        parts.append((grid(1, 1, quad(corner, a, b)), 0))
    parts.append((grid(1, 1, quad((-1, 4.9, -1), (2, 0, 0), (0, 0, 2))), 2))

    buffer, views, accessors, meshes, nodes = bytearray(), [], [], [], []

    def add(data, kind, component, **more):
        views.append({"buffer": 0, "byteOffset": len(buffer), "byteLength": data.nbytes})
        accessors.append({"bufferView": len(views) - 1, "componentType": component, "count": len(data.reshape(-1)) //
                          (3 if kind == "VEC3" else 1), "type": kind, **more})
        buffer.extend(data.tobytes())
        return len(accessors) - 1

    for (positions, indices), material in parts:
        position = add(positions, "VEC3", 5126, min=positions.min(0).tolist(), max=positions.max(0).tolist())
        index = add(indices.reshape(-1), "SCALAR", 5125)
        meshes.append({"primitives": [{"attributes": {"POSITION": position}, "indices": index, "material": material}]})
        nodes.append({"mesh": len(meshes) - 1})
    nodes.append({"camera": 0, "translation": [0, 2.4, 4.8], "rotation": [-math.sin(0.16), 0, 0, math.cos(0.16)]})
    scene = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
             "meshes": meshes, "accessors": accessors, "bufferViews": views,
             "buffers": [{"uri": path.stem + ".bin", "byteLength": len(buffer)}],
             "cameras": [{"type": "perspective", "perspective": {"yfov": 1.1, "znear": 0.05}}],
             "materials": [{"doubleSided": True, "pbrMetallicRoughness": {"baseColorFactor": [0.7, 0.7, 0.7, 1]}},
                           {"doubleSided": True, "pbrMetallicRoughness": {"baseColorFactor": [0.8, 0.5, 0.3, 1]}},
                           {"doubleSided": True, "emissiveFactor": [1, 1, 1],
                            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}}}],
             "extensionsUsed": ["KHR_materials_emissive_strength"]}
    path.with_suffix(".bin").write_bytes(buffer)
    path.write_text(json.dumps(scene))


# --- drawing -----------------------------------------------------------------------------------------------------

def number(value):
    for size, unit in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if value >= size:
            return f"{value / size:.3g} {unit}"
    return f"{value:.3g}"


def ticks(low, high):
    """1, 2 and 5 of each decade; more where there would be few, and fewer where there would be many."""
    steps = (1, 2, 3, 4, 5, 7) if high / low < 12 else (1, 2, 5) if high / low < 3000 else (1,)
    return [s * 10.0**e for e in range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1) for s in steps
            if low <= s * 10.0**e * 1.0001 and s * 10.0**e <= high * 1.0001]


def chart(title, x_name, y_name, lines, left):
    """An SVG group: both axes are logarithmic. `lines` are (name, [(x, median, lower, upper)])."""
    width, height, margin = 640, 430, 74
    points = [p for _, line in lines for p in line]
    x_low, x_high = min(p[0] for p in points) / 1.15, max(p[0] for p in points) * 1.15
    y_low, y_high = min(p[2] for p in points) / 1.3, max(p[3] for p in points) * 1.3

    def at(value, low, high, size):
        return size * math.log(value / low) / math.log(high / low)

    def place(x, y):
        return left + margin + at(x, x_low, x_high, width), 70 + height - at(y, y_low, y_high, height)

    parts = [f'<text class="title" x="{left + margin}" y="40">{html.escape(title)}</text>']
    bottom = 70 + height
    for x in ticks(x_low, x_high):
        px = place(x, y_low)[0]
        parts.append(f'<path class="grid" d="M{px:.1f},70 V{bottom}"/><text class="tick" text-anchor="middle" '
                     f'x="{px:.1f}" y="{bottom + 24}">{number(x)}</text>')
    for y in ticks(y_low, y_high):
        py = place(x_low, y)[1]
        parts.append(f'<path class="grid" d="M{left + margin},{py:.1f} h{width}"/><text class="tick" text-anchor="end" '
                     f'x="{left + margin - 10}" y="{py + 5:.1f}">{number(y)}</text>')
    parts.append(f'<text class="name" text-anchor="middle" x="{left + margin + width / 2}" y="{bottom + 54}">{html.escape(x_name)}</text>'
                 f'<text class="name" x="{left + margin}" y="62">{html.escape(y_name)}</text>')
    ends = []
    for i, (name, line) in enumerate(lines):
        color = COLORS[i % len(COLORS)]
        corners = [place(x, y) for x, y, _, _ in line]
        band = [place(x, high) for x, _, _, high in line] + [place(x, low) for x, _, low, _ in reversed(line)]
        parts.append(f'<path d="M{" L".join(f"{x:.1f},{y:.1f}" for x, y in band)} Z" fill="{color}" opacity=".18"/>'
                     f'<path d="M{" L".join(f"{x:.1f},{y:.1f}" for x, y in corners)}" class="line" stroke="{color}"/>')
        parts += [f'<circle cx="{x:.1f}" cy="{y:.1f}" r="4" fill="{color}"/>' for x, y in corners]
        ends.append([corners[-1][1], name, color])
    ends.sort()
    for before, after in zip(ends, ends[1:]):  # names do not cover each other
        after[0] = max(after[0], before[0] + 21)
    shift = max(0, ends[-1][0] - bottom)
    for y, name, color in ends:
        parts.append(f'<text class="name" x="{left + margin + width + 12}" y="{y + 5 - shift:.1f}" style="fill: {color}">{html.escape(name)}</text>')
    return "".join(parts), left + margin + width + 170


def draw(charts, target):
    parts, left = [], 0
    for title, x_name, y_name, lines in charts:
        part, left = chart(title, x_name, y_name, lines, left)
        parts.append(part)
    style = """
        body { margin: 0; background: #14161b } svg { font-family: Roboto, sans-serif; display: block }
        .title { fill: #f2f4f8; font-size: 20px; font-weight: 500 } .name { fill: #b9c0cc; font-size: 16px }
        .tick { fill: #8d96a5; font-size: 14px } .grid { stroke: #2a2f38; stroke-width: 1 }
        .line { fill: none; stroke-width: 2.5 }"""
    screenshot(f'<style>{style}</style><svg width="{left}" height="580">{"".join(parts)}</svg>', left, 580, target)


# --- measuring ---------------------------------------------------------------------------------------------------

def bench(program, words, folder, name):
    file = pathlib.Path(folder) / f"{name}.json"
    subprocess.run([program, "bench", *map(str, words), "--json", file], check=True, stdout=subprocess.DEVNULL)
    return json.loads(file.read_text())


def table(head, rows):
    yield "| " + " | ".join(head) + " |"
    yield "|" + "---|" * len(head)
    for row in rows:
        yield "| " + " | ".join(row) + " |"
    yield ""


class Figures:
    def __init__(self, *results):
        self.all = {key: figure for result in results for key, figure in result["figures"].items()}

    def median(self, key):
        return self.all[key]["median"]

    def text(self, key):
        return f"{self.median(key):.3g}" if key in self.all else "-"

    def point(self, x, key):
        figure = self.all[key]
        return x, figure["median"], figure["lower_quartile"], figure["upper_quartile"]

    def line(self, xs, key):
        """Points of the keys that there are; key(x) names one."""
        return [self.point(x, key(x)) for x in xs if key(x) in self.all and self.median(key(x)) > 0]


def pixels(size):
    width, height = map(int, size.split("x"))
    return width * height


def document(facts, by_size, by_triangles, sizes, counts, load, size_of_triangles):
    machine = facts["machine"]
    yield from [
        "# Performance", "",
        textwrap.fill(
            f"Made by `docs/make_performance.py` at commit {facts['commit']}, on {machine['cpu']} with {machine['threads']} "
            f"threads, {facts['gl']['renderer']}. Load average before and after, to which the program itself adds its threads: "
            f"{load[0]:.1f} and {load[1]:.1f}. {facts['frames']} frames of each filter, {facts['repeats']} repeats of rays and "
            "trees. All numbers are medians; bands in the pictures go from quartile to quartile. [cli.md](cli.md) says how "
            "each is measured.", 120, break_long_words=False, break_on_hyphens=False), "",
        "## Growth with pixels", "",
        "![Milliseconds a frame and Mrays/s over pixels, in the hall](images/performance-pixels.png)", "",
        "Milliseconds a frame in the hall:", ""]
    yield from table(["filter", *sizes], [[f, *(by_size.text(f"hall/{s}/{f}/frame.ms") for s in sizes)] for f in FILTERS])
    yield from ["Mrays/s, and Embree's rate over ours on the same rays and as many threads:", ""]
    yield from table(["rays", *sizes], [
        [kind, *(f"{by_size.text(f'hall/{s}/rays.{kind}.mrays_per_s')} ({by_size.text(f'hall/{s}/rays.{kind}.embree_ratio')})"
                 for s in sizes)] for kind in KINDS])
    yield from ["## Growth with triangles", "",
                "![Mrays/s and milliseconds of trees over triangles](images/performance-triangles.png)", "",
                f"A room with a bumpy floor and twelve bumpy balls, which the script makes, at {size_of_triangles}:", ""]
    names = [f"room-{c}" for c in counts]
    yield from table(["triangles", *KINDS, "build, ms", "Embree, ms", "refit, ms", "SAH", "Embree"], [
        [f"{by_triangles.median(f'{n}/bvh.triangles'):,.0f}",
         *(f"{by_triangles.text(f'{n}/{size_of_triangles}/rays.{k}.mrays_per_s')} "
           f"({by_triangles.text(f'{n}/{size_of_triangles}/rays.{k}.embree_ratio')})" for k in KINDS),
         *(by_triangles.text(f"{n}/bvh.{key}") for key in ("build.ms", "embree_build.ms", "refit.ms", "sah_cost", "embree_sah_cost"))]
        for n in names])


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--quick", action="store_true")
    parser.add_argument("--program", default=str(ROOT / "build/release/bin/afterglow"))
    parser.add_argument("--context", default="osmesa")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "docs")
    given = parser.parse_args()
    if given.quick and given.out.resolve() == ROOT / "docs":
        sys.exit("make_performance.py: --quick needs --out: its numbers are none for the documents")
    sizes = SIZES[:3] if given.quick else SIZES
    counts = TRIANGLES[:3] if given.quick else TRIANGLES
    size = "160x90" if given.quick else "640x360"
    effort = ["--frames", 8, "--repeat", 3] if given.quick else ["--frames", 64, "--repeat", 15]
    common = [*effort, "--context", given.context]
    load = [os.getloadavg()[0]]
    with tempfile.TemporaryDirectory() as folder:
        of_sizes = bench(given.program, ["hall", "--what", "passes,rays", "--size", ",".join(sizes), "--filter",
                                         ",".join(FILTERS), *common], folder, "sizes")
        scenes = [pathlib.Path(folder) / f"room-{count}.gltf" for count in counts]
        for scene, count in zip(scenes, counts):
            write_scene(scene, count)
        of_triangles = bench(given.program, [*scenes, "--what", "rays,bvh", "--size", size, "--filter", "svgf", *common],
                             folder, "triangles")
    load.append(os.getloadavg()[0])
    by_size, by_triangles = Figures(of_sizes), Figures(of_triangles)

    images = given.out / "images"
    images.mkdir(parents=True, exist_ok=True)
    size_by_pixels = {pixels(s): s for s in sizes}
    draw([("A frame of the hall", "pixels", "milliseconds",
           [(f, by_size.line(size_by_pixels, lambda x: f"hall/{size_by_pixels[x]}/{f}/frame.ms")) for f in FILTERS]),
          ("Rays in the hall", "pixels", "Mrays/s",
           [(k, by_size.line(size_by_pixels, lambda x: f"hall/{size_by_pixels[x]}/rays.{k}.mrays_per_s")) for k in KINDS])],
         images / "performance-pixels.png")
    name_by_count = {by_triangles.median(f"room-{c}/bvh.triangles"): f"room-{c}" for c in counts}
    draw([("Rays", "triangles", "Mrays/s",
           [(k, by_triangles.line(name_by_count, lambda x: f"{name_by_count[x]}/{size}/rays.{k}.mrays_per_s")) for k in KINDS]),
          ("Trees", "triangles", "milliseconds",
           [(label, by_triangles.line(name_by_count, lambda x: f"{name_by_count[x]}/bvh.{key}.ms"))
            for label, key in (("build", "build"), ("build, Embree", "embree_build"), ("refit", "refit"))
            if f"room-{counts[0]}/bvh.{key}.ms" in by_triangles.all])],
         images / "performance-triangles.png")
    text = "\n".join(document(of_sizes, by_size, by_triangles, sizes, counts, load, size))
    (given.out / "performance.md").write_text(text)
    print(given.out / "performance.md")


if __name__ == "__main__":
    main()
