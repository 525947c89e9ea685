// The questions of a chapter: a choice, a number or an order is answered with the sentence on it
// that stands, folded, below the question; on a page with an exam all of them are answered
// together, and the address holds what was entered. What shows the answer to a question of a
// chapter is folded until the reader has answered.
'use strict';
{
    const all = (selector, within = document) => [...within.querySelectorAll(selector)];
    const exam = document.querySelector('.exam');
    const element = (tag, given) => Object.assign(document.createElement(tag), given);
    const button = (className, textContent, onclick) =>
        element('button', {type: 'button', className, textContent, onclick});

    // After so many wrong answers a reader may see the right one.
    const MISSES = 2;

    // The numbers that a text may mean: none, one, or two, since 1,003 is a thousand and three to
    // some and little more than one to others.
    const PLAIN = /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i;
    const THOUSANDS = /^[+-]?[1-9]\d{0,2}(,\d{3})+(?![\d,])/;
    const RAISED = '⁰¹²³⁴⁵⁶⁷⁸⁹';
    const numbers = entered => {
        const text = entered.replace(/\s/g, '').replaceAll('−', '-')
            .replace(/10(⁻?)([⁰¹²³⁴⁵⁶⁷⁸⁹]+)$/, (_, sign, raised) =>
                `10^${sign && '-'}${[...raised].map(digit => RAISED.indexOf(digit)).join('')}`)
            // A power of ten, alone or after a cross or a star. What is copied from a page has lost
            // its ^.
            .replace(/^([+-]?)10\^(?=[+-]?\d+$)/, '$11e')
            .replace(/[×x*·⋅]10\^?(?=[+-]?\d+$)/, 'e');
        const readings = [text.replace(',', '.')];
        if (THOUSANDS.test(text)) readings.unshift(text.replaceAll(',', ''));
        return readings.filter(it => PLAIN.test(it)).map(Number).filter(Number.isFinite);
    };

    // A question and what its reader has entered.
    class Question {
        constructor(form) {
            this.form = form;
            this.folded = form.querySelector(':scope > .answer');
            this.answers = all(':scope > ul > li', this.folded);
            this.right = this.answers.find(answer => 'right' in answer.dataset);
            this.said = element('p', {className: 'said'});
            this.said.setAttribute('role', 'status');
            form.insertBefore(this.said, this.folded);
            this.offer = button('show', 'Show the answer', () => this.show());
            this.folded.hidden = true;
            this.misses = 0;
            if ('fold' in form.dataset && !exam) this.fold();
        }

        // Puts away what shows the answer: from the first output, figure, table or report below it,
        // up to the heading or question after that. A search within the page, or a link, finds it
        // there.
        fold() {
            const from = (one, end) =>
                one && !one.matches(end) ? [one, ...from(one.nextElementSibling, end)] : [];
            const first = from(this.form.nextElementSibling, '.question')
                .find(it => it.matches('.output, figure, .table-wrapper, .judged'));
            if (!first) return;
            this.shows = element('div', {className: 'shows'});
            // Where a browser knows this value, it opens what a search or a link leads to.
            this.shows.setAttribute('hidden', 'until-found');
            this.shows.addEventListener('beforematch', () => this.reveal());
            this.instead = element('p', {
                className: 'instead',
                textContent: 'What comes next shows the answer. Answer first, or',
            });
            this.instead.append(button('reveal', 'show it now', () => this.reveal()));
            const folded = from(first, 'h2, h3, .question');
            first.before(this.instead, this.shows);
            this.shows.append(...folded);
        }

        reveal() {
            this.instead?.remove();
            this.shows?.removeAttribute('hidden');
        }

        get controls() {
            return all(':scope > label > :is(input, select)', this.form);
        }

        // As text, for the address; empty where nothing is entered. Half a character, which some
        // programs produce, has no place in an address.
        get entered() {
            const {kind} = this.form.dataset, {controls} = this;
            if (kind === 'which') return controls.find(it => it.checked)?.value ?? '';
            if (kind === 'number')
                return controls[0].value.replace(/\p{Surrogate}/gu, '\uFFFD').trim();
            const places = controls.map(it => it.value);
            return places.some(Boolean) ? places.join(',') : '';
        }

        // Older addresses have blanks between the places of an order.
        set entered(text) {
            const {kind} = this.form.dataset, places = text.split(/[ ,]/);
            this.controls.forEach((it, n) => {
                if (kind === 'which') it.checked = it.value === text;
                else it.value = kind === 'number' ? text : places[n] ?? '';
            });
        }

        // What is said of what is entered: the item of the list of answers that speaks of it, or
        // words where none does; and whether it is `right`, `wrong`, or no answer yet, `open`.
        judged() {
            const {kind} = this.form.dataset;
            if (kind === 'number') return this.number();
            if (kind === 'order') return this.order();
            const item = this.answers.find(({dataset}) => dataset.is === this.entered);
            return item ? this.of(item) : {is: 'open', words: 'Choose one first.'};
        }

        of(item) {
            return {is: item === this.right ? 'right' : 'wrong', item};
        }

        number() {
            const read = numbers(this.entered);
            if (read.length === 0)
                return {is: 'open', words: 'Type a number, such as 0.25 or 2.5e-3.'};
            const about = ({dataset: {low, high}}) => read.some(
                number => Number(low) <= number && number <= Number(high));
            const item = about(this.right) ? this.right : this.answers.find(about);
            if (item) return this.of(item);
            const size = number =>
                number > Number(this.right.dataset.high) ? 'too large' : 'too small';
            const [one, other] = read.map(size);
            if ((other ?? one) === one) return {is: 'wrong', words: one.replace('t', 'T') + '.'};
            const [large, small] = read;
            return {is: 'wrong', words: `${large} is ${one}, and ${small} is ${other}.`};
        }

        order() {
            const places = new Map(this.controls.map(it => [it.name, Number(it.value)]));
            if (new Set(places.values()).size < places.size || [...places.values()].includes(0))
                return {is: 'open', words: 'Give each a place of its own.'};
            const wrong = this.answers.find(({dataset: {before, after}}) =>
                before && places.get(before) < places.get(after));
            return this.of(wrong ?? this.right);
        }

        // Says what is right or wrong about it, and returns which of the two it is.
        answer() {
            const {is, item, words} = this.judged();
            if (item) {
                const because = item.querySelector(':scope > .because').innerHTML;
                const verdict = is === 'right' ? 'Right.' : 'No.';
                this.said.innerHTML = `<strong>${verdict}</strong> ${because}`;
            } else {
                this.said.textContent = exam && !this.entered ? 'Not answered.' : words;
            }
            this.form.classList.toggle('is-right', is === 'right');
            this.form.classList.toggle('is-wrong', is === 'wrong');
            if (is === 'right' || (exam && is === 'wrong')) this.unfold();
            if (is !== 'open') this.reveal();
            return is;
        }

        // In a chapter, where each is answered alone.
        check() {
            if (this.answer() === 'wrong') this.misses++;
            this.offers();
            remember();
        }

        offers() {
            if (this.misses >= MISSES && this.folded.hidden)
                this.form.insertBefore(this.offer, this.folded);
        }

        unfold() {
            this.folded.hidden = false;
            this.offer.remove();
        }

        show() {
            this.unfold();
            this.folded.open = true;
            this.folded.querySelector(':scope > summary').focus();
            remember();
        }

        // As before anything was entered.
        clear() {
            this.entered = '';
            this.said.textContent = '';
            this.form.classList.remove('is-right', 'is-wrong');
            this.folded.hidden = true;
            this.folded.open = false;
            this.misses = 0;
        }
    }

    const questions = all('.question').map(form => new Question(form));

    // What was answered belongs to the page's place in the history, so that it is there again when
    // a reader who has followed a link comes back.
    const remember = () => {
        const answered = {};
        for (const {form, entered, misses, said, folded} of questions)
            if (said.textContent) answered[form.id] = {entered, misses, open: folded.open};
        history.replaceState({...history.state, answered}, '');
    };
    const recall = () => {
        for (const question of questions) {
            const was = history.state?.answered?.[question.form.id];
            if (!was) continue;
            question.entered = was.entered;
            question.misses = was.misses;
            question.answer();
            question.offers();
            if (was.open) question.unfold();
            question.folded.open = was.open;
        }
    };

    if (!exam) {
        for (const question of questions) {
            const {form, said} = question;
            form.insertBefore(button('check', 'Check', () => question.check()), said);
            form.addEventListener('keydown', event => {
                if (event.key !== 'Enter' || event.target.tagName !== 'INPUT') return;
                event.preventDefault();
                question.check();
            });
        }
        addEventListener('pageshow', recall);
        const sought = () => {
            const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
            const question = questions.find(({shows}) => target && shows?.contains(target));
            if (!question) return;
            question.reveal();
            target.scrollIntoView();
        };
        addEventListener('hashchange', sought);
        sought();
        // Another place on the page is another one in the history.
        addEventListener('hashchange', remember);
    } else {
        // Before the questions, for who opens an address, and after them, for who has answered.
        const above = element('div', {className: 'result'});
        const below = element('div', {className: 'result'});
        below.setAttribute('role', 'status');

        // A link would take the place of the answers in the address.
        const goTo = ({form, controls}) => {
            form.scrollIntoView({block: 'start'});
            (controls.find(it => it.checked) ?? controls[0]).focus({preventScroll: true});
        };
        const mark = () => {
            const found = {right: [], wrong: [], open: []};
            for (const question of questions) found[question.answer()].push(question);
            const {right, wrong, open} = found;
            const counts = [
                `${right.length} of ${questions.length} are right`,
                ...(wrong.length ? [`${wrong.length} wrong`] : []),
                ...(open.length ? [`${open.length} unanswered`] : []),
            ];
            const total = open.length === questions.length
                ? `Nothing is answered yet: ${open.length} unanswered.` : `${counts.join(', ')}.`;
            const [first, kind] = wrong.length ? [wrong[0], 'wrong'] : [open[0], 'unanswered'];
            for (const result of [above, below]) {
                const sum = element('p');
                sum.append(element('strong', {textContent: total}));
                result.replaceChildren(sum);
                if (first)
                    result.append(button('jump', `Go to the first ${kind} one`, () => goTo(first)));
            }
            const again = new Set(
                wrong.map(({folded}) => folded.querySelector(':scope > .again').innerHTML));
            if (again.size) {
                below.append(
                    element('p', {textContent: 'Read again:'}),
                    element('ul', {innerHTML: [...again].map(it => `<li>${it}</li>`).join('')}));
            }
            below.append(button('anew', 'Start again', clear));
        };
        const clear = () => {
            for (const question of questions) question.clear();
            above.replaceChildren();
            below.replaceChildren();
            history.replaceState(null, '', location.pathname + location.search);
            questions[0].controls[0].focus();
        };
        // ~ stands between the answers, and is not among the characters that are always replaced.
        const written = text => encodeURIComponent(text).replaceAll('~', '%7E');
        const open = () => {
            const texts = location.hash.match(/^#answers=(.*)/)?.[1].split('~');
            if (!texts) return;
            questions.forEach((question, n) => {
                try {
                    question.entered = decodeURIComponent(texts[n] ?? '');
                } catch {
                    question.entered = '';
                }
            });
            mark();
        };
        exam.prepend(above);
        exam.append(button('check', 'How did I do?', () => {
            const texts = questions.map(({entered}) => written(entered));
            history.replaceState(null, '', `#answers=${texts.join('~')}`);
            mark();
        }), below);
        addEventListener('hashchange', open);
        open();
    }
}
