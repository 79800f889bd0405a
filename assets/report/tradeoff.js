// SPDX-License-Identifier: MIT
const lagMeasures = ['t90', 'lag_frames', 'ghost_frames'];

/// What is swept trades noise for lag: a curve for each filter, closer to the corner is better.
class TradeOff {
    constructor(run) {
        this.run = run;
        this.measures = lagMeasures.map(metricRow).filter(({ key }) => run.variants.some((variant) => Number.isFinite(variant.summary[key])));
        this.key = this.measures[0]?.key;
        const keys = [...new Set(run.variants.flatMap((variant) => variant.summary.sweep?.key ?? []))];
        this.plot = make('div', { class: 'plot', role: 'img' });
        const names = [...new Set(run.variants.map((variant) => variant.summary.sweep?.variant ?? variant.name))];
        this.legend = make('p', { class: 'hint names' }, names.flatMap((name) => [
            make('span', { class: 'dot', 'aria-hidden': 'true', style: `--color: var(--series-${seriesOf(name)})` }),
            make('span', { style: `color: var(--series-${seriesOf(name)})` }, name, ' \u2003')]));
        this.root = make('div', { class: 'card tradeoff' },
            make('div', { class: 'bar' }, make('h3', {}, 'Noise against lag'),
                makeChips('Lag as', `${run.id}-lag`, this.measures.map(({ key, label }) => ({ value: key, label })), this.key, (key) => {
                    this.key = key;
                    this.draw();
                })),
            this.plot, this.legend,
            make('p', { class: 'hint' }, `Each curve is one filter with other values of ${keys.join(', ')}. Closer to the lower left corner is better; what never adapts lies on the upper edge.`));
        onResize(this.plot, () => this.draw());
    }

    /// Curves of points { x, y, variant, text }; y is null if it never happened.
    curves() {
        const byName = new Map();
        for (const variant of this.run.variants) {
            const { sweep, rmse_settled: x, [this.key]: y } = variant.summary;
            const never = isNever(metricRow(this.key), variant);
            if (!Number.isFinite(x) || !(Number.isFinite(y) || never)) continue;
            const name = sweep ? sweep.variant : variant.name;
            const point = { x, y: never ? null : y, variant, value: sweep?.value ?? null, text: sweep ? String(sweep.value) : variant.name };
            byName.set(name, [...(byName.get(name) ?? []), point]);
        }
        return [...byName].map(([name, points]) => ({ name, points: points.sort((a, b) => (Number.isFinite(Number(a.value)) ? a.value - b.value : String(a.value).localeCompare(b.value))) }));
    }

    draw() {
        const width = this.plot.clientWidth, height = this.plot.clientHeight;
        if (width === 0) return;
        const curves = this.curves(), points = curves.flatMap((curve) => curve.points);
        const left = 46, right = 24, top = 34, bottom = 48;
        const xHigh = Math.max(...points.map(({ x }) => x), 1e-9) * 1.08, yHigh = Math.max(...points.map(({ y }) => y ?? 0), 1) * 1.12;
        const xOf = (x) => left + x / xHigh * (width - left - right);
        // By square roots: a frame more matters less where there are many.
        const yOf = (y) => (y === null ? top - 12 : top + (1 - Math.sqrt(y / yHigh)) * (height - top - bottom));
        const xs = ticksBetween(0, xHigh, width / 110);
        const ys = [...new Set([...ticksBetween(0, yHigh / 10, 4), ...ticksBetween(0, yHigh, 4)])];
        const { label } = metricRow(this.key);
        const parts = [
            ...ys.flatMap((y) => [makeSvg('line', { class: 'grid', x1: left, x2: width - right, y1: yOf(y), y2: yOf(y) }),
                makeSvg('text', { class: 'tick', x: left - 8, y: yOf(y) + 4, 'text-anchor': 'end' }, String(Number(y.toFixed(2))))]),
            ...xs.map((x) => makeSvg('text', { class: 'tick', x: xOf(x), y: height - bottom + 20, 'text-anchor': 'middle' }, tickText(x, xs))),
            makeSvg('text', { class: 'tick axis', x: width - right, y: height - 8, 'text-anchor': 'end' }, 'settled RMSE \u2192'),
            makeSvg('text', { class: 'tick axis', x: 0, y: 12 }, `\u2191 ${labelWithUnit(metricRow(this.key))}`),
        ];
        if (points.some(({ y }) => y === null)) {
            parts.push(makeSvg('line', { class: 'level', x1: left, x2: width - right, y1: yOf(null), y2: yOf(null) }),
                makeSvg('text', { class: 'tick', x: width - right, y: yOf(null) - 8, 'text-anchor': 'end' }, 'never'));
        }
        const placed = []; // of labels, so that none hides another
        const isFree = (x, y) => placed.every((other) => Math.abs(other.x - x) > 34 || Math.abs(other.y - y) > 13);
        for (const { name, points: own } of curves) {
            const series = seriesOf(name), color = `var(--series-${series})`;
            const swept = own.filter(({ value }) => value !== null);
            const path = swept.map(({ x, y }, i) => `${i ? 'L' : 'M'}${xOf(x).toFixed(1)} ${yOf(y).toFixed(1)}`).join('');
            if (swept.length > 1) parts.push(makeSvg('path', { class: 'curve', d: path, style: `stroke: ${color}`, 'stroke-dasharray': dashes[series] }));
            for (const { x, y, text, value } of own) {
                parts.push(makeSvg('circle', { class: 'mark', cx: xOf(x), cy: yOf(y), r: value === null ? 6 : 4.5, style: y === null ? `fill: var(--card); stroke: ${color}` : `fill: ${color}` },
                    makeSvg('title', {}, `${name} ${text}`)));
                const place = [[8, -8], [8, 16], [-34, -8], [-34, 16]].map(([dx, dy]) => ({ x: xOf(x) + dx, y: yOf(y) + (y === null ? 18 : dy) }))
                    .find((spot) => isFree(spot.x, spot.y) && spot.y < height - bottom + 14);
                if (!place) continue;
                placed.push(place);
                parts.push(makeSvg('text', { class: 'mark-text', x: place.x, y: place.y, style: `fill: ${color}` }, text));
            }
        }
        this.plot.setAttribute('aria-label', `${label} over settled RMSE. ` + curves.map(({ name, points: own }) =>
            `${name}: ${own.map(({ x, y, text }) => `${text}: ${y === null ? 'never' : shortNumber(y)} at ${shortNumber(x)}`).join('; ')}`).join('. '));
        this.plot.replaceChildren(makeSvg('svg', { width, height, 'aria-hidden': 'true' }, parts));
    }
}

