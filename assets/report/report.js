// SPDX-License-Identifier: MIT
function makeRun(run, isSuite) {
    const { experiment } = run;
    const cursor = new Cursor(run);
    const viewer = new Viewer(run, cursor), chart = new Chart(run, cursor);
    const scene = typeof experiment.scene === 'string' ? experiment.scene : run.about.scene?.name;
    const facts = [scene, `${run.size[0]} \u00d7 ${run.size[1]}`, `${run.frames} frames at ${experiment.rate} Hz`, experiment.signal,
        `seed ${experiment.seed}`].filter(Boolean);
    const events = run.events.slice(0, 12).map(({ frame, end, text }) => make('li', {},
        make('button', { type: 'button', class: 'event-chip', click: () => cursor.set(frame) },
            make('b', {}, Number.isInteger(end) && end - frame > 1 ? `${frame}\u2013${end - 1}` : frame), ` ${text}`)));
    const more = run.events.length - events.length;
    return make('section', { class: 'run', id: run.id, 'aria-labelledby': `${run.id}-title` },
        make('header', {},
            make(isSuite ? 'h2' : 'h1', { id: `${run.id}-title`, tabindex: -1 }, run.name),
            make('p', { class: 'lead' }, run.description),
            make('p', { class: 'facts' }, facts.join('  \u00b7  ')),
            events.length ? make('ul', { class: 'events', 'aria-label': 'Events' }, events, more > 0 ? make('li', { class: 'more' }, `and ${more} more`) : null) : null),
        make('div', { class: 'board' }, viewer.root, chart.root),
        viewer.strip,
        makeVariantTable(run),
        run.variants.some((variant) => variant.summary.sweep) ? new TradeOff(run).root : null,
        make('div', { class: 'card small' }, makeSettings(run), makeReferences(run), makePasses(run), makeMachine(run)));
}

function makeNavigation(runs) {
    const links = runs.map((run) => make('a', { href: `#${run.id}` }, run.name));
    const navigation = make('nav', { 'aria-label': 'Experiments' }, make('a', { href: '#results', class: 'home' }, 'Overview'), links);
    const inView = new IntersectionObserver((entries) => {
        for (const { target, isIntersecting } of entries) {
            const link = links.find((one) => one.hash === `#${target.id}`);
            if (isIntersecting) link.setAttribute('aria-current', 'true');
            else link.removeAttribute('aria-current');
        }
    }, { rootMargin: '-40% 0px -55% 0px' });
    return { navigation, watch: (sections) => sections.forEach((section) => inView.observe(section)) };
}

function startPage() {
    const { suite, runs } = readModel();
    const page = document.getElementById('page');
    const sections = runs.map((run) => makeRun(run, suite));
    const about = runs[0].about;
    const origin = [about.program ?? 'afterglow', about.version, about.commit?.slice(0, 8)].filter(Boolean).join(' ');
    const footer = make('footer', {}, `Made by ${origin}. Maps: dark blue is 0, yellow is 1.`);
    if (suite) {
        const { navigation, watch } = makeNavigation(runs);
        const variants = new Set(runs.flatMap((run) => run.variants.filter(({ summary }) => !summary.sweep).map(({ name }) => name)));
        page.className = 'suite';
        page.append(navigation, make('main', { id: 'results' },
            make('header', { class: 'top' }, make('p', { class: 'brand' }, 'Afterglow'), make('h1', {}, 'Lag and ghosting, measured'),
                make('p', { class: 'lead' }, `${runs.length} ${runs.length === 1 ? 'experiment' : 'experiments'}, ${variants.size} ${variants.size === 1 ? 'variant' : 'variants'}, the same random numbers for all.`)),
            makeOverview(runs), sections, footer));
        watch(sections);
    } else {
        page.append(make('main', { id: 'results' }, make('p', { class: 'brand' }, 'Afterglow'), sections, footer));
    }
    addEventListener('beforeprint', () => document.querySelectorAll('details').forEach((one) => (one.open = true)));
    startTips();
    // The page is made after the browser has looked for the place that the address names.
    if (location.hash) document.getElementById(decodeURIComponent(location.hash.slice(1)))?.scrollIntoView();
}

startPage();
