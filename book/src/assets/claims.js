// Filters for the appendix of claims, above its tables. The filter stands in the address, as in
// #verdict=wrong&part=cell, so that it can be linked to. Without scripts, in print and in the book
// as one page, every claim is shown.
(() => {
    'use strict';

    const summary = document.querySelector('.verdicts')?.closest('figure');
    if (!summary || /\/print\.html$/.test(location.pathname)) return;

    const tables = [...document.querySelectorAll('.claims')];
    const rows = tables.flatMap(table => [...table.tBodies[0].rows]);
    const ours = row => ['finding', 'reading'].includes(row.dataset.kind);
    const claims = rows.filter(row => !ours(row)).length;

    const form = document.createElement('form');
    form.className = 'filter';
    form.setAttribute('aria-label', 'Filter of the claims');
    form.innerHTML = `
        <label>Verdict <select name="verdict"><option value="">any</option></select></label>
        <label>Part <select name="part"><option value="">all</option></select></label>
        <button type="reset">Show all</button>
        <output></output>`;
    const { verdict, part } = form.elements;
    const [shown] = form.getElementsByTagName('output');

    // The choices, in the order of the summary and of the paper.
    const tags = [summary, ...tables].flatMap(at => [...at.querySelectorAll('.tag')]);
    for (const [name, slug] of new Map(tags.map(tag => [tag.textContent, tag.classList[1]])))
        verdict.add(new Option(name, slug));
    const places = { A: 'Abstract', F: 'Figures', P: 'Section', T: 'Table', X: 'Rows of X' };
    const parts = [...new Set(rows.map(row => row.dataset.part))].sort();
    const choices = [
        ['cell', 'Cells of its tables'],
        ['sentence', 'Its sentences'],
        ...parts.map(code => [code, `${places[code[0]]} ${code.slice(1)}`]),
        ['finding', 'Numbers that we added'],
        ['reading', 'Questions that we added'],
    ];
    for (const [code, name] of choices) part.add(new Option(name, code));

    const show = () => {
        for (const row of rows) {
            const { verdict: judged, part: place, kind } = row.dataset;
            const wanted =
                (!verdict.value || verdict.value === judged) &&
                (!part.value || part.value === place || part.value === kind);
            row.hidden = !wanted;
        }
        for (const table of tables) {
            const none = [...table.tBodies[0].rows].every(row => row.hidden);
            table.closest('figure').classList.toggle('none', none);
        }
        const left = rows.filter(row => !row.hidden);
        const added = left.filter(ours).length;
        shown.value = `${left.length - added} of ${claims} claims`;
        if (added) shown.value += `, and ${added} of our own`;
    };

    // From the address to the filter. An address without one, as that of a row, shows every row.
    const follow = () => {
        const address = location.hash.slice(1);
        const asked = new URLSearchParams(address);
        for (const select of [verdict, part]) {
            select.value = asked.get(select.name) ?? '';
            if (select.selectedIndex < 0) select.value = '';
        }
        show();
        // The browser looked for the place when rows were hidden, or the filter was not there.
        const filtered = verdict.value || part.value;
        const place = filtered ? form : document.getElementById(decodeURIComponent(address));
        place?.scrollIntoView();
    };

    // And from the filter to the address.
    const filter = () => {
        show();
        const chosen = [...new FormData(form)].filter(([, value]) => value);
        const address = chosen.length ? `#${new URLSearchParams(chosen)}` : location.pathname;
        history.replaceState(null, '', address);
    };

    form.addEventListener('change', filter);
    form.addEventListener('submit', event => event.preventDefault());
    // A form is reset after this event.
    form.addEventListener('reset', () => setTimeout(filter));
    addEventListener('hashchange', follow);
    for (const link of summary.querySelectorAll('[data-filter]')) {
        link.href = `#${link.dataset.filter}`;
        // The same address again is no change.
        link.addEventListener('click', () => link.hash === location.hash && follow());
    }
    summary.after(form);
    follow();
})();
