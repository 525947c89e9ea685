// Loads the lab's scripts, which a built book has as one, when a lab or a figure that it moves is
// less than a screen away.
(() => {
    'use strict';

    // Without it nothing will come in the place of the picture.
    if (typeof WebAssembly !== 'object') document.documentElement.classList.add('no-lab');
    // mdBook by itself has loaded the single files.
    if (typeof Lab !== 'undefined') return;
    const script = document.createElement('script');
    script.src = new URL('bundle.js', document.currentScript.src);
    const observer = new IntersectionObserver(
        entries => {
            if (!entries.some(entry => entry.isIntersecting)) return;
            observer.disconnect();
            // What the reader sees first is not kept waiting.
            (globalThis.requestIdleCallback ?? setTimeout)(() => document.head.append(script));
        },
        { rootMargin: '100% 0%' },
    );
    // At once in the book as one page, whose labs and figures stay still and have to be told; and
    // on the lab's own page, whose address may lead to a lesson far below the lab.
    if (/\/print\.html$/.test(location.pathname) || document.querySelector('.lab.whole'))
        document.head.append(script);
    else for (const spot of document.querySelectorAll('.lab, .lab-figure')) observer.observe(spot);
})();
