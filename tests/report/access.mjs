// SPDX-License-Identifier: MIT
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { openReport } from './support.mjs';

/// What can be reached by Tab: of radio buttons of one name, the chosen one.
const tabStops = `(() => [...document.querySelectorAll('a[href], button, select, input, summary, [tabindex="0"]')]
    .filter((one) => one.checkVisibility() && !(one.type === 'radio' && !one.checked)))()`;

test('the Tab key walks through every control, and what is focused shows it', async () => {
    const page = await openReport();
    await page.evaluate(`window.stops = ${tabStops}; window.reached = new Set(); window.unseen = []`);
    const count = await page.evaluate(() => window.stops.length);
    assert.ok(count > 25, `${count} controls`);
    for (let i = 0; i < count + 4; ++i) {
        await page.keyboard.press('Tab');
        await page.evaluate(() => {
            const one = document.activeElement;
            window.reached.add(one);
            if (one === document.body) return;
            const shows = [one, one.nextElementSibling, one.firstElementChild].some((part) => part
                && getComputedStyle(part).outlineStyle !== 'none' && parseFloat(getComputedStyle(part).outlineWidth) >= 2);
            if (!shows) window.unseen.push(one.outerHTML.slice(0, 100));
        });
    }
    assert.deepEqual(await page.evaluate(() => window.stops.filter((one) => !window.reached.has(one)).map((one) => one.outerHTML.slice(0, 100))), []);
    assert.deepEqual(await page.evaluate(() => window.unseen), []);
    assert.deepEqual(page.faults, []);
    await page.context().close();
});

test('every control has a name', async () => {
    const page = await openReport();
    const nameless = await page.evaluate(`${tabStops}.filter((one) => !(one.getAttribute('aria-label') || one.innerText?.trim()
        || one.labels?.length)).map((one) => one.outerHTML.slice(0, 120))`);
    assert.deepEqual(nameless, []);
    await page.context().close();
});

test('a heading of the table says what it means, at the focus and under the pointer', async () => {
    const page = await openReport();
    const heading = page.locator('.explained', { hasText: /^t90$/ });
    await heading.focus();
    assert.match(await page.getByRole('tooltip').innerText(), /90 %/);
    await page.keyboard.press('Escape');
    assert.ok(await page.locator('#tip').isHidden());
    await page.locator('.explained', { hasText: 'SSIM' }).or(page.locator('.explained').last()).first().hover();
    assert.ok(await page.getByRole('tooltip').isVisible());
    await page.context().close();
});

for (const [size, options] of [[[360, 740], { hasTouch: true, isMobile: true }], [[768, 1024], {}], [[1400, 900], {}]]) {
    test(`a page ${size[0]} pixels wide does not scroll sideways, and its letters and controls are large enough`, async () => {
        const page = await openReport({ size, ...options });
        await page.evaluate(() => document.querySelectorAll('details').forEach((one) => (one.open = true)));
        assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= size[0]);
        const small = await page.evaluate(() => [...document.querySelectorAll('#page *')].filter((one) => one.checkVisibility()
            && [...one.childNodes].some((node) => node.nodeType === 3 && node.data.trim()) && parseFloat(getComputedStyle(one).fontSize) < 13)
            .map((one) => `${one.className} ${one.textContent.slice(0, 30)}`));
        assert.deepEqual(small, []);
        const least = size[0] < 600 ? 38 : 26;
        const tight = await page.evaluate((least) => [...document.querySelectorAll('#page button, #page select, #page summary, .chips span, .divider')]
            .filter((one) => one.checkVisibility()).map((one) => [one.outerHTML.slice(0, 80), one.getBoundingClientRect()])
            .filter(([, box]) => box.height < least || box.width < 24).map(([text, box]) => `${text}: ${box.width} x ${box.height}`), least);
        assert.deepEqual(tight, []);
        assert.deepEqual(page.faults, []);
        await page.context().close();
    });
}

for (const colorScheme of ['light', 'dark']) {
    test(`texts stand out from what is behind them, ${colorScheme}`, async () => {
        const page = await openReport({ colorScheme });
        await page.evaluate(() => document.querySelectorAll('details').forEach((one) => (one.open = true)));
        const faint = await page.evaluate(() => {
            const context = new OffscreenCanvas(1, 1).getContext('2d', { willReadFrequently: true });
            /// The color that layers of colors make, the last on top.
            const painted = (layers) => {
                context.clearRect(0, 0, 1, 1);
                for (const color of layers) {
                    context.fillStyle = color;
                    context.fillRect(0, 0, 1, 1);
                }
                return [...context.getImageData(0, 0, 1, 1).data].slice(0, 3);
            };
            const luminance = (color) => color.map((c) => c / 255).map((c) => (c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4))
                .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
            const results = [];
            for (const one of document.querySelectorAll('#page *')) {
                const hasText = [...one.childNodes].some((node) => node.nodeType === 3 && node.data.trim());
                if (!hasText || !one.checkVisibility() || one.closest('.unseen')) continue;
                const behind = [];
                for (let part = one; part; part = part.parentElement) behind.unshift(getComputedStyle(part).backgroundColor);
                const style = getComputedStyle(one);
                const color = one instanceof SVGElement ? style.fill : style.color;
                const [a, b] = [luminance(painted([...behind, color])), luminance(painted(behind))].sort((x, y) => y - x);
                if ((a + 0.05) / (b + 0.05) < 4.5) results.push(`${one.className?.baseVal ?? one.className} "${one.textContent.slice(0, 24)}": ${((a + 0.05) / (b + 0.05)).toFixed(2)}`);
            }
            return results;
        });
        assert.deepEqual(faint, []);
        await page.context().close();
    });
}
