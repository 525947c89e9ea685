// Tables that a reader can sort and filter: those in a block of class "sortable". Each heading
// becomes a button, which sorts by its column, and the other way round when it is pressed again;
// aria-sort says so. Rows without a number stand last either way. The filters of a long table, of
// the columns that FILTERS names, stand in the address, as in #verdict=fails or, of a block with an
// id, in #rows.verdict=fails, so that they can be linked to. On a telephone a row is a card.
// Without scripts, and on paper, every row is there, in the order of the book.
(() => {
    'use strict';
    if (/\/print\.html$/.test(location.pathname)) return;

    const said = (row, column) => row.cells[column].textContent.trim();
    // What was found stands before a stroke, and what is claimed behind it.
    const number = text => Number(/^[−-]?[\d.]+(?= \/|$)/.exec(text)?.[0].replace('−', '-') ?? NaN);

    const order = (column, down, rows) => {
        const texts = new Map(rows.map(row => [row, said(row, column)]));
        const found = [...texts.values()].map(number);
        const numeric = found.some(x => !Number.isNaN(x));
        return (a, b) => {
            const [s, t] = [texts.get(a), texts.get(b)];
            if (!numeric) return (down ? -1 : 1) * s.localeCompare(t, 'en');
            const [x, y] = [number(s), number(t)];
            if (Number.isNaN(x) || Number.isNaN(y)) return Number.isNaN(x) - Number.isNaN(y);
            return down ? y - x : x - y;
        };
    };

    const FILTERS = ['verdict', 'library', 'language'];
    const LONG = 30;
    // A library with its version stands before a blank.
    const kind = (row, column) => said(row, column).replace(/ \d\S*$/, '');

    const filters = (table, names) => {
        const columns = FILTERS.filter(name => names.includes(name));
        const rows = [...table.tBodies[0].rows];
        if (rows.length < LONG || !columns.length) return;
        const {id} = table.closest('.sortable');
        const prefix = id && `${id}.`;
        const form = Object.assign(document.createElement('form'), {className: 'filter'});
        form.setAttribute('aria-label', 'Filter of the table');
        const selects = columns.map(name => {
            const column = names.indexOf(name);
            const label = document.createElement('label');
            const select = document.createElement('select');
            select.name = prefix + name;
            select.add(new Option('any', ''));
            const kinds = [...new Set(rows.map(row => kind(row, column)))];
            kinds.sort((a, b) => a.localeCompare(b, 'en'));
            for (const one of kinds) select.add(new Option(one));
            label.append(name[0].toUpperCase() + name.slice(1), ' ', select);
            form.append(label);
            return {column, select};
        });
        const shown = document.createElement('output');
        const all = document.createElement('button');
        form.append(Object.assign(all, {type: 'reset', textContent: 'Show all'}), shown);
        const show = () => {
            for (const row of rows)
                row.hidden = selects.some(({select, column}) =>
                    select.value && select.value !== kind(row, column));
            shown.value = `${rows.filter(row => !row.hidden).length} of ${rows.length}`;
        };
        const filter = () => {
            show();
            const chosen = [...new FormData(form)].filter(([, value]) => value);
            const address = chosen.length ? `#${new URLSearchParams(chosen)}` : location.pathname;
            history.replaceState(history.state, '', address);
        };
        const follow = () => {
            const asked = new URLSearchParams(location.hash.slice(1));
            if (!selects.some(({select}) => asked.has(select.name))) return;
            for (const {select} of selects) {
                select.value = asked.get(select.name) ?? '';
                if (select.selectedIndex < 0) select.value = '';
            }
            show();
            const folded = form.closest('details');
            if (folded) folded.open = true;
            form.scrollIntoView();
        };
        form.addEventListener('change', filter);
        form.addEventListener('submit', event => event.preventDefault());
        // A form is reset after this event.
        form.addEventListener('reset', () => setTimeout(filter));
        addEventListener('hashchange', follow);
        table.closest('.table-wrapper').before(form);
        show();
        follow();
    };

    for (const table of document.querySelectorAll('.sortable table')) {
        const heads = [...table.tHead.rows[0].cells];
        const names = heads.map(head => head.textContent.trim());
        for (const row of table.tBodies[0].rows)
            [...row.cells].forEach((cell, column) => {
                cell.dataset.label = names[column];
                // On a card, what is not there needs no line.
                cell.classList.toggle('none', cell.textContent.trim() === '–');
            });
        filters(table, names);
        heads.forEach((head, column) => {
            const button = Object.assign(document.createElement('button'), {type: 'button'});
            button.append(...head.childNodes);
            head.append(button);
            button.addEventListener('click', () => {
                const down = head.getAttribute('aria-sort') === 'ascending';
                for (const other of heads) other.removeAttribute('aria-sort');
                head.setAttribute('aria-sort', down ? 'descending' : 'ascending');
                const [body] = table.tBodies;
                const rows = [...body.rows];
                body.append(...rows.sort(order(column, down, rows)));
            });
        });
    }
})();
