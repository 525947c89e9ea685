// What the button beside a listing copies is the whole program, with the lines that are hidden.
// mdBook copies what is shown: so they are shown while it does.
'use strict';
{
    let program;
    document.addEventListener('click', ({target}) => {
        const listing = target.closest('.clip-button')?.closest('pre');
        program = listing?.querySelector('code.language-rust.hide-boring:not(.ignore)');
        program?.classList.remove('hide-boring');
    }, true);
    document.addEventListener('click', () => program?.classList.add('hide-boring'));
}
