// SPDX-License-Identifier: MIT
/// The data of the page in the shape in which it is drawn.

const namedSeries = { fixed: 1, svgf: 2, asvgf: 3 };
const otherSeries = [4, 5, 6, 7, 8];
const seriesOfOthers = new Map();

/// A variant has one color on the whole page. Those of a sweep share the color of what is swept.
function seriesOf(name) {
    if (namedSeries[name]) return namedSeries[name];
    if (!seriesOfOthers.has(name)) seriesOfOthers.set(name, otherSeries[seriesOfOthers.size % otherSeries.length]);
    return seriesOfOthers.get(name);
}

/// Dashes tell curves apart where they lie on each other, and without color.
const dashes = { 1: '', 2: '7 5', 3: '', 4: '2 4', 5: '10 4 2 4', 6: '1 3', 7: '12 4', 8: '4 2' };

function readModel() {
    const data = JSON.parse(document.getElementById('data').textContent);
    for (const row of data.metrics) metricRows.set(row.key, row);
    const ids = new Set();
    const runs = data.runs.map((one) => {
        let id = 'e-' + one.run.experiment.name.replace(/[^\w-]+/g, '-');
        while (ids.has(id)) id += '-2';
        ids.add(id);
        return readRun(one, id);
    });
    return { suite: data.suite, runs };
}

function readRun({ run, summary, timing, metrics, images }, id) {
    const experiment = run.experiment;
    const sweeps = new Map();
    const variants = experiment.variants.map((variant) => {
        const own = summary[variant.name];
        const series = seriesOf(own.sweep ? own.sweep.variant : variant.name);
        let fade = 0;
        if (own.sweep) {
            const count = (sweeps.get(own.sweep.variant) ?? 0) + 1;
            sweeps.set(own.sweep.variant, count);
            fade = Math.min(55, 10 * count);
        }
        return {
            name: variant.name,
            changed: variant.settings ?? {},
            color: fade ? `color-mix(in oklab, var(--series-${series}), var(--card) ${fade}%)` : `var(--series-${series})`,
            textColor: `var(--series-${series})`,
            dash: own.sweep ? '3 3' : dashes[series],
            summary: own,
            timing: timing[variant.name],
            metrics: metrics[variant.name],
            images: images[variant.name],
            settings: run.settings?.[variant.name] ?? {},
        };
    });
    const metricKeys = [...new Set(variants.flatMap((variant) => Object.keys(variant.metrics)))];
    return {
        id,
        name: experiment.name,
        description: experiment.description ?? '',
        size: experiment.size,
        frames: experiment.frames,
        experiment,
        about: run,
        events: run.events,
        pictures: run.pictures,
        references: run.references,
        variants,
        referenceImages: images.reference,
        metricKeys: [...metricRows.keys()].filter((key) => metricKeys.includes(key))
            .concat(metricKeys.filter((key) => !metricRows.has(key))),
    };
}

/// The value of a metric of runs for a variant; undefined if it was not measured.
function summaryValue(variant, row) {
    return (row.timing ? variant.timing : variant.summary)[row.key];
}

function metricValue(variant, metric, frame) {
    const series = variant.metrics[metric];
    return series ? series.values[frame - series.first] : undefined;
}

/// The frame that a run is looked at in. Its slider and its chart move it together.
class Cursor {
    constructor(run) {
        this.run = run;
        this.listeners = [];
        const event = run.events[0]?.frame;
        const after = run.pictures.find((frame) => frame > event) ?? run.pictures.at(-1);
        this.frame = event === undefined ? run.pictures[Math.floor(run.pictures.length / 2)] : after;
    }

    /// The picture that is shown at this frame: the last one until then.
    get index() {
        return Math.max(0, this.run.pictures.findLastIndex((frame) => frame <= this.frame));
    }

    set(frame) {
        this.frame = Math.max(0, Math.min(this.run.frames - 1, Math.round(frame)));
        for (const listener of this.listeners) listener();
    }

    setIndex(index) {
        this.set(this.run.pictures[Math.max(0, Math.min(this.run.pictures.length - 1, index))]);
    }

    onChange(listener) {
        this.listeners.push(listener);
    }
}

/// "frame 68, +4": counted from the last event until then.
function frameText(run, frame) {
    const event = run.events.findLast((one) => one.frame <= frame) ?? run.events[0];
    if (!event) return `frame ${frame}`;
    const after = frame - event.frame;
    return `frame ${frame} (${after < 0 ? '\u2212' : '+'}${Math.abs(after)})`;
}

/// { "temporal.alpha": 0.2, ... } of nested objects.
function flattened(settings, prefix = '') {
    return Object.entries(settings).flatMap(([key, value]) =>
        value !== null && typeof value === 'object' && !Array.isArray(value)
            ? flattened(value, `${prefix}${key}.`)
            : [[prefix + key, value]]);
}

