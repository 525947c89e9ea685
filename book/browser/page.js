// What is wrong with the page on the screen and is no matter of axe: a list of findings. Run inside
// the page by pages.py. `letter` and `index` are the least sizes of a figure's letters, `contrast`
// the least contrast.
//   paper:    nothing scrolls there, so nothing may be wider than the sheet
//   listings: the window is as wide as a desk, so no listing has to be cut off
async ({letter, index, contrast, paper = false, listings = false}) => {
    await document.fonts.ready;
    // What is far from the screen would be laid out anew for each question of whether it is shown.
    const near = new CSSStyleSheet();
    near.replaceSync('* { content-visibility: visible !important; }');
    document.adoptedStyleSheets = [near];
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
    const red = '[style*="cc0000" i], [mathcolor="#cc0000" i]';
    for (const bad of all(`.katex-error, .katex :is(${red})`)) {
        find('formula in red', brief(bad.textContent));
    }
    const walker = document.createTreeWalker(main, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
        const {data, parentElement} = walker.currentNode;
        if (parentElement.closest('code, pre, script, style, template')) continue;
        const source = data.match(/\$[^$]+\$|\$\$|\\[a-zA-Z]{2,}|\\[([]|\{\{/);
        if (source) find('formula left as source', brief(data.slice(source.index)));
    }

    // Figures: drawn, and described for those who do not see them. axe asks for a name only, and
    // not whether what an attribute names is there.
    for (const svg of all('figure:not(.table) svg, svg[role=img]')) {
        for (const tag of ['title', 'desc']) {
            const says = [...svg.children].some(c => c.localName === tag && c.textContent.trim());
            if (!says) find(`figure without ${tag}`, name(svg));
        }
        // One with parts that take the focus is no image.
        const isNamed = ['img', 'application'].includes(svg.getAttribute('role'));
        if (!isNamed) find('figure without role', name(svg));
        for (const id of (svg.getAttribute('aria-labelledby') ?? '').match(/\S+/g) ?? []) {
            if (!document.getElementById(id)) find('figure described by nothing', id);
        }
        const {width, height} = svg.getBoundingClientRect();
        const drawn = width > 100 && height > 50;
        if (shown(svg) && !drawn) find('figure not drawn', name(svg));
    }
    // axe takes an empty alt for an ornament; the book has none.
    for (const img of all('img')) {
        img.loading = 'eager';
        await img.decode().catch(() => {});
        if (!img.alt.trim()) find('image without alt', img.src);
        if (!img.naturalWidth) find('image not drawn', img.src);
    }

    // Paper: no picture and no listing that a page has no room for. Letter paper is 980 px high
    // between margins.
    for (const whole of paper ? all('img, svg[role=img], pre') : []) {
        const {height} = whole.getBoundingClientRect();
        if (height > 980) {
            find('higher than a sheet', `${Math.round(height)} px, ${name(whole)}`);
        }
    }

    // Headings: one of each, so that the contents lead to one place.
    if (!/\/(print|toc)\.html$/.test(location.pathname)) {
        const heads = all('h1, h2, h3, h4').map(h => brief(h.textContent));
        const again = heads.filter((head, i) => heads.indexOf(head) < i);
        for (const head of new Set(again)) find('heading twice', head);
        if (all('h1').length !== 1) find('not one first heading', `${all('h1').length}`);
    }

    // Ids: once each, so that a link leads to one place. axe looks for them no more.
    const ids = new Set();
    for (const {id} of all('[id]', document)) {
        if (ids.has(id)) find('id twice', id);
        ids.add(id);
    }

    // Width: the page stands still; tables, code and formulas may scroll in a box of their own,
    // though not on paper.
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
            const span = `${Math.round(left)} to ${Math.round(right)} of ${width}`;
            find('wider than the window', `${span}, ${name(element)}`);
            break;
        }
    }

    // Listings: whole lines in their boxes, in the folded parts too.
    if (listings) {
        const folded = all('details:not([open])');
        for (const details of folded) details.open = true;
        for (const code of all('pre > code')) {
            if (code.scrollWidth > code.clientWidth) {
                find('listing cut off', `${code.scrollWidth} > ${code.clientWidth}, ${name(code)}`);
            }
        }
        for (const details of folded) details.open = false;
    }

    // Letters of a figure: none beyond the edge of a box that cuts off, or scrolls, what leaves it.
    // Paper has no such boxes.
    for (const text of paper ? [] : all('figure svg text, svg.moved text').filter(t => shown(t))) {
        const {left, right} = text.getBoundingClientRect();
        const cuts = box => {
            const edge = box.getBoundingClientRect();
            const cut = getComputedStyle(box).overflowX !== 'visible';
            return cut && (left < edge.left - 1 || right > edge.right + 1);
        };
        let box = text.closest('svg').parentElement;
        while (box && !cuts(box)) box = box.parentElement;
        if (box) {
            find('letters of a figure cut off', `${brief(text.textContent)} at ${box.localName}`);
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

    // Contrast: the ink of every piece of text against the ground that it stands on. axe is not
    // asked, as it judges neither the letters of figures nor single ones, and most formulas are
    // single letters.
    const oftenRead = {willReadFrequently: true};
    const rgba = colour => {
        const dot = rgba.dot ??= new OffscreenCanvas(1, 1).getContext('2d', oftenRead);
        dot.clearRect(0, 0, 1, 1);
        dot.fillStyle = colour;
        dot.fillRect(0, 0, 1, 1);
        const [r, g, b, a] = dot.getImageData(0, 0, 1, 1).data;
        return [r, g, b, a / 255];
    };
    const known = new Map();
    const cached = colour => known.get(colour) ?? known.set(colour, rgba(colour)).get(colour);
    const mix = (ink, under, part) => ink * part + under * (1 - part);
    const over = ([r, g, b, a], [R, G, B]) => [mix(r, R, a), mix(g, G, a), mix(b, B, a), 1];
    const grounds = new Map([[null, [255, 255, 255, 1]]]);
    const ground = element => {
        if (!grounds.has(element)) {
            const here = cached(getComputedStyle(element).backgroundColor);
            const whole = here[3] === 1 ? here : over(here, ground(element.parentElement));
            grounds.set(element, whole);
        }
        return grounds.get(element);
    };
    const luminance = ([r, g, b]) => {
        const linear = c => ((c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
        return 0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b);
    };
    const unseen = '.katex-mathml, script, style, template, title, desc, :disabled';
    const faint = new Map();
    const fields = 'input:is([type=number], [type=search], [type=text]), select, textarea';
    const written = new Set(paper ? [] : all(fields, document.body));
    const pieces = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (pieces.nextNode()) {
        if (pieces.currentNode.data.trim()) written.add(pieces.currentNode.parentElement);
    }
    for (const element of written) {
        if (element.closest(unseen) || !shown(element)) continue;
        const inside = element.closest('svg');
        const style = getComputedStyle(element);
        const paperColour = ground(inside ?? element);
        const ink = over(cached(inside ? style.fill : style.color), paperColour);
        const [a, b] = [luminance(ink), luminance(paperColour)];
        const ratio = (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
        const around = element.closest('code, a, figcaption, th, td, p, li');
        const where = inside ? 'svg' : around?.localName;
        const kind = `${where} ${[...element.classList].join('.')}`;
        const worst = faint.get(kind)?.ratio ?? contrast;
        if (ratio < worst) faint.set(kind, {ratio, element});
    }
    for (const [kind, {ratio, element}] of faint) {
        find('faint', `${ratio.toFixed(2)} : 1, ${kind}, ${brief(element.textContent)}`);
    }

    // The title and the last words, by which the print page knows the chapter.
    const spoken = all('p').map(p => p.textContent.trim().replace(/\s+/g, ' ')).filter(Boolean);
    const title = brief(main.querySelector('h1')?.textContent ?? '');
    return {findings, title, last: spoken.at(-1) ?? ''};
}
