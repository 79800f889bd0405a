// SPDX-License-Identifier: MIT
// The run that is tested, the browser, and how a page is looked at.
import { execFileSync } from 'node:child_process';
import { existsSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { chromium } from 'playwright-core';

const scratch = mkdtempSync(join(tmpdir(), 'afterglow-report-'));

// AFTERGLOW_REPORT_RUN is the folder of a finished run; without it the program makes a small one.
export const runFolder = process.env.AFTERGLOW_REPORT_RUN ?? makeRun();

function makeRun() {
    const program = process.env.AFTERGLOW_BIN;
    if (!program) throw new Error('AFTERGLOW_BIN must name the program, or AFTERGLOW_REPORT_RUN the folder of a run');
    const folder = join(scratch, 'run');
    execFileSync(program, ['experiment', 'fill-light', '--size', '96x54', '--spp', '64', '--context', process.env.AFTERGLOW_CONTEXT ?? 'osmesa', '--out', folder],
        { stdio: ['ignore', 'ignore', 'inherit'] });
    return folder;
}

export const readJson = (file) => JSON.parse(readFileSync(join(runFolder, file), 'utf8'));
export const experiment = readJson('experiment.json');
export const pictures = experiment.pictures;
export const event = experiment.events[0].frame;
export const [width, height] = experiment.experiment.size;
export const reportFile = join(runFolder, 'report.html');

export const pngUri = (...path) => `data:image/png;base64,${readFileSync(join(runFolder, ...path)).toString('base64')}`;
export const frameName = (frame, stem = 'frame') => `${stem}_${String(frame).padStart(4, '0')}.png`;
export const referenceOf = (frame) => frameName(experiment.references.find(({ first, end }) => first <= frame && frame < end).first);

/// A report whose data are those of the run after `change`.
export function alteredReport(name, change) {
    const page = readFileSync(reportFile, 'utf8');
    const [whole, text] = page.match(/<script type="application\/json" id="data">(.*?)<\/script>/s);
    const data = change(JSON.parse(text)) ?? JSON.parse(text);
    const file = join(scratch, name);
    writeFileSync(file, page.replace(whole, () => whole.replace(text, () => JSON.stringify(data).replaceAll('<', '\\u003c'))));
    return file;
}

let browser = null;
const chromes = [process.env.AFTERGLOW_CHROMIUM, '/usr/bin/chromium', '/usr/bin/chromium-browser'];

/// Opens a report from its file. `page.faults` gathers what must stay empty: messages of the console,
/// exceptions, and requests for anything but the file itself.
export async function openReport({ file = reportFile, size = [1400, 900], ...options } = {}) {
    browser ??= await chromium.launch({
        executablePath: chromes.find((path) => path && existsSync(path)),
        args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking',
            '--disable-component-update', '--disable-sync'],
    });
    const context = await browser.newContext({ viewport: { width: size[0], height: size[1] }, reducedMotion: 'reduce', ...options });
    context.setDefaultTimeout(5000);
    const page = await context.newPage();
    page.faults = [];
    page.on('console', (message) => page.faults.push(`console: ${message.text()}`));
    page.on('pageerror', (error) => page.faults.push(`exception: ${error.stack}`));
    const address = pathToFileURL(file).href;
    page.on('request', (request) => {
        if (!request.url().startsWith('data:') && request.url() !== address) page.faults.push(`request: ${request.url()}`);
    });
    await page.addInitScript(installCopy);
    await page.goto(address);
    await page.waitForSelector(file === reportFile ? '.viewer[data-shown]' : '.viewer', { state: 'attached' });
    return page;
}

export async function closeBrowser() {
    await browser?.close();
    rmSync(scratch, { recursive: true, force: true });
}

/// Reading back the canvas of the page itself would change how the browser keeps it, and it says so.
const installCopy = () => {
    window.copyOf = (canvas) => {
        const copy = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true });
        copy.drawImage(canvas, 0, 0);
        return copy;
    };
};

/// Waits until the viewer shows this: "picture 7 fixed asvgf".
export const shown = (page, what) => page.waitForFunction((text) => document.querySelector('.viewer').dataset.shown === text, what);

/// The mean difference, 0 to 255 a channel, between a part of the canvas (from x = `from` to `to`, as
/// parts of its width) and a picture drawn as large as the whole frame.
export function difference(page, selector, uri, from = 0, to = 1) {
    return page.evaluate(async ([canvasSelector, source, low, high]) => {
        const canvas = document.querySelector(canvasSelector);
        const image = new Image();
        image.src = source;
        await image.decode();
        const expected = new OffscreenCanvas(canvas.width, canvas.height).getContext('2d', { willReadFrequently: true });
        expected.imageSmoothingEnabled = false;
        expected.drawImage(image, 0, 0, canvas.width, canvas.height);
        const x = Math.ceil(low * canvas.width), columns = Math.floor(high * canvas.width) - x;
        const [a, b] = [window.copyOf(canvas), expected].map((context) => context.getImageData(x, 0, columns, canvas.height).data);
        let sum = 0;
        for (let i = 0; i < a.length; ++i) sum += i % 4 === 3 ? 0 : Math.abs(a[i] - b[i]);
        return sum / (a.length / 4 * 3);
    }, [selector, uri, from, to]);
}

export const choose = (page, label, value) => page.getByLabel(label, { exact: true }).selectOption(value);
export const chooseLayer = (page, key) => page.locator(`.viewer input[value="${key}"]`).check({ force: true });
export const stage = '.stage canvas';
