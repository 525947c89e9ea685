// Tables that a reader can sort: those in a block of class "sortable". Each heading becomes a
// button, which sorts by its column, and the other way round when it is pressed again; aria-sort
// says so. Rows without a number stand last either way. Without scripts, and on paper, the order is
// the book's.
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

    for (const table of document.querySelectorAll('.sortable table')) {
        const heads = [...table.tHead.rows[0].cells];
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
