// SPDX-License-Identifier: MIT
'use strict';

/// Makes an element. Functions among the attributes listen; what is null or false is left out.
function make(tag, attributes = {}, ...children) {
    return filled(document.createElement(tag), attributes, children);
}

function makeSvg(tag, attributes = {}, ...children) {
    return filled(document.createElementNS('http://www.w3.org/2000/svg', tag), attributes, children);
}

function filled(element, attributes, children) {
    for (const [name, value] of Object.entries(attributes)) {
        if (typeof value === 'function') element.addEventListener(name, value);
        else if (value === true) element.setAttribute(name, '');
        else if (value !== null && value !== undefined && value !== false) element.setAttribute(name, value);
    }
    element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined));
    return element;
}

/// Radio buttons in the shape of chips. `choices`: { value, label, tip }. Arrow keys come with them.
function makeChips(legend, name, choices, chosen, onChoice) {
    return make('fieldset', { class: 'chips' },
        make('legend', { class: 'unseen' }, legend),
        choices.map(({ value, label, tip }) => make('label', { 'data-tip': tip },
            make('input', { type: 'radio', name, value, checked: value === chosen, change: () => onChoice(value) }),
            make('span', {}, label))));
}

function makeSelect(label, options, chosen, onChoice) {
    const select = make('select', { 'aria-label': label, change: () => onChoice(select.value) },
        options.map(({ value, text }) => make('option', { value, selected: value === chosen }, text)));
    return select;
}

/// A table in a box of its own that scrolls sideways where the page is narrow.
function makeTable(label, head, rows) {
    return make('div', { class: 'scroller', role: 'region', 'aria-label': label, tabindex: 0 },
        make('table', {}, make('thead', {}, head), make('tbody', {}, rows)));
}

/// Calls `draw(width, height)` now and whenever the size of the element changes.
function onResize(element, draw) {
    let last = '';
    new ResizeObserver(() => {
        const size = `${element.clientWidth} ${element.clientHeight}`;
        if (size === last || element.clientWidth === 0) return;
        last = size;
        draw();
    }).observe(element);
}

/// One bubble for all texts in data-tip, under the pointer or at the focus. Escape closes it.
function startTips() {
    const bubble = document.getElementById('tip');
    let owner = null;
    const hide = () => {
        owner?.removeAttribute('aria-describedby');
        owner = null;
        bubble.hidden = true;
    };
    const place = () => {
        if (!owner) return;
        const box = owner.getBoundingClientRect(), own = bubble.getBoundingClientRect();
        const left = Math.max(8, Math.min(box.left, document.documentElement.clientWidth - own.width - 8));
        const top = box.bottom + own.height + 10 < innerHeight ? box.bottom + 6 : box.top - own.height - 6;
        bubble.style.transform = `translate(${Math.round(left)}px, ${Math.round(top)}px)`;
    };
    const show = (target) => {
        const next = target.closest?.('[data-tip]');
        if (next === owner) return;
        hide();
        if (!next) return;
        owner = next;
        bubble.textContent = owner.dataset.tip;
        bubble.hidden = false;
        owner.setAttribute('aria-describedby', 'tip');
        place();
    };
    document.addEventListener('pointerover', (event) => show(event.target));
    document.addEventListener('focusin', (event) => show(event.target));
    document.addEventListener('focusout', hide);
    document.addEventListener('scroll', place, { capture: true, passive: true });
    document.addEventListener('keydown', (event) => event.key === 'Escape' && hide());
}

