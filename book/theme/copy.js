// What mdBook's frame lacks, for every page. The printer prints the page; without scripts it is a
// link to the whole book. The first link leads past the contents, without taking the place of what
// the address says.
//
// What the button beside a listing copies is the whole program, with the lines that are hidden.
// mdBook copies what is shown: so they are shown while it does. On the page the body of `main`
// stands at the margin, and in the copy as an editor would set it.
'use strict';
{
    // What was never near the screen has not asked for its fonts: formulas would be blank.
    document.querySelector('a.printer')?.addEventListener('click', async event => {
        event.preventDefault();
        await Promise.allSettled([...document.fonts].map(font => font.load()));
        print();
    });
    document.querySelector('a.skip')?.addEventListener('click', event => {
        event.preventDefault();
        const text = document.getElementById('mdbook-content');
        text.tabIndex = -1;
        text.focus();
    });

    let program;
    document.addEventListener('click', ({target}) => {
        const listing = target.closest('.clip-button')?.closest('pre');
        program = listing?.querySelector('code.language-rust.hide-boring:not(.ignore)');
        program?.classList.remove('hide-boring');
    }, true);
    document.addEventListener('click', () => {
        program?.classList.add('hide-boring');
        program = null;
    });

    const indented = text => {
        const lines = text.split('\n'),
            from = lines.findIndex(line => /^fn main\(.*\{$/.test(line)),
            to = lines.indexOf('}', from);
        // It may be indented already.
        const body = lines.slice(from + 1, to).filter(Boolean);
        if (from < 0 || body.every(line => line.startsWith(' '))) return text;
        return lines
            .map((line, i) => (line && i > from && i < to ? `    ${line}` : line))
            .join('\n');
    };
    document.addEventListener('copy', event => {
        const text = program && event.target.value;
        if (!text) return;
        event.clipboardData.setData('text/plain', indented(text));
        event.preventDefault();
    });
}
