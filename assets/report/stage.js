// SPDX-License-Identifier: MIT
/// Two pictures on top of each other: the left one up to the divider, the right one from there on.
class Stage {
    constructor(run) {
        this.size = run.size;
        this.wipe = 0.5;
        this.zoom = 1;
        this.center = [0.5, 0.5]; // of the view, as a part of the frame
        this.sides = [{ drawable: null, label: '' }, { drawable: null, label: '' }];

        this.canvas = make('canvas', { role: 'img', class: 'frame' });
        this.divider = make('div', {
            class: 'divider', role: 'slider', tabindex: 0, 'aria-label': `Divider between the two pictures of ${run.name}`,
            'aria-orientation': 'horizontal', 'aria-valuemin': 0, 'aria-valuemax': 100,
        }, make('span', { class: 'grip', 'aria-hidden': 'true' }));
        this.labels = ['left', 'right'].map((side) => make('span', { class: `corner ${side}`, 'aria-hidden': 'true' }));
        this.root = make('div', { class: 'stage', style: `aspect-ratio: ${run.size[0]} / ${run.size[1]}` },
            this.canvas, this.labels, this.divider);
        this.listen();
        onResize(this.root, () => this.draw());
        this.setWipe(0.5);
    }

    /// Each side: { drawable, label, color }; a drawable may be null.
    setSides(sides) {
        this.sides = sides;
        this.draw();
    }

    setWipe(part) {
        this.wipe = Math.max(0, Math.min(1, part));
        const percent = Math.round(100 * this.wipe);
        this.divider.style.left = `${100 * this.wipe}%`;
        this.divider.setAttribute('aria-valuenow', percent);
        this.divider.setAttribute('aria-valuetext',
            `${percent} %: ${this.sides[0].label} to the left, ${this.sides[1].label} to the right`);
        this.draw();
    }

    setZoom(zoom) {
        this.zoom = zoom;
        this.root.classList.toggle('zoomed', zoom > 1);
        if (zoom > 1) this.canvas.tabIndex = 0;
        else this.canvas.removeAttribute('tabindex');
        this.panBy(0, 0);
    }

    /// In parts of the frame.
    panBy(x, y) {
        const reach = 0.5 / this.zoom;
        this.center = [this.center[0] + x, this.center[1] + y].map((c) => Math.max(reach, Math.min(1 - reach, c)));
        this.draw();
    }

    draw() {
        const ratio = devicePixelRatio || 1;
        const width = Math.round(this.root.clientWidth * ratio), height = Math.round(this.root.clientHeight * ratio);
        if (width === 0) return;
        if (this.canvas.width !== width || this.canvas.height !== height) Object.assign(this.canvas, { width, height });
        const context = this.canvas.getContext('2d');
        context.clearRect(0, 0, width, height);
        const scale = this.zoom * width / this.size[0];
        const left = width / 2 - this.center[0] * this.size[0] * scale;
        const top = height / 2 - this.center[1] * this.size[1] * scale;
        const edge = Math.round(this.wipe * width);
        this.sides.forEach(({ drawable }, i) => {
            if (!drawable) return;
            context.save();
            context.beginPath();
            context.rect(i ? edge : 0, 0, i ? width - edge : edge, height);
            context.clip();
            context.beginPath();
            context.rect(left, top, this.size[0] * scale, this.size[1] * scale);
            context.clip();
            drawFrame(context, drawable, this.size, left, top, scale);
            context.restore();
        });
        this.labels.forEach((element, i) => {
            element.textContent = this.sides[i].label;
            element.style.setProperty('--color', this.sides[i].color ?? 'var(--reference)');
        });
        this.canvas.setAttribute('aria-label', `${this.sides[0].label} on the left, ${this.sides[1].label} on the right`
            + (this.zoom > 1 ? '; arrow keys move the view' : ''));
    }

    listen() {
        let grip = null; // what the pointer holds: { pan, x, y }
        this.root.addEventListener('pointerdown', (event) => {
            if (event.button !== 0) return;
            const onDivider = this.divider.contains(event.target);
            grip = { pan: this.zoom > 1 && !onDivider, x: event.clientX, y: event.clientY };
            this.root.setPointerCapture(event.pointerId);
            if (!grip.pan) {
                this.wipeTo(event);
                this.divider.focus({ preventScroll: true });
                event.preventDefault();
            }
        });
        this.root.addEventListener('pointermove', (event) => {
            if (!grip) return;
            if (!grip.pan) {
                this.wipeTo(event);
                return;
            }
            const box = this.root.getBoundingClientRect();
            this.panBy((grip.x - event.clientX) / (box.width * this.zoom), (grip.y - event.clientY) / (box.height * this.zoom));
            Object.assign(grip, { x: event.clientX, y: event.clientY });
        });
        for (const end of ['pointerup', 'pointercancel']) this.root.addEventListener(end, () => (grip = null));

        this.divider.addEventListener('keydown', (event) => {
            const step = event.shiftKey ? 0.1 : 0.02;
            const to = {
                ArrowLeft: this.wipe - step, ArrowDown: this.wipe - step, ArrowRight: this.wipe + step, ArrowUp: this.wipe + step,
                PageDown: this.wipe - 0.1, PageUp: this.wipe + 0.1, Home: 0, End: 1,
            }[event.key];
            if (to === undefined) return;
            this.setWipe(to);
            event.preventDefault();
        });
        this.canvas.addEventListener('keydown', (event) => {
            const step = 0.1 / this.zoom;
            const by = { ArrowLeft: [-step, 0], ArrowRight: [step, 0], ArrowUp: [0, -step], ArrowDown: [0, step] }[event.key];
            if (!by) return;
            this.panBy(...by);
            event.preventDefault();
        });
    }

    wipeTo(event) {
        const box = this.root.getBoundingClientRect();
        this.setWipe((event.clientX - box.left) / box.width);
    }
}

