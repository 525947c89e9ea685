// Elements of a page.
(theLab => {
    'use strict';

    function element(name, attributes = {}, ...children) {
        const made = document.createElement(name);
        for (const [key, value] of Object.entries(attributes)) {
            if (key.startsWith('on')) made.addEventListener(key.slice(2), value);
            else if (value !== false) made.setAttribute(key, value === true ? '' : value);
        }
        made.append(...children);
        return made;
    }

    const button = (name, words, onclick) =>
        element('button', { type: 'button', class: name, onclick }, words);

    Object.assign(theLab, { button, element });
})((globalThis.theLab ??= {}));
