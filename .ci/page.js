// What is wrong with the page on the screen, as a list of findings. Run inside the page by .ci/browser, which says
// what each finding protects against. `paper`: nothing scrolls there, so nothing may be wider than the sheet.
async ({paper, letter, index, contrast}) => {
    await document.fonts.ready;
    const findings = [];
    const find = (kind, what) => findings.push(`${kind}: ${what}`);
    const brief = text => text.trim().replace(/\s+/g, ' ').slice(0, 60);
    const main = document.querySelector('main') ?? document.body;
    const all = (selector, root = main) => [...root.querySelectorAll(selector)];
    const shown = element => element.checkVisibility({visibilityProperty: true});
    const name = element => {
        const classes = [...element.classList].map(c => `.${c}`).join('');
        return `<${element.localName}${classes}> ${brief(element.textContent)}`;
    };

    // Formulas: in red, or left as their source. Code may say what it likes.
    for (const bad of all('.katex-error, .katex [style*="cc0000" i], .katex [mathcolor="#cc0000" i]')) {
        find('formula in red', brief(bad.textContent));
    }
    const walker = document.createTreeWalker(main, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
        const {data, parentElement} = walker.currentNode;
        if (!/[$\\{]/.test(data) || parentElement.closest('code, pre, script, style, template')) continue;
        const source = data.match(/\$[^$]+\$|\$\$|\\[a-zA-Z]{2,}|\\[([]|\{\{/);
        if (source) find('formula left as source', brief(data.slice(source.index)));
    }

    // Figures: drawn, and described for those who do not see them.
    for (const svg of all('svg').filter(svg => svg.closest('figure') || svg.getAttribute('role') === 'img')) {
        const says = tag => [...svg.children].some(c => c.localName === tag && c.textContent.trim());
        for (const tag of ['title', 'desc']) if (!says(tag)) find(`figure without ${tag}`, name(svg));
        if (svg.getAttribute('role') !== 'img') find('figure without role', name(svg));
        const named = (svg.getAttribute('aria-labelledby') ?? '').split(/\s+/).filter(Boolean);
        for (const id of named) if (!document.getElementById(id)) find('figure described by nothing', id);
        const {width, height} = svg.getBoundingClientRect();
        if (shown(svg) && !(width > 100 && height > 50)) find('figure not drawn', name(svg));
    }
    for (const img of all('img')) {
        if (!img.alt.trim()) find('image without alt', img.src);
        if (!img.naturalWidth) find('image not drawn', img.src);
    }

    // Headings and ids: one of each, so that links and the contents lead to one place.
    const ids = [...document.querySelectorAll('[id]')].map(e => e.id);
    for (const id of new Set(ids.filter((id, i) => ids.indexOf(id) < i))) find('id twice', id);
    if (!/\/(print|toc)\.html$/.test(location.pathname)) {
        const heads = all('h1, h2, h3, h4').map(h => brief(h.textContent));
        for (const head of new Set(heads.filter((h, i) => heads.indexOf(h) < i))) find('heading twice', head);
        if (all('h1').length !== 1) find('not one first heading', `${all('h1').length}`);
    }

    // Width: the page stands still; tables, code and formulas may scroll in a box of their own, though not on paper.
    const width = document.documentElement.clientWidth;
    const boxed = element => {
        for (let e = element.parentElement; e && e !== main; e = e.parentElement) {
            if (getComputedStyle(e).overflowX !== 'visible') return true;
        }
        return false;
    };
    if (document.documentElement.scrollWidth > width) {
        find('wider than the window', `${document.documentElement.scrollWidth} > ${width}`);
    }
    for (const element of all('*', main)) {
        // A curve may leave its figure's frame, which cuts it off.
        if (element.closest('.katex-mathml, svg :not(text)') || !shown(element)) continue;
        const {left, right, width: own} = element.getBoundingClientRect();
        if (own && (right > width + 1 || left < -1) && (paper || !boxed(element))) {
            find('wider than the window', `${Math.round(left)} to ${Math.round(right)} of ${width}, ${name(element)}`);
            break;
        }
    }

    // Letters of a figure: as large on the screen as they have to be to be read.
    for (const text of all('figure svg text, figure svg tspan').filter(t => shown(t))) {
        if (![...text.childNodes].some(node => node.nodeType === 3 && node.data.trim())) continue;
        const size = parseFloat(getComputedStyle(text).fontSize) * text.getScreenCTM().a;
        const least = text.localName === 'tspan' && text.hasAttribute('dy') ? index : letter;
        if (size < least) {
            find('small letters in a figure', `${size.toFixed(1)} px, ${brief(text.textContent)}`);
            break;
        }
    }

    // Contrast: the ink of every piece of text against the ground that it stands on.
    const rgba = colour => {
        const canvas = rgba.canvas ??= Object.assign(document.createElement('canvas'), {width: 1, height: 1})
            .getContext('2d', {willReadFrequently: true});
        canvas.clearRect(0, 0, 1, 1);
        canvas.fillStyle = colour;
        canvas.fillRect(0, 0, 1, 1);
        const [r, g, b, a] = canvas.getImageData(0, 0, 1, 1).data;
        return [r, g, b, a / 255];
    };
    const known = new Map();
    const cached = colour => known.get(colour) ?? known.set(colour, rgba(colour)).get(colour);
    const over = ([r, g, b, a], [R, G, B]) => [r * a + R * (1 - a), g * a + G * (1 - a), b * a + B * (1 - a), 1];
    const ground = element => {
        const here = element ? cached(getComputedStyle(element).backgroundColor) : [255, 255, 255, 1];
        return here[3] === 1 ? here : over(here, ground(element.parentElement));
    };
    const luminance = ([r, g, b]) => {
        const linear = c => ((c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
        return 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
    };
    const faint = new Map();
    const pieces = document.createTreeWalker(main, NodeFilter.SHOW_TEXT);
    while (pieces.nextNode()) {
        const element = pieces.currentNode.parentElement;
        if (!pieces.currentNode.data.trim() || !shown(element)) continue;
        if (element.closest('.katex-mathml, script, style, template, button, title, desc')) continue;
        const style = getComputedStyle(element);
        const inside = element.closest('svg');
        const paperColour = ground(inside ?? element);
        const ink = over(cached(inside ? style.fill : style.color), paperColour);
        const [a, b] = [luminance(ink), luminance(paperColour)];
        const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
        const where = inside ? 'svg' : element.closest('code, a, figcaption, th, td, p, li')?.localName;
        const kind = `${where} ${[...element.classList].join('.')}`;
        if (ratio < contrast && !(faint.get(kind)?.ratio < ratio)) faint.set(kind, {ratio, element});
    }
    for (const [kind, {ratio, element}] of faint) {
        find('faint', `${ratio.toFixed(2)} : 1, ${kind}, ${brief(element.textContent)}`);
    }

    // The title and the last words, by which the print page knows the chapter.
    const spoken = all('p').map(p => p.textContent.trim().replace(/\s+/g, ' ')).filter(Boolean);
    return {findings, title: brief(main.querySelector('h1')?.textContent ?? ''), last: spoken.at(-1) ?? ''};
}
