// Loads the lab's scripts, which a built book has as one, when a lab or a figure that it moves is
// less than a screen away.
(() => {
    'use strict';

    // mdBook by itself has loaded the single files.
    if (globalThis.theLab) return;
    const script = document.createElement('script');
    script.src = new URL('bundle.js', document.currentScript.src);
    const observer = new IntersectionObserver(
        entries => {
            if (!entries.some(entry => entry.isIntersecting)) return;
            observer.disconnect();
            document.head.append(script);
        },
        { rootMargin: '100% 0%' },
    );
    // The book as one page has none that move; it is told so at once.
    if (/\/print\.html$/.test(location.pathname)) document.head.append(script);
    else
        for (const spot of document.querySelectorAll('.lab, .lab-figure')) observer.observe(spot);
})();
