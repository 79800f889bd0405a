// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { alteredReport, openReport, readJson } from './support.mjs';

const summary = readJson('summary.json').variants;

/// Eleven experiments, as many as the program ships, with the pictures of the one.
const suite = () => alteredReport('suite.html', (data) => ({
    ...data,
    suite: true,
    runs: Array.from({ length: 11 }, (_, i) => {
        const run = structuredClone(data.runs[0]);
        run.run.experiment.name = `experiment ${i}`;
        return run;
    }),
}));

test('a suite opens with a table of experiments and variants whose cells lead to the sections', async () => {
    const page = await openReport({ file: suite() });
    const ready = await page.evaluate(() => performance.getEntriesByType('navigation')[0].domContentLoadedEventEnd);
    assert.ok(ready < 2000, `usable after ${ready} ms`); // 0.2 s on an idle machine
    const variants = Object.entries(summary).filter(([, own]) => !own.sweep);
    const cell = page.getByRole('link', { name: new RegExp(`^experiment 7, ${variants[0][0]}, t90`) });
    assert.equal(await cell.innerText(), String(variants[0][1].t90 ?? 'never'));
    await cell.click();
    await page.waitForFunction(() => Math.abs(document.querySelector('#e-experiment-7').getBoundingClientRect().top) < 120);
    await page.waitForFunction(() => document.querySelector('nav [aria-current]')?.textContent === 'experiment 7');
    await page.waitForSelector('#e-experiment-7 .viewer[data-shown]');
    assert.equal(await page.locator('#e-experiment-2 .viewer[data-shown]').count(), 0, 'nothing is decoded that was not looked at');
    assert.deepEqual(page.faults, []);
    await page.context().close();
});

test('a suite does not scroll sideways on a telephone', async () => {
    const page = await openReport({ file: suite(), size: [360, 740], hasTouch: true, isMobile: true });
    assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 360);
    assert.deepEqual(page.faults, []);
    await page.context().close();
});

test('a sweep draws a curve of noise against lag, with "never" on the upper edge', async () => {
    const file = alteredReport('sweep.html', (data) => {
        const [run] = data.runs;
        const base = run.run.experiment.variants[0].name;
        for (const [i, value] of [0.05, 0.1, 0.4].entries()) {
            const name = `${base}-alpha-${value}`;
            run.run.experiment.variants.push({ name, filter: base, settings: {} });
            for (const part of ['timing', 'metrics', 'images']) run[part][name] = run[part][base];
            run.summary[name] = { ...run.summary[base], t90: [null, 12, 4][i], ghost_frames: 8 / (i + 1), rmse_settled: 0.01 * (i + 1), sweep: { variant: base, key: 'alpha', value } };
        }
        return data;
    });
    const page = await openReport({ file });
    assert.deepEqual(await page.locator('td.never[data-key="t90"]').allInnerTexts(), ['never']);
    const plot = page.locator('.tradeoff .plot');
    await plot.scrollIntoViewIfNeeded();
    const label = await plot.getAttribute('aria-label');
    assert.match(label, /0\.05: never at 0\.0100; 0\.1: 12\.0 at 0\.0200; 0\.4: 4\.00 at 0\.0300/);
    const path = await plot.locator('.curve').getAttribute('d');
    const points = path.slice(1).split('L').map((point) => point.split(' ').map(Number));
    assert.equal(points.length, 3);
    assert.ok(points[0][0] < points[1][0] && points[1][0] < points[2][0], 'more noise lies to the right');
    assert.ok(points[0][1] < points[1][1] && points[1][1] < points[2][1], 'more lag lies above');
    await page.locator('.tradeoff input[value="ghost_frames"]').check({ force: true });
    assert.match(await plot.getAttribute('aria-label'), /0\.05: 8\.00 at 0\.0100/);
    assert.deepEqual(page.faults, []);
    await page.context().close();
});

test('names that look like HTML are shown as they are', async () => {
    const name = '<img src=x onerror=console.log(1)>';
    const page = await openReport({ file: alteredReport('names.html', (data) => {
        data.runs[0].run.experiment.name = name;
        data.runs[0].run.events[0].text = '</script><b>x';
        return data;
    }) });
    assert.equal(await page.locator('h1').innerText(), name);
    assert.match(await page.locator('.events').innerText(), /<\/script><b>x/);
    assert.deepEqual(page.faults, []);
    await page.context().close();
});
