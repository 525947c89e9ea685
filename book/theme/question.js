// The questions of a chapter: a choice or a number is answered with the sentence on it that stands,
// folded, below the question; on a page with an exam all of them are answered together, and the
// address holds the answers.
'use strict';
{
    const all = (selector, within = document) => [...within.querySelectorAll(selector)];
    const exam = document.querySelector('.exam');

    // A question and what its reader has entered: `is` is the item of the list of answers that
    // speaks of it, or a text where none does.
    class Question {
        constructor(form) {
            this.form = form;
            this.answers = all('.answer li', form);
            this.right = this.answers.find(answer => 'right' in answer.dataset);
            this.folded = form.querySelector('.answer');
            this.folded.hidden = true;
            this.said = Object.assign(document.createElement('p'), {className: 'said'});
            this.said.setAttribute('role', 'status');
            form.insertBefore(this.said, this.folded);
        }

        get controls() {
            return all('input, select', this.form);
        }

        // As text, for the address; empty where nothing is entered.
        get entered() {
            if (this.form.dataset.kind !== 'which')
                return this.controls.map(it => it.value.trim()).join(' ').trim();
            return this.form.querySelector(':checked')?.value ?? '';
        }

        set entered(text) {
            const words = text.split(' ');
            this.controls.forEach((it, n) => {
                if (it.type === 'radio') it.checked = it.value === text;
                else it.value = words[n] ?? '';
            });
        }

        get is() {
            const {kind} = this.form.dataset;
            if (kind === 'which') {
                if (!this.entered) return 'Choose one first.';
                return this.answers.find(({dataset}) => dataset.is === this.entered);
            }
            return kind === 'number' ? this.number() : this.order();
        }

        number() {
            // A comma may be the decimal one; a cross or a star stands before a power of ten.
            const text = this.entered.replace(/\s/g, '').replace(',', '.').replace('−', '-')
                .replace(/[×x*·]10\^?/, 'e');
            const number = text === '' ? NaN : Number(text);
            if (!Number.isFinite(number)) return 'Type a number, such as 0.25 or 2.5e-3.';
            const about = this.answers.find(({dataset}) =>
                Number(dataset.low) <= number && number <= Number(dataset.high));
            if (about) return about;
            return number > this.right.dataset.high ? 'Too large.' : 'Too small.';
        }

        order() {
            const places = new Map(this.controls.map(it => [it.name, Number(it.value)]));
            if (new Set(places.values()).size < places.size || places.has(0)
                || [...places.values()].includes(0))
                return 'Give each a place of its own.';
            return this.answers.find(({dataset: {before, after}}) =>
                before && places.get(before) < places.get(after)) ?? this.right;
        }

        // Says what is right or wrong about it, and whether it is right.
        answer() {
            const {is} = this;
            const right = is === this.right;
            if (typeof is === 'string') {
                this.said.textContent = is;
            } else {
                const because = is.querySelector('span').innerHTML;
                this.said.innerHTML = `<strong>${right ? 'Right.' : 'No.'}</strong> ${because}`;
            }
            this.form.classList.toggle('right', right);
            this.form.classList.toggle('wrong', !right && typeof is !== 'string');
            if (right || exam) this.folded.hidden = false;
            return right;
        }
    }

    const questions = all('.question').map(form => new Question(form));
    const button = (text, pressed) =>
        Object.assign(document.createElement('button'),
            {type: 'button', className: 'check', textContent: text, onclick: pressed});

    if (!exam) {
        for (const question of questions) {
            const check = button('Check', () => question.answer());
            question.form.insertBefore(check, question.said);
            question.form.addEventListener('keydown', event => {
                if (event.key !== 'Enter' || event.target.tagName !== 'INPUT') return;
                event.preventDefault();
                question.answer();
            });
        }
    } else {
        const result = document.createElement('div');
        result.className = 'result';
        result.setAttribute('role', 'status');
        const mark = () => {
            const wrong = questions.filter(question => !question.answer());
            const right = questions.length - wrong.length;
            const again = new Set(wrong.map(({form}) => form.querySelector('.again').innerHTML));
            const list = [...again].map(link => `<li>${link}</li>`).join('');
            result.innerHTML = `<p><strong>${right} of ${questions.length} are right.</strong>`
                + (list ? ` Read again:</p><ul>${list}</ul>` : '</p>');
        };
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
        exam.append(button('How did I do?', () => {
            const texts = questions.map(({entered}) => encodeURIComponent(entered));
            history.replaceState(null, '', `#answers=${texts.join('~')}`);
            mark();
        }), result);
        addEventListener('hashchange', open);
        open();
    }
}
