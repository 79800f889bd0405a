// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { existsSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { choose, chooseLayer, difference, event, experiment, frameName, openReport, pictures, pngUri, referenceOf, runFolder, shown, stage } from './support.mjs';

const names = experiment.experiment.variants.map(({ name }) => name);
const [left, right] = [names[0], names.at(-1)];
const start = pictures.findIndex((frame) => frame > event); // the page opens just after the event

// A JPEG of quality 90 differs from its picture by 1 to 3 of 255 in the mean of noisy frames.
const same = 5;

test('the page opens on the picture after the event, the first variant to the left and the last to the right', async () => {
    const page = await openReport();
    await shown(page, `picture ${start} ${left} ${right}`);
    const of = (name) => pngUri(name, frameName(pictures[start]));
    const [own, other] = [await difference(page, stage, of(left), 0, 0.49), await difference(page, stage, of(right), 0, 0.49)];
    assert.ok(own < same && other > 2 * own, `to the left: ${own} from ${left}, ${other} from ${right}`);
    assert.ok(await difference(page, stage, of(right), 0.51, 1) < same);
    assert.deepEqual(page.faults, []);
    await page.context().close();
});

test('the slider moves the picture, by keyboard, by buttons and by playing', async () => {
    const page = await openReport();
    const slider = page.locator('.track input');
    const before = await page.locator('.stage').screenshot();
    await slider.focus();
    await page.keyboard.press('Home');
    await shown(page, `picture 0 ${left} ${right}`);
    assert.notDeepEqual(await page.locator('.stage').screenshot(), before, 'other pixels are seen');
    assert.ok(await difference(page, stage, pngUri(left, frameName(pictures[0])), 0, 0.49) < same);
    await page.keyboard.press('ArrowRight');
    await shown(page, `picture 1 ${left} ${right}`);
    await page.getByRole('button', { name: 'Next picture' }).click();
    await shown(page, `picture 2 ${left} ${right}`);
    assert.match(await slider.getAttribute('aria-valuetext'), new RegExp(`frame ${pictures[2]} `));
    await page.getByRole('button', { name: 'Previous picture' }).click();
    await shown(page, `picture 1 ${left} ${right}`);
    await page.getByRole('button', { name: 'Play' }).click();
    await shown(page, `picture 3 ${left} ${right}`);
    await page.getByRole('button', { name: 'Pause' }).click();
    const box = await slider.boundingBox();
    await page.mouse.click(box.x + box.width - 4, box.y + box.height / 2);
    await shown(page, `picture ${pictures.length - 1} ${left} ${right}`);
    assert.deepEqual(page.faults, []);
    await page.context().close();
});

test('the divider wipes between any two sources, by mouse and by keyboard', async () => {
    const page = await openReport();
    await choose(page, 'Picture on the left', 'reference');
    await choose(page, 'Picture on the right', left);
    await shown(page, `picture ${start} reference ${left}`);
    const reference = pngUri('reference', referenceOf(pictures[start])), frame = pngUri(left, frameName(pictures[start]));
    const box = await page.locator('.stage').boundingBox();
    const divider = page.getByRole('slider', { name: /Divider/ });

    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width * 0.8, box.y + box.height / 2, { steps: 4 });
    await page.mouse.up();
    assert.equal(await divider.getAttribute('aria-valuenow'), '80');
    assert.ok(await difference(page, stage, reference, 0, 0.79) < same);
    assert.ok(await difference(page, stage, frame, 0.81, 1) < same);

    await divider.focus();
    await page.keyboard.press('ArrowLeft');
    assert.equal(await divider.getAttribute('aria-valuenow'), '78');
    await page.keyboard.press('Home');
    assert.equal(await divider.getAttribute('aria-valuenow'), '0');
    assert.ok(await difference(page, stage, frame) < same, 'all of it is the right picture');
    await page.keyboard.press('End');
    assert.ok(await difference(page, stage, reference) < same, 'all of it is the left picture');
    assert.match(await divider.getAttribute('aria-valuetext'), /100 %: reference to the left/);

    await page.getByRole('button', { name: 'Swap left and right' }).click();
    await shown(page, `picture ${start} ${left} reference`);
    assert.ok(await difference(page, stage, frame) < same);
    assert.deepEqual(page.faults, []);
    await page.context().close();
});

test('maps are shown in the colors of the legend, values per stratum as exact squares', async () => {
    const page = await openReport();
    const map = ['lambda', 'alpha', 'error'].find((key) => existsSync(join(runFolder, right, 'maps', frameName(pictures[start], key))));
    assert.ok(map, 'the run has maps');
    await chooseLayer(page, map);
    await shown(page, `${map} ${start} ${left} ${right}`);
    await page.getByRole('slider', { name: /Divider/ }).focus();
    await page.keyboard.press('Home');
    const worst = await page.evaluate(async ([uri, frameWidth]) => {
        const image = new Image();
        image.src = uri;
        await image.decode();
        const draw = new OffscreenCanvas(image.width, image.height).getContext('2d', { willReadFrequently: true });
        draw.drawImage(image, 0, 0);
        const canvas = document.querySelector('.stage canvas'), seen = window.copyOf(canvas);
        const stratum = Math.ceil(frameWidth / image.width), scale = canvas.width / frameWidth;
        const bar = document.querySelector('.ramp-bar');
        const stops = getComputedStyle(bar).backgroundImage.match(/rgb\([^)]*\)/g).map((text) => text.match(/\d+/g).map(Number));
        let largest = 0;
        for (let y = 0; y < image.height - 1; ++y) {
            for (let x = 0; x < image.width - 1; ++x) {
                const value = draw.getImageData(x, y, 1, 1).data[0] / 255 * (stops.length - 1);
                const low = Math.min(stops.length - 2, Math.floor(value));
                const color = seen.getImageData((x + 0.5) * stratum * scale, (y + 0.5) * stratum * scale, 1, 1).data;
                for (let c = 0; c < 3; ++c) {
                    const expected = stops[low][c] + (value - low) * (stops[low + 1][c] - stops[low][c]);
                    largest = Math.max(largest, Math.abs(expected - color[c]));
                }
            }
        }
        return largest;
    }, [pngUri(right, 'maps', frameName(pictures[start], map)), experiment.experiment.size[0]]);
    // Between its stops the legend is straight, and its colors are rounded; a map as large as the frame is a JPEG.
    assert.ok(worst <= (map === 'error' ? 40 : 6), `off by ${worst}`);
    assert.equal(await page.locator('.ramp-ticks').innerText().then((text) => text.replace(/\s+/g, ' ')), '0 0.25 0.5 0.75 1');
    await chooseLayer(page, 'picture');
    assert.ok(await page.locator('.legend').isHidden());
    assert.deepEqual(page.faults, []);
    await page.context().close();
});

test('every variant and the reference stand in the strip, at the frame of the slider', async () => {
    const page = await openReport();
    await page.locator('.track input').focus();
    await page.keyboard.press('End');
    await shown(page, `picture ${pictures.length - 1} ${left} ${right}`);
    assert.deepEqual(await page.locator('.strip .name').allInnerTexts(), [...names, 'reference']);
    for (const [i, name] of names.entries()) {
        const tile = `.strip figure:nth-child(${i + 1}) canvas`;
        assert.ok(await difference(page, tile, pngUri(name, frameName(pictures.at(-1)))) < same, name);
    }
    assert.ok(await difference(page, '.strip figure:last-child canvas', pngUri('reference', referenceOf(pictures.at(-1)))) < same);
    await page.context().close();
});

test('a zoomed picture shows whole pixels, and the arrow keys move it', async () => {
    const page = await openReport();
    await shown(page, `picture ${start} ${left} ${right}`);
    await page.locator('.viewer input[value="4"]').check({ force: true });
    const look = () => page.evaluate((frameWidth) => {
        const canvas = document.querySelector('.stage canvas');
        const { data } = window.copyOf(canvas).getImageData(0, canvas.height >> 1, canvas.width, 1);
        let changes = 0;
        for (let i = 4; i < data.length; i += 4) changes += data[i] !== data[i - 4] || data[i + 1] !== data[i - 3] || data[i + 2] !== data[i - 2];
        return { changes, row: [...data].join(), pixels: frameWidth / 4 };
    }, experiment.experiment.size[0]);
    const before = await look();
    assert.ok(before.changes > 4 && before.changes <= before.pixels + 2, `${before.changes} edges among ${before.pixels} pixels`);
    await page.locator(stage).focus();
    for (let i = 0; i < 4; ++i) await page.keyboard.press('ArrowRight');
    assert.notEqual((await look()).row, before.row);
    assert.deepEqual(page.faults, []);
    await page.context().close();
});
