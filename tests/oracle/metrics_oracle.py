#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Computes every image metric a second time, for metrics_oracle_test.cpp to compare with.

Usage: metrics_oracle.py FOLDER

FOLDER/pairs.txt has a line "NAME PIXELS_PER_DEGREE" for each pair of display pictures,
NAME.image.png and NAME.reference.png, with the pixels that count in NAME.mask.png (red not 0).
FOLDER/sequences.txt has a line "NAME FRAMES" for each pair of linear sequences,
NAME.image.0.pfm ... and NAME.reference.0.pfm ..., with NAME.mask.png.

Writes FOLDER/answers.txt, a line "NAME.metric VALUE" each, and for the maps NAME.metric.f64: doubles
in the order of the machine, row by row.

PSNR, MSE and SSIM are those of scikit-image, PSNR also that of FFmpeg. The others are written here
from the formulas: convolutions in two dimensions, all in double precision.
"""

import math
import re
import subprocess
import sys
from pathlib import Path

INSTALL = "third_party/install.sh --tests installs it"
try:
    import numpy as np
    from scipy import ndimage
    from skimage import io, metrics
except ImportError as error:
    sys.exit(f"metrics_oracle.py: python3-skimage is not there ({error}); {INSTALL}")


def read_pfm(path):
    """A color PFM as an array [row, column, channel]; row 0 is the top of the picture."""
    data = path.read_bytes()
    head = re.match(rb"PF\s+(\d+)\s+(\d+)\s+(\S+)\s", data)
    width, height = int(head[1]), int(head[2])
    kind = "<f4" if float(head[3]) < 0 else ">f4"
    values = np.frombuffer(data, kind, width * height * 3, head.end())
    return values.reshape(height, width, 3)[::-1].astype(np.float64)


# FLIP: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild: "FLIP: A Difference
# Evaluator for Alternating Images", HPG 2020.

def xyz_from_rgb():
    """From the primaries of IEC 61966-2-1. White is D65; the authors take it at (0.31271, 0.32902),
    which moves the error of a pixel by up to 1e-4 against the rounded (0.3127, 0.3290)."""
    def xyz(x, y):
        return np.array([x / y, 1.0, (1.0 - x - y) / y])
    primaries = np.column_stack([xyz(0.64, 0.33), xyz(0.30, 0.60), xyz(0.15, 0.06)])
    white = xyz(0.31271, 0.32902)
    return primaries * np.linalg.solve(primaries, white), white


XYZ_FROM_RGB, WHITE = xyz_from_rgb()
RGB_FROM_XYZ = np.linalg.inv(XYZ_FROM_RGB)


def linear_from_srgb(encoded):
    return np.where(encoded <= 0.04045, encoded / 12.92, ((encoded + 0.055) / 1.055) ** 2.4)


def ycxcz_from_rgb(rgb):
    x, y, z = np.moveaxis(rgb @ XYZ_FROM_RGB.T / WHITE, -1, 0)
    return np.stack([116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)], axis=-1)


def rgb_from_ycxcz(color):
    luma, cx, cz = np.moveaxis(color, -1, 0)
    y = (luma + 16.0) / 116.0
    return (np.stack([y + cx / 500.0, y, y - cz / 200.0], axis=-1) * WHITE) @ RGB_FROM_XYZ.T


def hunt_lab_from_rgb(rgb):
    """CIE L*a*b* with a and b scaled by lightness, after Hunt: colorfulness grows with luminance."""
    t = rgb @ XYZ_FROM_RGB.T / WHITE
    delta = 6.0 / 29.0
    f = np.where(t > delta ** 3, np.cbrt(t), t / (3.0 * delta ** 2) + 4.0 / 29.0)
    lightness = 116.0 * f[..., 1] - 16.0
    a = 500.0 * (f[..., 0] - f[..., 1])
    b = 200.0 * (f[..., 1] - f[..., 2])
    return np.stack([lightness, 0.01 * lightness * a, 0.01 * lightness * b], axis=-1)


def hyab(p, q):
    d = p - q
    return np.abs(d[..., 0]) + np.hypot(d[..., 1], d[..., 2])


CONTRAST_SENSITIVITY = {  # a, b of each Gaussian of the channel, in the frequency domain
    "Y": [(1.0, 0.0047)],
    "Cx": [(1.0, 0.0053)],
    "Cz": [(34.1, 0.04), (13.5, 0.025)],
}


def grid(radius):
    return np.meshgrid(np.arange(-radius, radius + 1), np.arange(-radius, radius + 1))


def sensitivity_kernel(gaussians, pixels_per_degree):
    widest = max(b for all_of in CONTRAST_SENSITIVITY.values() for _, b in all_of)
    x, y = grid(math.ceil(3.0 * math.sqrt(widest / (2.0 * math.pi ** 2)) * pixels_per_degree))
    squared_degrees = (x ** 2 + y ** 2) / pixels_per_degree ** 2
    kernel = sum(a * math.sqrt(math.pi / b) * np.exp(-math.pi ** 2 / b * squared_degrees)
                 for a, b in gaussians)
    return kernel / kernel.sum()


def feature_kernels(pixels_per_degree):
    """First and second derivative along x of a Gaussian; each sign of weight sums to one."""
    deviation = 0.5 * 0.082 * pixels_per_degree
    x, y = grid(math.ceil(3.0 * deviation))
    gaussian = np.exp(-(x ** 2 + y ** 2) / (2.0 * deviation ** 2))
    kernels = []
    for weights in (-x * gaussian, (x ** 2 / deviation ** 2 - 1.0) * gaussian):
        kernels.append(np.where(weights > 0.0, weights / weights[weights > 0.0].sum(),
                                weights / -weights[weights < 0.0].sum()))
    return kernels


def convolved(channel, kernel):
    return ndimage.convolve(channel, kernel, mode="nearest")  # beyond the border, the nearest pixel


def flip(image, reference, pixels_per_degree):
    colors, features = [], []
    for encoded in (image, reference):
        color = ycxcz_from_rgb(linear_from_srgb(encoded))
        seen = np.stack([convolved(color[..., i], sensitivity_kernel(gaussians, pixels_per_degree))
                         for i, gaussians in enumerate(CONTRAST_SENSITIVITY.values())], axis=-1)
        colors.append(hunt_lab_from_rgb(np.clip(rgb_from_ycxcz(seen), 0.0, 1.0)))
        gray = (color[..., 0] + 16.0) / 116.0
        features.append([np.hypot(convolved(gray, kernel), convolved(gray, kernel.T))
                         for kernel in feature_kernels(pixels_per_degree)])

    green, blue = (hunt_lab_from_rgb(np.array(rgb)) for rgb in ((0.0, 1.0, 0.0), (0.0, 0.0, 1.0)))
    largest = hyab(green, blue) ** 0.7
    knee = 0.4 * largest
    error = hyab(colors[0], colors[1]) ** 0.7
    error = np.where(error < knee, 0.95 / knee * error,
                     0.95 + (error - knee) / (largest - knee) * 0.05)

    edges, points = (np.abs(of_image - of_reference) for of_image, of_reference in zip(*features))
    feature = np.sqrt(np.maximum(edges, points) / math.sqrt(2.0))
    return error ** (1.0 - feature)


def ssim(image, reference):
    """The mean and the map; None and the map where a side is below the 11 pixels of the window."""
    options = dict(gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=1.0)
    mean = None
    if min(image.shape[:2]) >= 11:
        mean = metrics.structural_similarity(image, reference, channel_axis=2, **options)

    # scikit-image reflects at the border; the map there is with the nearest pixel repeated.
    def window(values):
        return ndimage.gaussian_filter(values, (1.5, 1.5, 0.0), mode="nearest", truncate=3.5)
    mean_x, mean_y = window(image), window(reference)
    variance_x = window(image ** 2) - mean_x ** 2
    variance_y = window(reference ** 2) - mean_y ** 2
    covariance = window(image * reference) - mean_x * mean_y
    c1, c2 = 0.01 ** 2, 0.03 ** 2
    similarity = ((2.0 * mean_x * mean_y + c1) * (2.0 * covariance + c2)
                  / ((mean_x ** 2 + mean_y ** 2 + c1) * (variance_x + variance_y + c2)))
    return mean, similarity.mean(axis=2)


def ffmpeg_psnr(image, reference):
    filters = "[0:v]format=gbrp[a];[1:v]format=gbrp[b];[a][b]psnr"
    try:
        run = subprocess.run(["ffmpeg", "-nostdin", "-hide_banner", "-i", image, "-i", reference,
                              "-lavfi", filters, "-f", "null", "-"],
                             stderr=subprocess.PIPE, text=True, check=True)
    except FileNotFoundError:
        sys.exit(f"metrics_oracle.py: ffmpeg is not there; {INSTALL}")
    return float(re.search(r"PSNR .*average:(\S+)", run.stderr)[1])


def main(folder):
    answers = {}

    def read_png(name):
        return io.imread(folder / f"{name}.png")[..., :3]

    def mask_of(name):
        return read_png(f"{name}.mask")[..., 0] != 0

    for line in (folder / "pairs.txt").read_text().splitlines():
        name, pixels_per_degree = line.split()
        files = [folder / f"{name}.image.png", folder / f"{name}.reference.png"]
        image, reference = (io.imread(file)[..., :3] / 255.0 for file in files)
        mask = mask_of(name)
        answers[f"{name}.mse"] = metrics.mean_squared_error(image, reference)
        answers[f"{name}.mse.masked"] = metrics.mean_squared_error(image[mask], reference[mask])
        with np.errstate(divide="ignore"):  # equal pictures: infinite
            answers[f"{name}.psnr"] = metrics.peak_signal_noise_ratio(reference, image,
                                                                      data_range=1.0)
        answers[f"{name}.psnr.ffmpeg"] = ffmpeg_psnr(*files)

        mean, similarity = ssim(image, reference)
        height, width = similarity.shape
        crop_x, crop_y = min(5, (width - 1) // 2), min(5, (height - 1) // 2)
        inner = np.zeros_like(mask)
        inner[crop_y:height - crop_y, crop_x:width - crop_x] = True
        answers[f"{name}.ssim"] = similarity[inner].mean() if mean is None else mean
        answers[f"{name}.ssim.masked"] = similarity[inner & mask].mean()
        similarity.tofile(folder / f"{name}.ssim.f64")

        error = flip(image, reference, float(pixels_per_degree))
        answers[f"{name}.flip"] = error.mean()
        answers[f"{name}.flip.masked"] = error[mask].mean()
        error.tofile(folder / f"{name}.flip.f64")

    for line in (folder / "sequences.txt").read_text().splitlines():
        name, frames = line.split()
        image, reference = (np.stack([read_pfm(folder / f"{name}.{kind}.{i}.pfm")
                                      for i in range(int(frames))])
                            for kind in ("image", "reference"))
        everywhere = np.ones(image.shape[1:3], bool)
        for suffix, mask in (("", everywhere), (".masked", mask_of(name))):
            x, r = image[:, mask], reference[:, mask]
            answers[f"{name}.flicker{suffix}"] = x.std(axis=0).mean()
            last = (x[-1] - x[-2]) - (r[-1] - r[-2])
            answers[f"{name}.temporal{suffix}"] = math.sqrt((last ** 2).mean())
            power = r[-1] ** 2
            answers[f"{name}.relmse{suffix}"] = (
                (x[-1] - r[-1]) ** 2 / (power + 0.01 * power.mean())).mean()

    (folder / "answers.txt").write_text(
        "".join(f"{name} {float(value)!r}\n" for name, value in answers.items()))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
