// SPDX-License-Identifier: MIT
/// Pictures are decoded when they are first drawn, and a few hundred are kept.

const mostDecoded = 240;
const decoded = new Map();
let parsed = document.readyState !== 'loading' ? Promise.resolve() : new Promise((resolve) => {
    document.addEventListener('DOMContentLoaded', resolve, { once: true });
});

/// A drawable picture; a map of values as colors if `asMap`. What it returns is kept by its number.
function pictureOf(number, asMap) {
    const key = asMap ? `map ${number}` : number;
    let entry = decoded.get(key);
    if (entry) {
        decoded.delete(key); // goes to the end: the least recently drawn is dropped first
    } else {
        entry = { ready: null, promise: null };
        entry.promise = decode(number).then((image) => (entry.ready = asMap ? colored(image) : image));
    }
    decoded.set(key, entry);
    if (decoded.size > mostDecoded) decoded.delete(decoded.keys().next().value);
    return entry;
}

async function decode(number) {
    await parsed;
    const source = document.getElementById(`p${number}`);
    const image = new Image();
    image.src = `data:${source.type};base64,${source.textContent}`;
    await image.decode();
    return image;
}

/// Values in [0, 1] become colors of even steps in lightness: dark blue, teal, yellow. The way
/// between the stops is straight in OKLab (B. Ottosson, "A perceptual color space for image
/// processing", 2020).
const rampStops = [
    { at: 0.0, lightness: 0.2, a: 0.005, b: -0.075 },
    { at: 0.3, lightness: 0.41, a: -0.035, b: -0.1 },
    { at: 0.6, lightness: 0.64, a: -0.115, b: 0.005 },
    { at: 0.82, lightness: 0.8, a: -0.095, b: 0.12 },
    { at: 1.0, lightness: 0.95, a: -0.03, b: 0.165 },
];

function srgbOfOklab(lightness, a, b) {
    const l = (lightness + 0.3963377774 * a + 0.2158037573 * b) ** 3;
    const m = (lightness - 0.1055613458 * a - 0.0638541728 * b) ** 3;
    const s = (lightness - 0.0894841775 * a - 1.291485548 * b) ** 3;
    return [
        4.0767416621 * l - 3.3077115913 * m + 0.2309699292 * s,
        -1.2684380046 * l + 2.6097574011 * m - 0.3413193965 * s,
        -0.0041960863 * l - 0.7034186147 * m + 1.707614701 * s,
    ].map((linear) => {
        const x = Math.max(0, Math.min(1, linear));
        return Math.round(255 * (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055));
    });
}

const ramp = Array.from({ length: 256 }, (_, i) => {
    const x = i / 255;
    const next = Math.max(1, rampStops.findIndex((stop) => stop.at >= x));
    const [low, high] = [rampStops[next - 1], rampStops[next]];
    const t = (x - low.at) / (high.at - low.at);
    const mixed = (key) => low[key] + t * (high[key] - low[key]);
    return srgbOfOklab(mixed('lightness'), mixed('a'), mixed('b'));
});

const rampGradient = `linear-gradient(90deg, ${Array.from({ length: 33 }, (_, i) => `rgb(${ramp[Math.round(i * 255 / 32)]})`).join(', ')})`;

function colored(image) {
    const canvas = make('canvas', { width: image.naturalWidth, height: image.naturalHeight });
    const context = canvas.getContext('2d', { willReadFrequently: true });
    context.drawImage(image, 0, 0);
    const pixels = context.getImageData(0, 0, canvas.width, canvas.height);
    for (let i = 0; i < pixels.data.length; i += 4) pixels.data.set(ramp[pixels.data[i]], i);
    context.putImageData(pixels, 0, 0);
    return canvas;
}

/// Draws a picture or a map over a frame of `size` pixels whose corner is at (left, top), `scale`
/// screen pixels each. A value of a map that is coarser than the frame covers whole strata; the
/// last ones stand out and are cut off by the caller.
function drawFrame(context, drawable, size, left, top, scale) {
    const width = drawable.naturalWidth ?? drawable.width, height = drawable.naturalHeight ?? drawable.height;
    const stratum = Math.ceil(size[0] / width);
    context.imageSmoothingEnabled = scale < 1;
    context.imageSmoothingQuality = 'high';
    context.drawImage(drawable, left, top, width * stratum * scale, height * stratum * scale);
}

