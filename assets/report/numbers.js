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

/// Times after an event. Without a step that could be measured there is nothing that never came.
function framesText(value, summary) {
    if (typeof value === 'number') return String(Math.round(value * 100) / 100);
    return neverHappened(value, summary) ? 'never' : '\u2013';
}

function neverHappened(value, summary) {
    return value === null && typeof summary.ghost_frames === 'number';
}

/// Only for the times of the response: null elsewhere says that nothing was measured.
function isNever(column, variant) {
    return /^(lag_)?(t\d+|frames)$|^ghost_frames$/.test(column.key) && neverHappened(summaryValue(variant, column), variant.summary);
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

/// The columns of the table of variants, in reading order. `best`: which end is better.
const summaryColumns = [
    { key: 't50', label: 't50', group: 'Response', best: 'low', text: framesText,
        tip: 'Frames from the event, whose own is 0, until half of the change has arrived, to stay.' },
    { key: 't90', label: 't90', group: 'Response', best: 'low', text: framesText,
        tip: 'Frames from the event until 90 % of the change has arrived, to stay.' },
    { key: 't99', label: 't99', group: 'Response', best: 'low', text: framesText,
        tip: 'Frames from the event until 99 % of the change has arrived, to stay. "never" may be bias and not lag: see lag t90.' },
    { key: 'lag_t90', label: 'lag t90', group: 'Response', best: 'low', text: framesText,
        tip: 'As t90, but measured against where this filter itself settles: lag without bias.' },
    { key: 'ghost_frames', label: 'ghost', group: 'Response', best: 'low', text: fixedDigits(2),
        tip: 'Ghost frames: the area above the response curve. How many frames\u2019 worth of old light is left.' },
    { key: 'lag_frames', label: 'lag frames', group: 'Response', best: 'low', text: fixedDigits(2),
        tip: 'The same area between where this filter settles before and after: lag without bias.' },
    { key: 'trail_response', label: 'trail', group: 'Response', best: 'high', text: fixedDigits(3), insteadOf: 'ghost_frames',
        tip: 'How much of what changed in the last 16 frames has arrived; 1 is all. Noise hardly moves it.' },
    { key: 'ghost_energy', label: 'ghost energy', group: 'Response', best: 'low', text: fixedDigits(3), insteadOf: 'ghost_frames',
        tip: 'Old light that is left along the trail, as a part of all that changed.' },
    { key: 'recovery_frames', label: 'recovery', group: 'Response', best: 'low', text: (value) => (typeof value === 'number' ? String(value) : '\u2013'),
        tip: 'Frames from the end of the change until the error is no more than a tenth above what it settles at.' },
    { key: 'noise_after_event', label: 'noise after', group: 'Error', best: 'low', text: fixedDigits(4),
        tip: 'RMSE in the frames after the event, without the part that is lag.' },
    { key: 'rmse_moving', label: 'RMSE moving', group: 'Error', best: 'low', text: fixedDigits(4),
        tip: 'Root of the mean squared error of linear color, while something moves.' },
    { key: 'rmse_settled', label: 'RMSE', group: 'Error', best: 'low', text: fixedDigits(4),
        tip: 'Root of the mean squared error of linear color, in settled frames.' },
    { key: 'flip_settled', label: 'FLIP', group: 'Error', best: 'low', text: fixedDigits(4),
        tip: 'The difference from the reference that an eye sees when it flips between the two; 0 is none. Settled frames.' },
    { key: 'ssim_settled', label: 'SSIM', group: 'Error', best: 'high', text: fixedDigits(4),
        tip: 'Structural similarity to the reference; 1 is the same. Settled frames.' },
    { key: 'flicker', label: 'flicker', group: 'Error', best: 'low', text: fixedDigits(4),
        tip: 'Standard deviation over time of a pixel while nothing changes, averaged over pixels.' },
    { key: 'lambda_false', label: '\u03bb false', group: 'Error', best: 'low', text: fixedDigits(4),
        tip: 'False alarms: the part of the history that was dropped where nothing had changed, mean over all frames.' },
    { key: 'ms_per_frame', label: 'ms', group: 'Cost', best: 'low', text: fixedDigits(1), timing: true,
        tip: 'Milliseconds a frame, median. Of this machine; counts only beside the others.' },
];

const metricTexts = {
    response: { label: 'Response', tip: '0 old light, 1 new' },
    rmse: { label: 'RMSE', tip: 'error of linear color' },
    relmse: { label: 'relMSE', tip: 'squared error over squared reference' },
    psnr: { label: 'PSNR', tip: 'decibels, more is better' },
    ssim: { label: 'SSIM', tip: '1 is the same as the reference' },
    flip: { label: 'FLIP', tip: 'difference that an eye sees' },
    temporal_error: { label: 'Temporal error', tip: 'error of the change from frame to frame' },
    flicker: { label: 'Flicker', tip: 'standard deviation over time, of the settled frames' },
    noise: { label: 'Noise', tip: 'RMSE without the part that is lag' },
    ghost_energy: { label: 'Ghost energy', tip: 'old light along the trail' },
    trail_response: { label: 'Trail response', tip: '0 old light, 1 new, along the trail' },
    response_before: { label: 'Response before', tip: 'where a filter stands before the change' },
    lambda_mean: { label: '\u03bb mean', tip: 'share of the history that is dropped' },
    lambda_ideal_mean: { label: '\u03bb ideal, mean', tip: 'share of the light that changed' },
    lambda_false: { label: '\u03bb false', tip: 'history dropped where nothing changed' },
    lambda_bias: { label: '\u03bb bias', tip: '\u03bb found minus \u03bb ideal, mean' },
    lambda_rmse: { label: '\u03bb RMSE', tip: '\u03bb found against \u03bb ideal' },
    lambda_precision: { label: '\u03bb precision', tip: 'of what is called changed, how much did' },
    lambda_recall: { label: '\u03bb recall', tip: 'of what changed, how much is called so' },
    alpha_mean: { label: '\u03b1 mean', tip: 'weight of the new sample' },
    alpha_ideal_mean: { label: '\u03b1 ideal, mean', tip: 'weight that would leave the least error' },
    alpha_bias: { label: '\u03b1 bias', tip: '\u03b1 used minus \u03b1 ideal, mean' },
    alpha_rmse: { label: '\u03b1 RMSE', tip: '\u03b1 used against \u03b1 ideal' },
    gradient_samples: { label: 'Gradient samples', tip: 'points of the last frame that are shaded again' },
    rays: { label: 'Rays', tip: 'traced in a frame' },
    invalid_values: { label: 'Invalid values', tip: 'values that are not numbers; 0 is right' },
};

function metricText(key) {
    const words = key.replaceAll('_', ' ');
    return metricTexts[key] ?? { label: words.charAt(0).toUpperCase() + words.slice(1), tip: '' };
}

