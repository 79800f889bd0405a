// SPDX-License-Identifier: MIT
/// Three significant digits, without an exponent where it can be helped: 0.0104, 12.3, 1.25e-5.
function shortNumber(value) {
    if (value === 'inf' || value === Infinity) return '\u221e';
    if (value === '-inf' || value === -Infinity) return '\u2212\u221e';
    if (typeof value !== 'number' || !Number.isFinite(value)) return '\u2013';
    if (value === 0) return '0';
    const size = Math.abs(value);
    if (size < 1e-4) return value.toExponential(2);
    const digits = Math.max(0, Math.min(6, 2 - Math.floor(Math.log10(size))));
    return value.toFixed(digits);
}

/// For numbers that stand below each other.
const fixedDigits = (digits) => (value) => (typeof value === 'number' ? value.toFixed(digits).replace(/^-(0\.?0*)$/, '$1') : shortNumber(value));

/// The program's table of metrics, by key; readModel() fills it.
const metricRows = new Map();

/// The row of a metric. That of one signal, "shadows:lambda_rmse", has the signal before its label; one that the
/// program does not know has the words of its key.
function metricRow(key) {
    const [name, signal] = key.split(':').reverse();
    const row = metricRows.get(name) ?? { key: name, label: name.replaceAll('_', ' '), tip: '' };
    return signal ? { ...row, label: `${signal}: ${row.label}` } : row;
}

/// "t90, frames".
function labelWithUnit({ label, unit }) {
    return !unit || label.includes(unit) ? label : `${label}, ${unit}`;
}

/// Null says of a metric that it was never reached where another one, which goes with it, has a number.
function isNever(row, variant) {
    return summaryValue(variant, row) === null && typeof variant.summary[row.reached_if] === 'number';
}

function summaryText(row, variant) {
    return isNever(row, variant) ? 'never' : fixedDigits(row.digits)(summaryValue(variant, row) ?? null);
}

/// Rounds up to 1, 2 or 5 times a power of ten.
function niceStep(rough) {
    const power = 10 ** Math.floor(Math.log10(rough));
    return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= rough * 0.999);
}

/// About `count` round numbers from `low` to `high`.
function ticksBetween(low, high, count) {
    const step = niceStep((high - low) / Math.max(1, count));
    const ticks = [];
    for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; ++i) ticks.push(i * step);
    return ticks;
}

function tickText(value, ticks) {
    const step = ticks.length > 1 ? Math.abs(ticks[1] - ticks[0]) : Math.abs(value) || 1;
    return value === 0 ? '0' : value.toFixed(Math.max(0, Math.min(8, -Math.floor(Math.log10(step) + 1e-9))));
}
