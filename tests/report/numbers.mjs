// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { test } from 'node:test';
import { event, experiment, openReport, pictures, readJson, runFolder } from './support.mjs';

const summary = readJson('summary.json').variants, timing = readJson('timing.json').variants;
const names = experiment.experiment.variants.map(({ name }) => name);
const metrics = readFileSync(join(runFolder, 'metrics.csv'), 'utf8').trim().split('\n').slice(1).map((line) => line.split(','));
const metric = (variant, key, frame) => Number(metrics.find((row) => row[0] === variant && row[1] === String(frame) && row[2] === key)?.[3]);

/// Whether a text says this number, rounded to the digits that it shows.
function says(text, value) {
    const digits = (text.split('.')[1] ?? '').length;
    return Number.isFinite(Number(text)) && Math.abs(Number(text) - value) <= 0.5001 * 10 ** -digits;
}

test('the table says what summary.json and timing.json say', async () => {
    const page = await openReport();
    let compared = 0;
    for (const name of names) {
        const cells = await page.locator(`tr[data-variant="${name}"] td`).evaluateAll((all) =>
            all.map((cell) => [cell.dataset.key, cell.firstChild.textContent]));
        for (const [key, text] of cells) {
            const value = summary[name][key] ?? (key === 'ms_per_frame' ? timing[name][key] : null);
            assert.ok(value === null ? text === 'never' || text === '\u2013' : says(text, value), `${name} ${key}: ${text}, not ${value}`);
            if (value === null && typeof summary[name].ghost_frames === 'number' && /^t/.test(key)) assert.equal(text, 'never');
            ++compared;
        }
    }
    assert.ok(compared >= 10 * names.length, `${compared} cells`);
    assert.deepEqual(page.faults, []);
    await page.context().close();
});

test('the best of a column is marked, and only that', async () => {
    const page = await openReport();
    const marked = await page.locator('td[data-key="rmse_settled"].best').evaluateAll((cells) => cells.map((cell) => cell.parentElement.dataset.variant));
    const least = Math.min(...names.map((name) => summary[name].rmse_settled));
    assert.ok(marked.length > 0 && marked.length < names.length);
    for (const name of marked) assert.ok(summary[name].rmse_settled - least < 1e-4, name);
    await page.context().close();
});

test('the cursor of the curves and the slider of the pictures are one', async () => {
    const page = await openReport();
    const plot = page.getByRole('slider', { name: /curves/ }), slider = page.locator('.track input');
    const cursorFrame = () => page.locator('line.now').getAttribute('data-frame').then(Number);
    await page.locator('.chart input[value="all"]').check({ force: true });

    const box = await plot.boundingBox();
    await page.mouse.click(box.x + box.width * 0.25, box.y + box.height / 2);
    const clicked = await cursorFrame();
    assert.ok(clicked > 0.1 * experiment.experiment.frames && clicked < 0.3 * experiment.experiment.frames, `frame ${clicked}`);
    assert.equal(pictures[Number(await slider.inputValue())], pictures.findLast((frame) => frame <= clicked) ?? pictures[0]);

    await slider.focus();
    const before = await page.locator('line.now').getAttribute('x1');
    await page.keyboard.press('End');
    assert.equal(await cursorFrame(), pictures.at(-1));
    assert.ok(Number(await page.locator('line.now').getAttribute('x1')) > Number(before));

    await plot.focus();
    await page.keyboard.press('ArrowLeft');
    assert.equal(await cursorFrame(), pictures.at(-1) - 1);
    await page.getByRole('button', { name: experiment.events[0].text }).click();
    assert.equal(await cursorFrame(), event);
    assert.deepEqual(page.faults, []);
    await page.context().close();
});

test('the curves show the values of metrics.csv at the frame under the pointer', async () => {
    const page = await openReport();
    const plot = page.getByRole('slider', { name: /curves/ });
    await page.getByLabel(/Measure/).selectOption('rmse');
    const check = async (frame) => {
        for (const name of names) {
            const text = await page.locator('.entry', { hasText: new RegExp(`^\\s*${name}[^-\\w]|^${name}\\d`) }).first().locator('.value').innerText();
            const value = metric(name, 'rmse', frame);
            assert.ok(Math.abs(Number(text) - value) <= 0.0051 * Math.abs(value) + 1e-9, `${name}, frame ${frame}: ${text}, not ${value}`);
        }
    };
    await check(pictures.find((frame) => frame > event));
    const box = await plot.boundingBox();
    await page.mouse.move(box.x + box.width * 0.6, box.y + box.height / 2);
    const hovered = Number((await page.locator('.readout .at').innerText()).match(/frame (\d+)/)[1]);
    assert.ok(hovered > event);
    await check(hovered);

    // A curve is as high as its value: the greatest in view is the least y of its path.
    assert.equal(await page.locator('.curve').count(), names.length);
    await page.locator('.entry').first().click();
    assert.equal(await page.locator('.curve').count(), names.length - 1);
    assert.deepEqual(page.faults, []);
    await page.context().close();
});

test('all measures of metrics.csv can be chosen, and each draws', async () => {
    const page = await openReport();
    const select = page.getByLabel(/Measure/);
    const keys = await select.locator('option').evaluateAll((options) => options.map(({ value }) => value));
    assert.deepEqual([...keys].sort(), [...new Set(metrics.map((row) => row[2]))].sort());
    await page.locator('.chart input[value="all"]').check({ force: true });
    for (const key of keys) {
        await select.selectOption(key);
        const finite = metrics.some((row) => row[2] === key && Number.isFinite(Number(row[3])) && row[3] !== '');
        assert.equal(await page.locator('.curve[d*="M"]').count() > 0, finite, key);
    }
    assert.deepEqual(page.faults, []);
    await page.context().close();
});
