// Puts a lab on a clock of ours, on which each step of the library takes `cost` ms and a frame
// comes when it is asked for: what the lab does then depends on no machine. Run inside the page by
// addresses.py.
cost => {
    const lab = document.querySelector('.lab.whole').lab;
    const { THETA, TIME, STEPS, address } = theLab;
    let now = 1000,
        asked = null;
    const faults = new Set();
    performance.now = () => now;
    window.requestAnimationFrame = draw => {
        asked = draw;
        return 1;
    };
    window.cancelAnimationFrame = () => {
        asked = null;
    };
    const slow = exports => ({
        ...exports,
        advance(place, steps) {
            // WebAssembly would cut off what is no whole number of 32 bits, and say nothing.
            if (!(Number.isInteger(steps) && steps >= 0 && steps < 2 ** 32)) {
                faults.add(`asks for ${steps} steps`);
            }
            const limit = harness.stingy && place > 0 ? harness.stingy : Infinity;
            const left = Math.max(0, limit - exports.read(place, STEPS));
            const took = exports.advance(place, Math.min(steps, left));
            now += took * cost;
            return took;
        },
    });
    // Of a page, whatever is no number or comes from a program and not from its author.
    const NONSENSE = /NaN|undefined|Infinity|\[object|null/;
    const write = CanvasRenderingContext2D.prototype.fillText;
    CanvasRenderingContext2D.prototype.fillText = function (text, ...at) {
        if (NONSENSE.test(text)) faults.add(`draws ${text}`);
        return write.call(this, text, ...at);
    };
    addEventListener('error', event => faults.add(`throws ${event.message}`));
    addEventListener('unhandledrejection', event => faults.add(`throws ${event.reason}`));
    const kinds = () => {
        const found = new Set();
        for (const element of document.querySelectorAll('.lab.whole .live *')) {
            found.add(element.localName);
            for (const { name } of element.attributes) {
                if (name.startsWith('on')) found.add(name);
            }
        }
        return found;
    };

    const harness = {
        // The steps after which the library takes no more of a pendulum that is not the first.
        stingy: 0,
        // The faults since this was last asked.
        faults() {
            const all = [...faults];
            faults.clear();
            return all;
        },
        // The next frame, 1/60 s after the last or when that is done; returns what it took (ms).
        frame() {
            const draw = asked;
            asked = null;
            if (!draw) return 0;
            now += 1000 / 60;
            const began = now;
            draw(now);
            return now - began;
        },
        // Compares what the page shows with what the library says.
        look() {
            lab.page.show();
            lab.page.numbers.spell();
            const text = lab.page.live.textContent;
            const at = text.search(NONSENSE);
            if (at >= 0) faults.add(`shows ${text.slice(Math.max(at - 30, 0), at + 10)}`);
            for (const element of lab.page.live.querySelectorAll('*')) {
                for (const { name, value } of element.attributes) {
                    if (NONSENSE.test(value)) faults.add(`has ${name}=${value}`);
                }
            }
            const [, t, point, steps] = lab.page.time.textContent.match(
                /^t = (\d+(\.\d+)?) s, ([\d\u00a0]+) steps?$/,
            ) ?? [NaN, NaN, '', ''];
            lab.pendulums.forEach((pendulum, place) => {
                const said = quantity => lab.library.read(place, quantity);
                const name = pendulum.method.name;
                if (!harness.stingy && Number(steps.replaceAll('\u00a0', '')) !== said(STEPS)) {
                    faults.add(`${steps} steps are shown, and ${name} took ${said(STEPS)}`);
                }
                const rounding = 0.5000001 * 10 ** -(point.length - 1);
                if (!harness.stingy && !(Math.abs(Number(t) - said(TIME)) <= rounding)) {
                    faults.add(`${t} s are shown, and ${name} is at ${said(TIME)}`);
                }
                if (pendulum.lost !== Number.isNaN(said(THETA))) {
                    faults.add(`${name}: lost is ${pendulum.lost}, and θ is ${said(THETA)}`);
                }
                const lapse = said(THETA) - lab.library.exact_theta(place, said(TIME));
                if (!pendulum.lost && !Number.isNaN(lapse) && pendulum.lapse !== lapse) {
                    faults.add(`${name}: the angle error ${pendulum.lapse} is ${lapse}`);
                }
            });
        },
        // Goes to an address, and lets it run for some frames; returns the longest (ms).
        visit(text, frames) {
            const { hash } = new URL(`#${text}`, location.href);
            let longest = 0;
            try {
                if (!lab.follow(hash)) return 0;
                const scene = { ...lab.scene };
                const own = address(scene);
                const again = lab.addresses.scene(new URL(`#${own}`, location.href).hash);
                if (JSON.stringify(again) !== JSON.stringify(scene)) {
                    faults.add(`its address ${own} is another scene`);
                }
                const doubts = lab.addresses.doubts(`#${own}`);
                if (doubts.length) faults.add(`its address ${own} is not understood: ${doubts}`);
                for (const [key, value] of Object.entries(scene)) {
                    if (Object.is(value, -0)) faults.add(`${key} is −0, which no address says`);
                }
                harness.look();
                lab.run(true);
                for (let i = 0; i < frames; i++) longest = Math.max(longest, harness.frame());
                lab.run(false);
                harness.look();
            } catch (error) {
                faults.add(`throws ${error}`);
            }
            for (const kind of kinds()) {
                if (!sound.has(kind)) faults.add(`puts ${kind} on the page`);
            }
            if (globalThis.spoilt) faults.add('runs a script of the address');
            return longest;
        },
    };
    lab.library = slow(lab.library);
    lab.stopwatch = slow(lab.stopwatch);
    lab.begin();
    lab.page.numbers.spell();
    // What there is without an address; the words of a lesson have links.
    const sound = kinds().add('a');
    globalThis.harness = harness;
}
