// SPDX-License-Identifier: MIT
/// The curves of a run over its frames. The box is a slider: pointer and arrow keys move the frame.
class Chart {
    constructor(run, cursor) {
        this.run = run;
        this.cursor = cursor;
        this.metric = ['response', 'trail_response', 'rmse'].find((key) => run.metricKeys.includes(key)) ?? run.metricKeys[0];
        this.hidden = new Set();
        this.hover = null; // the frame under the pointer
        const { frame: event, end } = run.events[0] ?? {};
        this.near = event === undefined ? null : [Math.max(0, event - 6), Math.min(run.frames - 1, Math.max(event + 42, (end ?? event) + 30))];
        this.range = this.near ? 'near' : 'all';

        this.title = make('span', { class: 'chart-tip' });
        this.plot = make('div', {
            class: 'plot', tabindex: 0, role: 'slider', 'aria-label': `Frame in the curves of ${run.name}`,
            'aria-valuemin': 0, 'aria-valuemax': run.frames - 1,
        });
        this.readout = make('div', { class: 'readout' });
        this.entries = run.variants.map((variant) => this.entry(variant));
        this.at = make('span', { class: 'at' });
        this.readout.append(...this.entries.map(({ button }) => button), this.at);
        this.root = make('div', { class: 'card chart' }, this.toolbar(), this.plot, this.readout);
        this.listen();
        cursor.onChange(() => this.draw());
        onResize(this.plot, () => this.draw());
    }

    toolbar() {
        const metrics = this.run.metricKeys.map((key) => ({ value: key, text: metricRow(key).label }));
        return make('div', { class: 'bar' },
            makeSelect(`Measure of ${this.run.name}`, metrics, this.metric, (key) => {
                this.metric = key;
                this.draw();
            }), this.title,
            this.near && makeChips('Frames', `${this.run.id}-range`,
                [{ value: 'near', label: 'Event' }, { value: 'all', label: 'All' }], this.range, (range) => {
                    this.range = range;
                    this.draw();
                }));
    }

    entry(variant) {
        const value = make('span', { class: 'value' });
        const button = make('button', {
            type: 'button', class: 'entry', 'aria-pressed': 'true', style: `--color: ${variant.color}; --text: ${variant.textColor}`,
            'data-tip': 'Shows or hides this curve',
            click: () => {
                if (!this.hidden.delete(variant.name)) this.hidden.add(variant.name);
                button.setAttribute('aria-pressed', String(!this.hidden.has(variant.name)));
                this.draw();
            },
        }, lineSample(variant), make('span', { class: 'name' }, variant.name), value);
        return { variant, button, value };
    }

    listen() {
        const frameAt = (event) => {
            const x = event.clientX - this.plot.getBoundingClientRect().left;
            return Math.max(this.first, Math.min(this.last, Math.round(this.frameOf(x))));
        };
        let held = false;
        this.plot.addEventListener('pointerdown', (event) => {
            held = true;
            this.plot.setPointerCapture(event.pointerId);
            this.cursor.set(frameAt(event));
        });
        this.plot.addEventListener('pointermove', (event) => {
            if (held) this.cursor.set(frameAt(event));
            this.hover = event.pointerType === 'mouse' ? frameAt(event) : null;
            this.showHover();
        });
        for (const end of ['pointerup', 'pointercancel']) this.plot.addEventListener(end, () => (held = false));
        this.plot.addEventListener('pointerleave', () => {
            this.hover = null;
            this.showHover();
        });
        this.plot.addEventListener('keydown', (event) => {
            const now = this.cursor.frame, step = event.shiftKey ? 10 : 1;
            const to = {
                ArrowLeft: now - step, ArrowDown: now - step, ArrowRight: now + step, ArrowUp: now + step,
                PageDown: now - 10, PageUp: now + 10, Home: this.first, End: this.last,
            }[event.key];
            if (to === undefined) return;
            this.cursor.set(to);
            event.preventDefault();
        });
    }

    frameOf(x) {
        return this.first + (x - this.left) / (this.width - this.left - this.right) * (this.last - this.first);
    }

    xOf(frame) {
        return this.left + (frame - this.first) / Math.max(1, this.last - this.first) * (this.width - this.left - this.right);
    }

    yOf(value) {
        return this.top + (this.high - value) / (this.high - this.low) * (this.height - this.top - this.bottom);
    }

    shown() {
        return this.run.variants.filter((variant) => !this.hidden.has(variant.name) && variant.metrics[this.metric]);
    }

    /// The values in view decide the range, so that small ones are not lost beside large ones.
    measure() {
        [this.first, this.last] = this.range === 'near' ? this.near : [0, this.run.frames - 1];
        const values = this.shown().flatMap((variant) => {
            const { first, values: all } = variant.metrics[this.metric];
            return all.filter((value, i) => Number.isFinite(value) && first + i >= this.first && first + i <= this.last);
        });
        this.isResponse = /(^|_)response$/.test(this.metric);
        let low = Math.min(...values), high = Math.max(...values);
        if (!values.length) [low, high] = [0, 1];
        if (this.isResponse) [low, high] = [Math.min(0, low), Math.max(1, high)];
        else if (metricRow(this.metric).unit !== 'dB') low = Math.min(0, low);
        if (high <= low) high = low + 1;
        const margin = this.isResponse ? 0.03 : 0.06;
        this.high = high + margin * (high - low);
        this.low = low === 0 ? 0 : low - margin * (high - low);
        this.any = values.length > 0;
    }

    draw() {
        this.width = this.plot.clientWidth;
        this.height = this.plot.clientHeight;
        if (this.width === 0) return;
        this.measure();
        Object.assign(this, { left: 44, right: this.isResponse ? 40 : 14, top: 26, bottom: 40 });
        this.title.textContent = metricRow(this.metric).tip;
        const clip = `${this.run.id}-clip`;
        this.svg = makeSvg('svg', { width: this.width, height: this.height, 'aria-hidden': 'true' },
            makeSvg('clipPath', { id: clip }, makeSvg('rect', {
                x: this.left, y: this.top - 3, width: Math.max(0, this.width - this.left - this.right), height: this.height - this.top - this.bottom + 6,
            })),
            this.grid(), this.eventLines(),
            makeSvg('g', { 'clip-path': `url(#${clip})` }, this.shown().map((variant) => this.curve(variant))),
            this.isResponse && this.metric === 'response' ? this.adaptedMarks() : [],
            this.any ? [] : makeSvg('text', { x: this.width / 2, y: this.height / 2, class: 'tick', 'text-anchor': 'middle' }, 'no values here'));
        this.cursorLine = makeSvg('g', { class: 'cursor' });
        this.svg.append(this.cursorLine);
        this.plot.replaceChildren(this.svg);
        this.showHover();
    }

    grid() {
        const parts = [];
        const ys = ticksBetween(this.low, this.high, this.height / 60);
        for (const y of ys) {
            parts.push(makeSvg('line', { class: 'grid', x1: this.left, x2: this.width - this.right, y1: this.yOf(y), y2: this.yOf(y) }),
                makeSvg('text', { class: 'tick', x: this.left - 8, y: this.yOf(y) + 4, 'text-anchor': 'end' }, tickText(y, ys)));
        }
        if (this.isResponse) {
            for (const level of [0.5, 0.9, 0.99]) {
                const y = this.yOf(level);
                parts.push(makeSvg('line', { class: 'level', x1: this.left, x2: this.width - this.right, y1: y, y2: y }),
                    makeSvg('text', { class: 'tick', x: this.width - this.right + 6, y: y + (level === 0.9 ? 9 : level === 0.99 ? 0 : 4) }, `${100 * level}%`));
            }
        }
        const xs = ticksBetween(this.first, this.last, this.width / 80).filter(Number.isInteger);
        for (const x of xs) {
            parts.push(makeSvg('text', { class: 'tick', x: this.xOf(x), y: this.height - this.bottom + 18, 'text-anchor': 'middle' }, x));
        }
        parts.push(makeSvg('text', { class: 'tick axis', x: this.width - this.right, y: this.height - 5, 'text-anchor': 'end' }, 'frame'));
        return parts;
    }

    eventLines() {
        let free = -Infinity; // where the last label ends
        return this.run.events.filter(({ frame }) => frame >= this.first && frame <= this.last).map(({ frame, end, text }) => {
            const x = this.xOf(frame), label = text.length > 26 ? text.slice(0, 25) + '\u2026' : text;
            const parts = [makeSvg('line', { class: 'event', x1: x, x2: x, y1: this.top - 4, y2: this.height - this.bottom })];
            if (Number.isInteger(end) && end - frame > 1) {
                parts.unshift(makeSvg('rect', { class: 'event-span', x, width: this.xOf(Math.min(end, this.last)) - x, y: this.top, height: this.height - this.bottom - this.top }));
            }
            const room = label.length * 7;
            const atEnd = x + room > this.width;
            if ((atEnd ? x - room : x) > free) {
                parts.push(makeSvg('text', { class: 'event', x: atEnd ? x + 2 : x - 2, y: this.top - 10, 'text-anchor': atEnd ? 'end' : 'start' }, label));
                free = x + (atEnd ? 0 : room) + 10;
            }
            return makeSvg('g', {}, parts);
        });
    }

    curve(variant) {
        const { first, values } = variant.metrics[this.metric];
        let path = '', pen = false;
        values.forEach((value, i) => {
            const frame = first + i;
            if (!Number.isFinite(value) || frame < this.first - 1 || frame > this.last + 1) {
                pen = false;
                return;
            }
            path += `${pen ? 'L' : 'M'}${this.xOf(frame).toFixed(1)} ${this.yOf(value).toFixed(1)}`;
            if (!pen && !Number.isFinite(values[i + 1])) path += 'h0.01'; // a lone value is a dot
            pen = true;
        });
        return makeSvg('path', { class: 'curve', d: path, style: `stroke: ${variant.color}${variant.summary.sweep ? '; stroke-width: 1.5' : ''}`, 'stroke-dasharray': variant.dash, 'data-variant': variant.name });
    }

    /// A dot at the frame from which the response stays above 90 %, with a label below it and free of
    /// the other labels.
    adaptedMarks() {
        if (this.run.variants.length > 6) return []; // a thicket
        const event = this.run.events[0]?.frame;
        const marks = this.shown().filter(({ summary }) => typeof summary.t90 === 'number')
            .map((variant) => ({ variant, frame: event + variant.summary.t90, value: metricValue(variant, 'response', event + variant.summary.t90) }))
            .filter(({ frame, value }) => Number.isFinite(value) && frame >= this.first && frame <= this.last)
            .sort((a, b) => a.frame - b.frame);
        const taken = [];
        return marks.flatMap(({ variant, frame, value }) => {
            const label = `${variant.name} t90 ${variant.summary.t90}`, room = 7.6 * label.length;
            const x = this.xOf(frame), atEnd = x + 10 + room > this.width - this.right;
            const left = atEnd ? x - 8 - room : x + 8;
            let y = this.yOf(value) + 22;
            for (const other of taken) if (left < other.left + other.room && other.left < left + room) y = Math.max(y, other.y + 17);
            taken.push({ left, room, y });
            return [
                makeSvg('circle', { class: 'mark', cx: x, cy: this.yOf(value), r: 4.5, style: `fill: ${variant.color}` }),
                makeSvg('text', { class: 'mark-text', x: atEnd ? x - 8 : left, y, 'text-anchor': atEnd ? 'end' : 'start', style: `fill: ${variant.textColor}` }, label),
            ];
        });
    }

    /// The line and the values at the frame under the pointer, else at the cursor.
    showHover() {
        if (!this.svg) return;
        const frame = this.hover ?? this.cursor.frame;
        const lines = [];
        const line = (at, kind) => {
            if (at < this.first || at > this.last) return;
            const x = this.xOf(at);
            lines.push(makeSvg('line', { class: kind, x1: x, x2: x, y1: this.top, y2: this.height - this.bottom, 'data-frame': at }));
            if (kind === 'now') lines.push(makeSvg('path', { class: 'handle', d: `M${x} ${this.height - this.bottom}l-5 7h10z` }));
        };
        line(this.cursor.frame, 'now');
        if (this.hover !== null && this.hover !== this.cursor.frame) line(this.hover, 'hover');
        for (const variant of this.shown()) {
            const value = metricValue(variant, this.metric, frame);
            if (Number.isFinite(value) && frame >= this.first && frame <= this.last) {
                lines.push(makeSvg('circle', { class: 'value-dot', cx: this.xOf(frame), cy: this.yOf(value), r: 3.5, style: `fill: ${variant.color}` }));
            }
        }
        this.cursorLine.replaceChildren(...lines);

        const texts = this.entries.map(({ variant, value }) => {
            const shown = shortNumber(metricValue(variant, this.metric, frame) ?? null);
            value.textContent = shown;
            return `${variant.name} ${shown}`;
        });
        this.at.textContent = frameText(this.run, frame);
        this.plot.setAttribute('aria-valuenow', this.cursor.frame);
        this.plot.setAttribute('aria-valuetext', `${frameText(this.run, this.cursor.frame)}: ${metricRow(this.metric).label}, ${texts.join(', ')}`);
    }
}

/// A short piece of a variant's line, for legends.
function lineSample(variant) {
    return makeSvg('svg', { width: 22, height: 10, 'aria-hidden': 'true', class: 'sample' },
        makeSvg('line', { x1: 1, x2: 21, y1: 5, y2: 5, style: `stroke: ${variant.color}`, 'stroke-dasharray': variant.dash }));
}

