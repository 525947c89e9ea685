// The theme that the reader chose in the book, or the one that the system prefers.
'use strict';
(() => {
    const root = document.documentElement;
    root.classList.add('js');
    const select = document.getElementById('theme');
    const themes = [...select.options].map((option) => option.value);
    const show = (theme) => {
        root.classList.remove(...themes);
        root.classList.add(theme);
        select.value = theme;
    };
    let chosen = null;
    // A page from the disk may have no storage; then the choice is not kept.
    try { chosen = localStorage.getItem('mdbook-theme'); } catch { /* none */ }
    const dark = matchMedia('(prefers-color-scheme: dark)').matches;
    show(themes.includes(chosen) ? chosen : dark ? 'navy' : 'light');
    select.addEventListener('change', () => {
        show(select.value);
        try { localStorage.setItem('mdbook-theme', select.value); } catch { /* none */ }
    });
})();
