#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""A small denoiser, as an example of how another program meets Afterglow's frames.

    afterglow render light-off --export --format pfm --out noise
    python3 denoise.py noise mine
    afterglow import-frames noise mine --name mine --out score

An exponential average over time along the motion, then a blur that stops at edges of normal and
depth. It knows nothing of light that changes. Needs Python 3 and NumPy.
"""

import json
import pathlib
import sys

import numpy

ALPHA = 0.2             # weight of the newest frame
DEPTH_TOLERANCE = 0.02  # of the depth itself: more is another surface
NORMAL_POWER = 64
BLURS = (1, 2, 4)       # strides of 5x5 kernels


def read_pfm(path):
    """An array (height, width, channels), row 0 on top."""
    with open(path, 'rb') as file:
        channels = 3 if file.readline().strip() == b'PF' else 1
        width, height = map(int, file.readline().split())
        order = '<' if float(file.readline()) < 0 else '>'
        pixels = numpy.frombuffer(file.read(), order + 'f4')
    return pixels.reshape(height, width, channels)[::-1]


def write_pfm(path, image):
    with open(path, 'wb') as file:
        file.write(b'PF\n%d %d\n-1.0\n' % (image.shape[1], image.shape[0]))
        file.write(image[::-1].astype('<f4').tobytes())


def accumulate(raw, motion, previous_depth, history):
    """Blends the frame with what its surfaces looked like before, where they were seen."""
    if history is None:
        return raw
    before, depth_before = history
    height, width = raw.shape[:2]
    y, x = numpy.mgrid[0:height, 0:width]
    # The pixel that holds (x + 0.5, y + 0.5) + motion.
    then_x = numpy.floor(x + 0.5 + motion[..., 0]).astype(int)
    then_y = numpy.floor(y + 0.5 + motion[..., 1]).astype(int)
    inside = (then_x >= 0) & (then_x < width) & (then_y >= 0) & (then_y < height)
    then_x, then_y = then_x.clip(0, width - 1), then_y.clip(0, height - 1)
    distance = abs(depth_before[then_y, then_x] - previous_depth)
    known = inside[..., None] & (previous_depth > 0) & (distance < DEPTH_TOLERANCE * previous_depth)
    return numpy.where(known, ALPHA * raw + (1 - ALPHA) * before[then_y, then_x], raw)


def shifted(image, dx, dy):
    """The pixel at (x + dx, y + dy); at the border the last one that there is."""
    height, width = image.shape[:2]
    rows = (numpy.arange(height) + dy).clip(0, height - 1)
    columns = (numpy.arange(width) + dx).clip(0, width - 1)
    return image[rows[:, None], columns]


def blur(signal, normal, depth, stride):
    kernel = numpy.array([1, 4, 6, 4, 1]) / 16
    total, weights = numpy.zeros_like(signal), numpy.zeros_like(depth)
    for j, ky in enumerate(kernel):
        for i, kx in enumerate(kernel):
            dx, dy = (i - 2) * stride, (j - 2) * stride
            alike = (normal * shifted(normal, dx, dy)).sum(-1, keepdims=True).clip(0, 1)
            gap = abs(depth - shifted(depth, dx, dy)) / (DEPTH_TOLERANCE * stride * depth + 1e-6)
            weight = kx * ky * alike ** NORMAL_POWER * numpy.exp(-gap)
            total += weight * shifted(signal, dx, dy)
            weights += weight
    return numpy.where(weights > 0, total / numpy.maximum(weights, 1e-12), signal)


def main(noise, out):
    noise, out = pathlib.Path(noise), pathlib.Path(out)
    out.mkdir(parents=True, exist_ok=True)
    history = None
    for frame in json.loads((noise / 'export.json').read_text())['frames']:
        number = frame['frame']
        image = {name: read_pfm(noise / f'{name}_{number:04}.pfm')
                 for name in ('raw', 'normal', 'depth', 'motion', 'previous_depth')}
        signal = accumulate(image['raw'], image['motion'], image['previous_depth'], history)
        history = signal, image['depth']
        for stride in BLURS:
            signal = blur(signal, image['normal'], image['depth'], stride)
        write_pfm(out / f'signal_{number:04}.pfm', signal)


if __name__ == '__main__':
    if len(sys.argv) != 3:
        sys.exit('usage: denoise.py EXPORT_DIR OUT_DIR')
    main(*sys.argv[1:])
