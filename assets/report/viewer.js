// SPDX-License-Identifier: MIT
const layers = [
    { key: 'picture', label: 'Picture' },
    { key: 'error', label: 'Error', tip: 'FLIP: the difference from the reference that an eye sees',
        legend: ['FLIP', 'as the reference', 'as far off as can be'] },
    { key: 'lambda', label: '\u03bb found', tip: 'How much of the history was dropped, per stratum of 3 \u00d7 3 pixels',
        legend: ['\u03bb', 'nothing changed', 'all changed'] },
    { key: 'lambda_ideal', label: '\u03bb ideal', tip: 'How much really changed, from converged pictures',
        legend: ['\u03bb*', 'nothing changed', 'all changed'] },
    { key: 'alpha', label: '\u03b1 used', tip: 'The weight of the new sample',
        legend: ['\u03b1', 'keeps the history', 'takes the new sample'] },
    { key: 'alpha_ideal', label: '\u03b1 ideal', tip: 'The weight that would have left the least error. Above it samples are wasted, below it there are ghosts',
        legend: ['\u03b1*', 'keeps the history', 'takes the new sample'] },
];

/// Pictures of a run: two under a divider, and all of them in a row below.
class Viewer {
    constructor(run, cursor) {
        this.run = run;
        this.cursor = cursor;
        this.layer = 'picture';
        const whole = run.variants.filter((variant) => !variant.summary.sweep);
        const shown = whole.length ? whole : run.variants;
        this.sides = [shown[0].name, shown.length > 1 ? shown.at(-1).name : 'reference'];
        this.isNear = false;
        this.turn = 0; // counts drawings, so that a late picture does not replace a newer one
        this.stage = new Stage(run);
        this.root = make('div', { class: 'card viewer' }, this.toolbar(), this.sidePicker(), this.stage.root, this.legend(), this.transport());
        this.strip = this.makeStrip();
        cursor.onChange(() => this.show());
        for (const element of [this.root, this.strip]) {
            new IntersectionObserver(([entry]) => {
                this.isNear = this.isNear || entry.isIntersecting;
                if (entry.isIntersecting) this.show();
            }, { rootMargin: '300px' }).observe(element);
        }
        addEventListener('beforeprint', () => {
            this.isNear = true;
            this.show();
        });
        this.showPosition();
    }

    toolbar() {
        const there = layers.filter(({ key }) => this.run.variants.some((variant) => variant.images[key]));
        return make('div', { class: 'bar' },
            makeChips('Layer', `${this.run.id}-layer`, there.map(({ key, label, tip }) => ({ value: key, label, tip })), 'picture', (key) => {
                this.layer = key;
                this.show();
            }),
            makeChips('Zoom', `${this.run.id}-zoom`, [['1', 'Fit'], ['2', '2\u00d7'], ['4', '4\u00d7']]
                .map(([value, label]) => ({ value, label })), '1', (zoom) => this.stage.setZoom(Number(zoom))));
    }

    sidePicker() {
        const options = [...this.run.variants.map((variant) => variant.name), 'reference'].map((name) => ({ value: name, text: name }));
        const picker = (i, side) => {
            const select = makeSelect(`Picture on the ${side}`, options, this.sides[i], (name) => {
                this.sides[i] = name;
                this.show();
            });
            return select;
        };
        this.selects = [picker(0, 'left'), picker(1, 'right')];
        const swap = make('button', { type: 'button', class: 'quiet', 'aria-label': 'Swap left and right', click: () => {
            this.sides.reverse();
            this.selects.forEach((select, i) => (select.value = this.sides[i]));
            this.show();
        } }, '\u21c4');
        return make('div', { class: 'bar sides' }, this.selects[0], swap, this.selects[1]);
    }

    legend() {
        this.legendBox = make('div', { class: 'legend', hidden: true });
        return this.legendBox;
    }

    showLegend() {
        const legend = layers.find(({ key }) => key === this.layer).legend;
        this.legendBox.hidden = !legend;
        if (!legend) return;
        const [name, low, high] = legend;
        this.legendBox.replaceChildren(
            make('span', { class: 'legend-name' }, name),
            make('div', { class: 'ramp' },
                make('div', { class: 'ramp-bar', style: `background: ${rampGradient}` }),
                make('div', { class: 'ramp-ticks' }, ['0', '0.25', '0.5', '0.75', '1'].map((tick) => make('span', {}, tick))),
                make('div', { class: 'ramp-words' }, make('span', {}, low), make('span', {}, high))));
    }

    transport() {
        const { run, cursor } = this;
        const button = (label, text, click) => make('button', { type: 'button', class: 'round', 'aria-label': label, click }, text);
        this.playButton = button('Play', '\u25b6\ufe0e', () => this.togglePlay());
        this.slider = make('input', {
            type: 'range', min: 0, max: run.pictures.length - 1, step: 1, 'aria-label': `Frame of ${run.name}`,
            input: () => cursor.setIndex(Number(this.slider.value)),
        });
        this.position = make('output', { class: 'position' });
        const ticks = run.pictures.map((frame, i) => {
            const event = run.events.some((one) => one.frame <= frame && one.frame > (run.pictures[i - 1] ?? -1));
            return make('span', { class: event ? 'event' : null, style: `left: ${run.pictures.length > 1 ? 100 * i / (run.pictures.length - 1) : 0}%` });
        });
        return make('div', { class: 'bar transport' },
            make('div', { class: 'buttons' },
                button('Previous picture', '\u2039', () => this.step(-1)), this.playButton, button('Next picture', '\u203a', () => this.step(1))),
            make('div', { class: 'track' }, this.slider, make('div', { class: 'track-ticks', 'aria-hidden': 'true' }, ticks)),
            this.position);
    }

    step(by) {
        this.cursor.setIndex(this.cursor.index + by);
    }

    togglePlay() {
        if (this.timer) {
            clearInterval(this.timer);
            this.timer = null;
        } else {
            this.timer = setInterval(() => this.cursor.setIndex((this.cursor.index + 1) % this.run.pictures.length), 220);
        }
        this.playButton.setAttribute('aria-label', this.timer ? 'Pause' : 'Play');
        this.playButton.textContent = this.timer ? '\u275a\u275a' : '\u25b6\ufe0e';
    }

    makeStrip() {
        this.tiles = [...this.run.variants, null].map((variant) => {
            const canvas = make('canvas', { role: 'img', width: this.run.size[0], height: this.run.size[1] });
            const note = make('span', { class: 'note' });
            const tile = make('figure', { style: `--color: ${variant ? variant.textColor : 'var(--reference)'}` }, canvas,
                make('figcaption', {}, make('span', { class: 'name' }, variant ? variant.name : 'reference'), note));
            return { name: variant ? variant.name : 'reference', canvas, note, tile };
        });
        return make('div', { class: this.tiles.length > 8 ? 'strip many' : 'strip' }, this.tiles.map(({ tile }) => tile));
    }

    /// The number of a picture and how to show it; none if there is no such picture. What a
    /// reference is to a map is its ideal, that of the variant on the other side.
    source(name, other) {
        const variant = this.run.variants.find((one) => one.name === name);
        let key = this.layer, images = variant?.images;
        if (!variant) {
            images = this.run.referenceImages;
            if (key !== 'picture') {
                const ideal = { lambda: 'lambda_ideal', lambda_ideal: 'lambda_ideal', alpha: 'alpha_ideal', alpha_ideal: 'alpha_ideal' }[key];
                const owner = this.run.variants.find((one) => one.name === other && one.images[ideal]);
                images = owner?.images;
                key = ideal;
            }
        }
        const number = images?.[key]?.[this.cursor.index];
        const layer = layers.find((one) => one.key === key);
        const what = key === 'picture' ? '' : layer ? ` \u00b7 ${layer.label}` : '';
        const missing = number === undefined || number === null;
        return {
            number: missing ? null : number,
            asMap: key !== 'picture',
            label: name + (missing ? ` \u00b7 no ${layers.find((one) => one.key === this.layer).label}` : what),
            color: variant ? variant.textColor : 'var(--reference)',
        };
    }

    showPosition() {
        const frame = this.run.pictures[this.cursor.index];
        const text = frameText(this.run, frame);
        this.slider.value = this.cursor.index;
        this.slider.setAttribute('aria-valuetext', text);
        this.position.textContent = text;
        this.showLegend();
    }

    /// Draws when all pictures are there; at once where they have been decoded before.
    show() {
        this.showPosition();
        if (!this.isNear) return;
        const turn = ++this.turn;
        const sides = this.sides.map((name, i) => this.source(name, this.sides[1 - i]));
        const tiles = this.tiles.map(({ name }) => this.source(name, this.sides.find((side) => side !== 'reference')));
        const entries = [...sides, ...tiles].map(({ number, asMap }) => (number === null ? null : pictureOf(number, asMap)));
        const draw = () => {
            if (turn !== this.turn) return;
            this.stage.setSides(sides.map((side, i) => ({ ...side, drawable: entries[i]?.ready ?? null })));
            this.stage.setWipe(this.stage.wipe);
            this.tiles.forEach((tile, i) => this.drawTile(tile, tiles[i], entries[i + 2]?.ready ?? null));
            this.root.dataset.shown = `${this.layer} ${this.cursor.index} ${this.sides.join(' ')}`;
        };
        if (entries.every((entry) => !entry || entry.ready)) draw();
        else Promise.all(entries.filter(Boolean).map((entry) => entry.promise)).then(draw);
    }

    drawTile({ name, canvas, note, tile }, source, drawable) {
        const context = canvas.getContext('2d');
        context.clearRect(0, 0, canvas.width, canvas.height);
        if (drawable) drawFrame(context, drawable, this.run.size, 0, 0, 1);
        tile.classList.toggle('empty', !drawable);
        const frame = this.run.pictures[this.cursor.index];
        canvas.setAttribute('aria-label', `${source.label}, frame ${frame}`);
        const variant = this.run.variants.find((one) => one.name === name);
        const key = this.run.metricKeys.includes('flip') ? 'flip' : 'rmse';
        const value = variant && metricValue(variant, key, frame);
        if (drawable && this.layer === 'picture') note.textContent = typeof value === 'number' ? `${metricRow(key).label} ${shortNumber(value)}` : '';
        else note.textContent = source.label.split(' \u00b7 ')[1] ?? '';
    }
}

