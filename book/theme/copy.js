// What mdBook's frame lacks, for every page. The printer prints the page; without scripts it is a
// link to the whole book. The first link leads past the contents, without taking the place of what
// the address says.
//
// What the button beside a listing copies is the whole program, with the lines that are hidden.
// mdBook copies what is shown: so they are shown while it does.
'use strict';
{
    document.querySelector('a.printer')?.addEventListener('click', event => {
        event.preventDefault();
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
    document.addEventListener('click', () => program?.classList.add('hide-boring'));
}
