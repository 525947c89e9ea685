// The maps of choosing by keyboard: each is one stop of Tab, from which the arrow keys lead from
// cell to cell. The cell with the focus says what one under a mouse says: book/theme/pendula.css.
'use strict';

for (const map of document.querySelectorAll('svg[id^="fig-decision"]')) {
    const cells = [...map.querySelectorAll(':scope > .cell')];
    // They stand column by column, and their paths begin with the column's place.
    const column = cell => cell.firstElementChild.getAttribute('d').split(',')[0],
        rows = cells.findIndex(cell => column(cell) !== column(cells[0]));
    const ways = { ArrowUp: -1, ArrowDown: 1, ArrowLeft: -rows, ArrowRight: rows };
    let stop = cells[0];

    map.setAttribute('role', 'application');
    const [prompt] = map.getElementsByClassName('prompt');
    prompt.textContent = 'A tap, the mouse or the arrow keys on a cell show here';
    for (const cell of cells) {
        const said = [...cell.querySelectorAll('text')].map(line => line.textContent);
        cell.setAttribute('role', 'img');
        cell.setAttribute('aria-label', said.join('; '));
        cell.tabIndex = -1;
    }
    stop.tabIndex = 0;
    map.addEventListener('focusin', ({ target }) => {
        stop.tabIndex = -1;
        stop = target;
        stop.tabIndex = 0;
    });
    map.addEventListener('keydown', event => {
        const way = ways[event.key];
        if (!way || event.altKey || event.ctrlKey || event.metaKey) return;
        // Elsewhere they lead to another chapter.
        event.preventDefault();
        event.stopPropagation();
        const next = cells[cells.indexOf(stop) + way];
        if (next && (Math.abs(way) > 1 || column(next) === column(stop))) next.focus();
    });
}
