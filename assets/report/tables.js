// SPDX-License-Identifier: MIT
/// The best of a column: the variants that show the same text as the best value. None where all do,
/// or where there is nothing to compare with.
function bestOf(run, column) {
    const measured = run.variants.map((variant) => ({ variant, value: summaryValue(variant, column) }))
        .filter(({ value }) => typeof value === 'number');
    const known = measured.length + run.variants.filter((variant) => isNever(column, variant)).length;
    if (!measured.length || known < 2) return new Set();
    const sign = column.better === 'high' ? -1 : 1;
    const text = ({ variant }) => summaryText(column, variant);
    const best = measured.reduce((a, b) => (sign * Math.abs(b.value) < sign * Math.abs(a.value) ? b : a));
    const winners = measured.filter((one) => text(one) === text(best));
    return winners.length === known ? new Set() : new Set(winners.map(({ variant }) => variant.name));
}

function makeVariantTable(run) {
    const measured = (key) => run.variants.some((variant) => typeof variant.summary[key] === 'number');
    const shown = [...metricRows.values()].filter((row) => row.group && !measured(row.instead_of)
        && run.variants.some((variant) => typeof summaryValue(variant, row) === 'number' || isNever(row, variant)));
    const groups = [...new Set(shown.map(({ group }) => group))];
    const columns = groups.flatMap((group) => shown.filter((row) => row.group === group));
    const startsGroup = (column, i) => i === 0 || columns[i - 1].group !== column.group;
    const head = [
        make('tr', { class: 'groups' }, make('td', {}), groups.map((group) =>
            make('th', { scope: 'colgroup', colspan: columns.filter((column) => column.group === group).length, class: 'starts' }, group))),
        make('tr', {}, make('th', { scope: 'col', class: 'first' }, make('span', { class: 'unseen' }, 'variant')), columns.map((column, i) =>
            make('th', { scope: 'col', class: startsGroup(column, i) ? 'starts' : null },
                make('button', { type: 'button', class: 'explained', 'data-tip': column.tip }, column.label)))),
    ];
    const best = new Map(columns.map((column) => [column.key, bestOf(run, column)]));
    const rows = run.variants.map((variant) => make('tr', { 'data-variant': variant.name },
        make('th', { scope: 'row', class: 'first', style: `--color: ${variant.color}; --text: ${variant.textColor}` },
            make('span', { class: 'dot', 'aria-hidden': 'true' }), variant.name),
        columns.map((column, i) => {
            const isBest = best.get(column.key).has(variant.name);
            const kind = [startsGroup(column, i) && 'starts', isBest && 'best', isNever(column, variant) && 'never'];
            return make('td', { class: kind.filter(Boolean).join(' ') || null, 'data-key': column.key },
                make('span', {}, summaryText(column, variant)), isBest ? make('span', { class: 'unseen' }, ' (best)') : null);
        })));
    return make('div', { class: 'card' }, make('h3', {}, 'In numbers'), makeTable(`Numbers of ${run.name}`, head, rows),
        make('p', { class: 'hint' }, 'Times in frames from the event. ', make('b', {}, 'Bold'), ' is the best of a column; a heading says what it means.'));
}

function valueText(value) {
    if (value === null || value === undefined) return '\u2013';
    return typeof value === 'object' ? JSON.stringify(value) : String(value);
}

function makeFacts(facts) {
    return make('dl', { class: 'facts-list' }, Object.entries(facts).filter(([, value]) => value !== undefined && value !== null)
        .flatMap(([name, value]) => [make('dt', {}, name.replaceAll('_', ' ')), make('dd', {}, valueText(value))]));
}

/// Settings as rows, variants as columns; those that differ stand first.
function makeSettings(run) {
    const variants = run.variants.filter((variant) => Object.keys(variant.settings).length); // another program's are not known
    const flat = variants.map((variant) => new Map(flattened(variant.settings)));
    const keys = [...new Set(flat.flatMap((settings) => [...settings.keys()]))];
    if (!keys.length) return null;
    const differs = (key) => new Set(flat.map((settings) => valueText(settings.get(key)))).size > 1;
    const head = make('tr', {}, make('th', { scope: 'col', class: 'first' }, 'setting'),
        variants.map((variant) => make('th', { scope: 'col' }, variant.name)));
    const rowsOf = (some) => some.map((key) => make('tr', {}, make('th', { scope: 'row', class: 'first' }, key),
        flat.map((settings) => make('td', {}, valueText(settings.get(key))))));
    const different = keys.filter(differs), same = keys.filter((key) => !differs(key));
    return make('details', {}, make('summary', {}, 'Settings', make('span', { class: 'count' }, `${different.length} differ`)),
        different.length ? makeTable(`Settings of ${run.name} that differ`, head.cloneNode(true), rowsOf(different)) : null,
        same.length ? [make('h4', {}, 'The same in all variants'), makeFacts(Object.fromEntries(same.map((key) => [key, flat[0].get(key)])))] : null);
}

function makeReferences(run) {
    if (!run.references.length) return null;
    const most = Math.max(...run.references.map(({ residual_rmse: residual }) => residual ?? 0));
    const head = make('tr', {}, ['frames', 'samples a pixel', 'own error (RMSE)'].map((text, i) =>
        make('th', { scope: 'col', class: i ? null : 'first' }, text)));
    return make('details', {},
        make('summary', {}, 'References', make('span', { class: 'count' }, `${run.references.length}, own error at most ${shortNumber(most)}`)),
        makeTable(`References of ${run.name}`, head, run.references.map(({ first, end, samples, residual_rmse: residual }) =>
            make('tr', {}, make('th', { scope: 'row', class: 'first' }, end - first > 1 ? `${first} \u2013 ${end - 1}` : first),
                make('td', {}, valueText(samples)), make('td', {}, shortNumber(residual))))));
}

function makePasses(run) {
    const names = [...new Set(run.variants.flatMap((variant) => Object.keys(variant.timing.pass_ms_median ?? {})))];
    if (!names.length) return null;
    const head = make('tr', {}, make('th', { scope: 'col', class: 'first' }, 'pass'), run.variants.map(({ name }) => make('th', { scope: 'col' }, name)));
    const rows = names.map((name) => make('tr', {}, make('th', { scope: 'row', class: 'first' }, name), run.variants.map((variant) =>
        make('td', {}, fixedDigits(2)(variant.timing.pass_ms_median?.[name] ?? null)))));
    return make('details', {}, make('summary', {}, 'Time in passes', make('span', { class: 'count' }, 'milliseconds a frame, median')),
        makeTable(`Time in passes of ${run.name}`, head, rows));
}

function makeMachine(run) {
    const { about } = run;
    return make('details', {}, make('summary', {}, 'How it was run', make('span', { class: 'count' }, [about.program, about.version].filter(Boolean).join(' '))),
        makeFacts({ program: [about.program, about.version].filter(Boolean).join(' '), commit: about.commit, measured: about.measured,
            'settled frames': about.settled_window && `${about.settled_window[0]} \u2013 ${about.settled_window[1] - 1}` }),
        about.machine ? [make('h4', {}, 'Machine'), makeFacts(about.machine)] : null,
        about.gl ? [make('h4', {}, 'OpenGL'), makeFacts(about.gl)] : null,
        about.scene ? [make('h4', {}, 'Scene'), makeFacts(about.scene)] : null);
}

/// Experiments down, variants across, for the measures one looks at first.
function makeOverview(runs) {
    const columns = [...metricRows.values()].filter((row) => row.shown.includes('overview')
        && runs.some((run) => run.variants.some((variant) => variant.summary[row.key] !== undefined)));
    const inAll = (run) => run.variants.filter((variant) => !variant.summary.sweep);
    const names = [...new Set(runs.flatMap((run) => inAll(run).map(({ name }) => name)))];
    const most = new Map(columns.map(({ key }) => [key, Math.max(...runs.flatMap((run) =>
        inAll(run).map((variant) => variant.summary[key]).filter(Number.isFinite)), 1e-9)]));
    const head = [
        make('tr', { class: 'groups' }, make('td', {}), columns.map((row) => make('th', { scope: 'colgroup', colspan: names.length, class: 'starts' },
            make('button', { type: 'button', class: 'explained', 'data-tip': row.tip }, labelWithUnit(row))))),
        make('tr', {}, make('th', { scope: 'col', class: 'first' }, make('span', { class: 'unseen' }, 'experiment')),
            columns.map(() => names.map((name, i) => make('th', { scope: 'col', class: i ? null : 'starts' },
                make('span', { style: `color: var(--series-${seriesOf(name)})` }, name))))),
    ];
    const rows = runs.map((run) => make('tr', {},
        make('th', { scope: 'row', class: 'first' }, make('a', { href: `#${run.id}` }, run.name)),
        columns.map((row) => names.map((name, i) => {
            const variant = run.variants.find((one) => one.name === name);
            const value = variant?.summary[row.key];
            const never = variant && isNever(row, variant);
            const heat = never ? 1 : Number.isFinite(value) ? Math.sqrt(Math.max(0, value) / most.get(row.key)) * 0.85 : null;
            return make('td', { class: `cell ${i ? '' : 'starts'}` }, make('a', {
                href: `#${run.id}`, class: heat === null ? 'blank' : never ? 'never' : null, style: heat === null ? null : `--heat: ${(100 * heat).toFixed(0)}%`,
                'aria-label': `${run.name}, ${name}, ${row.label}: ${variant ? summaryText(row, variant) : 'not run'}`,
            }, variant ? summaryText(row, variant) : '\u2013'));
        }))));
    return make('section', { class: 'card overview' }, make('h2', {}, 'At a glance'), makeTable('Experiments and variants', head, rows),
        make('p', { class: 'hint' }, 'The stronger the color, the more lag or error. Every cell leads to its experiment.'));
}

