#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes the example scenes: cornell.gltf, with its data in it, and spinner.glb, which moves.

    python3 make_cornell.py [folder]

Metres, Y up. The same bytes every time; the standard library is enough.
"""

import base64
import json
import math
import pathlib
import struct
import sys

FLOAT, UINT16 = 5126, 5123


class Gltf:
    """A glTF 2.0 document and the bytes of its one buffer."""

    def __init__(self):
        self.data = bytearray()
        self.document = {
            "asset": {"version": "2.0", "generator": "make_cornell.py"},
            "scene": 0,
            "scenes": [{"nodes": []}],
            "nodes": [], "meshes": [], "materials": [],
            "accessors": [], "bufferViews": [],
        }

    def append(self, key, value):
        self.document.setdefault(key, []).append(value)
        return len(self.document[key]) - 1

    def accessor(self, values, kind, component=FLOAT, bounds=False):
        """Values are tuples; kind is "SCALAR", "VEC3" or "VEC4"."""
        while len(self.data) % 4:
            self.data.append(0)
        start = len(self.data)
        code = "f" if component == FLOAT else "H"
        for value in values:
            self.data += struct.pack(f"<{len(value)}{code}", *value)
        view = self.append("bufferViews", {"buffer": 0, "byteOffset": start,
                                           "byteLength": len(self.data) - start})
        entry = {"bufferView": view, "componentType": component, "count": len(values), "type": kind}
        if bounds:  # as the file stores them, so rounded to 32 bits
            single = [struct.unpack(f"<{len(v)}f", struct.pack(f"<{len(v)}f", *v)) for v in values]
            entry["min"] = [min(column) for column in zip(*single)]
            entry["max"] = [max(column) for column in zip(*single)]
        return self.append("accessors", entry)

    def material(self, name, color, radiance=None):
        entry = {"name": name,
                 "pbrMetallicRoughness": {"baseColorFactor": [*color, 1], "metallicFactor": 0,
                                          "roughnessFactor": 1}}
        if radiance:
            strength = max(radiance)
            entry["emissiveFactor"] = [c / strength for c in radiance]
            entry["extensions"] = {"KHR_materials_emissive_strength": {"emissiveStrength": strength}}
            self.document["extensionsUsed"] = ["KHR_materials_emissive_strength"]
        return self.append("materials", entry)

    def mesh(self, name, quads, material):
        """Quads are four corners, counter-clockwise seen from their front."""
        positions, normals, indices = [], [], []
        for quad in quads:
            a, b, c, d = quad
            normal = unit(cross(minus(c, a), minus(d, b)))
            first = len(positions)
            positions += quad
            normals += [normal] * 4
            indices += [(first + i,) for i in (0, 1, 2, 0, 2, 3)]
        primitive = {"attributes": {"POSITION": self.accessor(positions, "VEC3", bounds=True),
                                    "NORMAL": self.accessor(normals, "VEC3")},
                     "indices": self.accessor(indices, "SCALAR", UINT16),
                     "material": material}
        return self.append("meshes", {"name": name, "primitives": [primitive]})

    def node(self, name, **members):
        index = self.append("nodes", {"name": name, **members})
        self.document["scenes"][0]["nodes"].append(index)
        return index

    def camera(self, fov, near, translation, rotation=(0, 0, 0, 1)):
        camera = self.append("cameras", {"type": "perspective",
                                         "perspective": {"yfov": fov, "znear": near}})
        self.node("camera", camera=camera, translation=translation, rotation=rotation)

    def write_gltf(self, path):
        text = base64.b64encode(self.data).decode("ascii")
        self.document["buffers"] = [{"byteLength": len(self.data),
                                     "uri": "data:application/octet-stream;base64," + text}]
        path.write_text(json.dumps(self.document, indent=1) + "\n", encoding="ascii")

    def write_glb(self, path):
        self.document["buffers"] = [{"byteLength": len(self.data)}]
        text = json.dumps(self.document, separators=(",", ":")).encode("ascii")
        text += b" " * (-len(text) % 4)
        data = bytes(self.data) + b"\0" * (-len(self.data) % 4)
        chunks = (struct.pack("<II", len(text), 0x4E4F534A) + text
                  + struct.pack("<II", len(data), 0x004E4942) + data)
        path.write_bytes(struct.pack("<4sII", b"glTF", 2, 12 + len(chunks)) + chunks)


def minus(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def unit(a):
    return tuple(x / math.sqrt(dot(a, a)) for x in a)


def facing(front, a, b, c, d):
    """The quad a b c d, turned to face along front."""
    return [a, b, c, d] if dot(cross(minus(c, a), minus(d, b)), front) >= 0 else [d, c, b, a]


def prism(base, height):
    """The sides and the top of an upright block over four corners (x, z)."""
    low = [(x, 0.0, z) for x, z in base]
    high = [(x, height, z) for x, z in base]
    middle = tuple(sum(column) / 4 for column in zip(*low))
    quads = [facing((0, 1, 0), *high)]
    for i in range(4):
        j = (i + 1) % 4
        outward = tuple((p + q) / 2 - m for p, q, m in zip(low[i], low[j], middle))
        quads.append(facing(outward, low[i], low[j], high[j], high[i]))
    return quads


def box(half):
    quads = prism([(-half, -half), (half, -half), (half, half), (-half, half)], 2 * half)
    quads = [[(x, y - half, z) for x, y, z in quad] for quad in quads]
    return quads + [facing((0, -1, 0), (-half, -half, -half), (half, -half, -half),
                           (half, -half, half), (-half, -half, half))]


def cornell():
    gltf = Gltf()
    half, height, depth = 0.278, 0.5488, 0.5592
    white = gltf.material("white", (0.73, 0.73, 0.73))
    red = gltf.material("red", (0.63, 0.065, 0.05))
    green = gltf.material("green", (0.14, 0.45, 0.091))
    a, b, c, d = (-half, 0, 0), (half, 0, 0), (half, 0, -depth), (-half, 0, -depth)
    ah, bh, ch, dh = [(x, height, z) for x, _, z in (a, b, c, d)]
    gltf.node("walls", mesh=gltf.mesh("walls", [[a, b, c, d], [dh, ch, bh, ah], [d, c, ch, dh]], white))
    gltf.node("left", mesh=gltf.mesh("left", [[a, d, dh, ah]], red))
    gltf.node("right", mesh=gltf.mesh("right", [[c, b, bh, ch]], green))

    # Cornell University Program of Computer Graphics, "Cornell Box Data", millimetres, there with x
    # to the left and z into the picture.
    def place(x, z):
        return (half - x / 1000, -z / 1000)

    gltf.node("short block", mesh=gltf.mesh("short block", prism(
        [place(130, 65), place(82, 225), place(240, 272), place(290, 114)], 0.165), white))
    gltf.node("tall block", mesh=gltf.mesh("tall block", prism(
        [place(423, 247), place(265, 296), place(314, 456), place(472, 406)], 0.33), white))

    # One-sided, so they face into the box. The strengths are those of the built-in scene.
    y = height - 0.001
    (x0, z0), (x1, z1) = place(343, 332), place(213, 227)
    key = gltf.material("key", (0, 0, 0), (52, 38, 22))
    gltf.node("key", mesh=gltf.mesh("key", [
        facing((0, -1, 0), (x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1))], key))
    x = half - 0.001
    fill = gltf.material("fill", (0, 0, 0), (7, 13, 22))
    gltf.node("fill", mesh=gltf.mesh("fill", [
        facing((-1, 0, 0), (x, 0.34, -0.14), (x, 0.34, -0.24), (x, 0.42, -0.24),
               (x, 0.42, -0.14))], fill))
    gltf.camera(0.686, 0.01, [0, 0.273, 0.8])
    return gltf


def spinner():
    """A block that turns and bobs over a floor, with a small one that travels round with it."""
    gltf = Gltf()
    floor = [facing((0, 1, 0), (-2, 0, -2), (2, 0, -2), (2, 0, 2), (-2, 0, 2))]
    gltf.node("floor", mesh=gltf.mesh("floor", floor, gltf.material("floor", (0.65, 0.62, 0.58))))
    lamp = [facing((0, -1, 0), (-0.5, 2.5, -0.5), (0.5, 2.5, -0.5), (0.5, 2.5, 0.5), (-0.5, 2.5, 0.5))]
    gltf.node("key", mesh=gltf.mesh("key", lamp, gltf.material("key", (0, 0, 0), (12, 11, 9))))
    moon = gltf.append("nodes", {"name": "moon", "translation": [0.8, 0, 0], "mesh": gltf.mesh(
        "moon", box(0.12), gltf.material("moon", (0.2, 0.35, 0.6)))})
    block = gltf.node("block", translation=[0, 0.7, 0], children=[moon], mesh=gltf.mesh(
        "block", box(0.35), gltf.material("block", (0.7, 0.3, 0.2))))

    times = gltf.accessor([(float(i),) for i in range(5)], "SCALAR", bounds=True)
    turns = gltf.accessor([(0, math.sin(math.pi * i / 4), 0, math.cos(math.pi * i / 4))
                           for i in range(5)], "VEC4")
    heights = gltf.accessor([(0, y, 0) for y in (0.7, 0.9, 0.7, 0.55, 0.7)], "VEC3")
    gltf.append("animations", {
        "name": "spin",
        "samplers": [{"input": times, "output": turns}, {"input": times, "output": heights}],
        "channels": [{"sampler": 0, "target": {"node": block, "path": "rotation"}},
                     {"sampler": 1, "target": {"node": block, "path": "translation"}}]})
    lean = -0.3  # radians about X: downwards
    gltf.camera(0.8, 0.05, [0, 1.9, 4.2], [math.sin(lean / 2), 0, 0, math.cos(lean / 2)])
    return gltf


if __name__ == "__main__":
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent)
    cornell().write_gltf(folder / "cornell.gltf")
    spinner().write_glb(folder / "spinner.glb")
