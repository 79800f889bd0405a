// SPDX-License-Identifier: MIT
// Usage: node docs/report_picture.mjs PAGE.html PICTURE.png [HEADING]    (after third_party/install.sh --tests)
// What a page of a report shows first, or the card with a heading.
import path from 'node:path';
import { chromium } from '../tests/report/node_modules/playwright-core/index.mjs';

const [page, picture] = process.argv.slice(2, 4).map((name) => path.resolve(name));
const heading = process.argv[4];
const browser = await chromium.launch({
    executablePath: '/usr/bin/chromium',
    args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update', '--disable-sync'],
});
const context = await browser.newContext({ viewport: { width: 1400, height: 1120 }, colorScheme: 'dark' });
const tab = await context.newPage();
await tab.goto(`file://${page}`);
await tab.waitForTimeout(1500);
await (heading ? tab.locator('.card', { has: tab.getByRole('heading', { name: heading }) }) : tab).screenshot({ path: picture });
await browser.close();
