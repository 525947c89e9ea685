"""Checks the tables, the answers and the file: python3 check.py [--file]

--file: only the file: that it has its schema's form, and is what the generator writes now.
"""

import functools
import itertools
import json
import math
import re
import sys
import time

import mpmath
import numpy

import coefficients
import generate
import second
import tables
from arithmetic import Digits, Plain, mpf
from steps import Method, Pendulum, taylor

# What sixty digits leave after the cancellations of the checks.
NOTHING = mpf(10) ** -48
# Both computations agree to this.
SECOND = mpf(10) ** -42
# No two entries are nearer to each other than so many tolerances, in doubles.
APART = 10
EPSILON = {"double": mpf(2) ** -52, "single": mpf(2) ** -23}
FAILURES = []


def fail(*words):
    FAILURES.append(" ".join(map(str, words)))
    print("WRONG:", *words)


@functools.lru_cache(None)
def trees(order):
    """The rooted trees with so many nodes, each a sorted tuple of its branches."""
    if order == 1:
        return [()]
    found = set()
    for parts in partitions(order - 1):
        for branches in itertools.product(*(trees(part) for part in parts)):
            found.add(tuple(sorted(branches)))
    return sorted(found)


def partitions(n, largest=None):
    if n == 0:
        yield ()
    for part in range(min(n, largest or n), 0, -1):
        for rest in partitions(n - part, part):
            yield (part, *rest)


def size(tree):
    return 1 + sum(size(branch) for branch in tree)


@functools.lru_cache(None)
def density(tree):
    return size(tree) * mpmath.fprod(density(branch) for branch in tree)


def order_defects(a, weights, order):
    """By how much the sums over all trees of each order miss 1/γ: the largest, for each order."""

    @functools.lru_cache(None)
    def branch(tree):
        inner = stage(tree)
        return [sum((x * y for x, y in zip(row, inner) if x), mpf(0)) for row in a]

    @functools.lru_cache(None)
    def stage(tree):
        product = [mpf(1)] * len(a)
        for one in tree:
            product = [x * y for x, y in zip(product, branch(one))]
        return product

    defects = []
    for n in range(1, order + 1):
        sums = [(sum(b * x for b, x in zip(weights, stage(t))), 1 / density(t)) for t in trees(n)]
        defects.append(max(abs(x - y) for x, y in sums))
    return defects


def check_conditions(table, method):
    """All order conditions of a Runge-Kutta table, its interpolant, its estimate; its nodes."""
    printed = mpf(10) ** (2 - table.get("digits", 100)) + NOTHING
    nodes, a = method.tableau()
    if "a_theta" not in table and table["name"] != "lobatto-iiib-2":
        worst = max(abs(c - sum(row)) for c, row in zip(nodes, a))
        if worst > printed:
            fail(table["name"], "a node is not the sum of its row", mpmath.nstr(worst, 3))
    order = table["order"]
    # Beyond order 12 there are too many trees; there the slope is the witness.
    defects = order_defects(a, method.row("b"), min(order, 12))
    if max(defects) > printed:
        fail(table["name"], "order conditions", [mpmath.nstr(x, 2) for x in defects])
    if order < 12 and order_defects(a, method.row("b"), order + 1)[-1] < mpf(10) ** -9:
        fail(table["name"], "more than its order")
    if "b_embedded" in table:
        defects = order_defects(a, method.row("b_embedded"), order + 2)
        held = next(i for i, x in enumerate(defects) if x > printed)
        if held not in (order - 1, order, order + 1):
            fail(table["name"], "the estimating formula has order", held)
    if "interpolant" in table:
        weights, part = method.row("interpolant"), mpf(3) / 10
        scaled = [[x / part for x in row] for row in a]
        defects = order_defects(scaled, [w / part for w in weights], table["interpolant_order"])
        if max(defects) > NOTHING:
            fail(table["name"], "interpolant", defects)
    return sum(len(trees(n)) for n in range(1, min(order, 12) + 1))


def slope(method, scene, halvings, steps=1, order=80):
    """The order that the error after some small steps shows, from steps of two lengths."""
    errors = []
    for e in (halvings, halvings + 1):
        scene["h"] = mpf(2) ** -e
        scene["before"] = generate.exact_before(scene, method.table.get("before", 0))
        system, true = Pendulum(Digits, scene), (scene["theta"], scene["omega"])
        for i in range(steps):
            now = scene["t"] + i * scene["h"]
            true = taylor(Digits, system, None, now, *true, scene["h"], order=order)
        found = method.run(Digits, scene, steps)[0][-1]
        errors.append(max(abs(a - b) for a, b in zip(found, true)))
    return mpmath.log(errors[0] / errors[1], 2) - 1


def halvings_for(table):
    """As short as the digits of the coefficients let the error be seen."""
    digits, order = min(table.get("digits", 60) - 6, 50), table["order"]
    return 1 if order > 20 else max(2, min(18, int(digits * 3.32 / (order * 1.2 + 3))))


def kept(method):
    """What one step keeps, by the determinant of its differences, the way back and the energy."""
    scene, small, found = generate.inputs("over-the-top"), mpf(10) ** -20, []

    def go(q, p, h="0.25"):
        return method.run(Digits, {**scene, "theta": q, "omega": p, "h": mpf(h)}, 1)[0][0]

    q, p = mpf("0.7"), mpf("1.3")
    (a, b), (c, d) = [
        [(x - y) / (2 * small) for x, y in zip(go(q + u, p + v), go(q - u, p - v))]
        for u, v in ((small, 0), (0, small))
    ]
    if abs(a * d - b * c - 1) < mpf(10) ** -36:
        found.append("symplectic")
    there = go(q, p)
    if max(abs(x - y) for x, y in zip(go(*there, h="-0.25"), (q, p))) < NOTHING:
        found.append("symmetric")
    gained = mpmath.cos(there[0]) - mpmath.cos(q)
    if abs((there[1] ** 2 - p**2) / 2 - mpf("2.25") * gained) < NOTHING:
        found.append("energy")
    return found


def check_tables(methods):
    conditions = 0
    for table in methods.values():
        method, name = Method(table), table["name"]
        if table["kind"] == "rk" and "a_theta" not in table:
            conditions += check_conditions(table, method)
        scenes = generate.scenes_of(method)
        for driven in [False, True] if "driven" in scenes else [False]:
            scene = generate.inputs("driven" if driven else "swinging")
            scene.update(t=mpf("0.4"), theta=mpf("2.5"), omega=mpf("1.9"))
            found = slope(method, scene, halvings_for(table))
            about = 0.7 if "digits" in table else 0.3
            if abs(found - table["order"]) > about:
                fail(name, "order", mpmath.nstr(found, 4), "driven" if driven else "")
        if method.kind != "multistep" and kept(method) != table.get("keeps", []):
            fail(name, "keeps", kept(method))
    print(f"tables: {len(methods)}, {conditions} order conditions; slopes, determinants, ways back")


def plain_number(ball):
    return mpf(ball.mid().str(70, radius=False))


def check_answers(entries):
    """Against the second computation and plain programs; the answers by name, from the file."""
    worst, numbers, alone, strayed = mpf(0), 0, [], {"double": (0, ""), "single": (0, "")}
    written = json.loads(generate.OUTPUT.read_text())
    written = {e["name"]: e["answers"] for e in written["methods"] + written["mistakes"]}
    if list(written) != list(entries):
        fail("the file has other entries than the tables")
    for name, table in entries.items():
        method = Method(table)
        rows = iter(written[name])
        for scene, counts in generate.scenes_of(method).items():
            inputs = generate.inputs(scene, table.get("before", 0))
            states = method.run(Digits, inputs, max(counts))[0]
            other = second.run(table, generate.WHOLE[scene], max(counts))
            plain = {}
            for kind, real in (("double", float), ("single", numpy.float32)):
                plain[kind] = method.run(Plain(real), inputs, max(counts))[0]
            for steps in counts:
                row, exact = next(rows), states[steps - 1]
                if [row["theta"], row["omega"]] != [generate.shown(x) for x in exact]:
                    fail(name, scene, steps, "the file has another answer")
                if other is None:
                    alone.append(name)
                else:
                    numbers += 2
                    for a, b in zip(exact, other[steps - 1]):
                        difference = abs(a - plain_number(b)) + plain_number(b.rad())
                        worst = max(worst, difference)
                        if difference > SECOND * max(1, abs(a)):
                            fail(name, scene, steps, "the second differs by", difference)
                for kind, epsilon in EPSILON.items():
                    size = max(abs(x) for x in exact) * epsilon * int(row["tolerance"])
                    both = zip(exact, plain[kind][steps - 1])
                    far = max(abs(x - mpf(float(y))) for x, y in both) / size
                    strayed[kind] = max(strayed[kind], (float(far), f"{name}, {scene}, {steps}"))
                    if far > 1:
                        fail(name, scene, steps, f"in plain {kind} precision off by {float(far)}")
    print(f"second computation: {numbers} numbers, largest difference {mpmath.nstr(worst, 2)}")
    print(f"  not known to it: {', '.join(dict.fromkeys(alone))}")
    for kind, (far, where) in strayed.items():
        print(f"plain programs, {kind}: at most {far:.2f} of a tolerance ({where})")
    return written


def check_extras(methods, written):
    """The estimates and interpolants, by the second computation with other weights."""
    checked = 0
    for name, table in methods.items():
        for row in written[name]:
            scene = generate.WHOLE[row["scene"]]

            def step(weights, scene=scene, table=table):
                return second.run(table | {"b": table[weights]}, scene, 1)[0]

            found = {}
            if "estimate" in row:
                found["estimate"] = [x - y for x, y in zip(step("b"), step("b_embedded"))]
            if "at_0.3" in row:
                found["at_0.3"] = step("interpolant")
            for key, values in found.items():
                checked += 1
                texts = [row[key]["theta"], row[key]["omega"]]
                for text, value in zip(texts, values):
                    if abs(mpf(text) - plain_number(value)) > abs(mpf(text)) * mpf(10) ** -24:
                        fail(name, row["scene"], key, text, value)
    print(f"estimates and interpolants: {checked}")


def check_equations(methods):
    """The steps on wrong equations, by the second computation."""
    checked = 0
    written = json.loads(generate.OUTPUT.read_text())["methods"]
    for row in written:
        table, on = methods[row["name"]], row.get("on", {})
        if tables.knows_the_sine(table) == bool(on):
            fail(row["name"], "has", len(on), "wrong equations")
        for name, state in on.items():
            force = tables.equations()[name]["force"]
            found = second.run(table | {"force": force}, generate.WHOLE["swinging"], 1)[0]
            for text, value in zip((state["theta"], state["omega"]), found):
                checked += 1
                if generate.rounded(plain_number(value)) != text:
                    fail(row["name"], "on", name, text, value)
    print(f"steps on wrong equations: {checked} numbers")


def check_effects(mistakes):
    """The order that the effect of a mistake speaks of, from the error after two small steps."""
    checked = 0
    for name, table in mistakes.items():
        said = re.search(r"(?<!velocity of )order (\d)", table["effect"])
        # The seventeen digits of this one hide it.
        if not said or table["of"] == "dormand-prince-8":
            continue
        scene = generate.inputs("driven" if "driven" in table["effect"] else "swinging")
        scene.update(t=mpf("0.4"), theta=mpf("0.7"), omega=mpf("1.1"))
        order = slope(Method(table), scene, 11, steps=2, order=30)
        checked += 1
        if abs(order - int(said[1])) > 0.1:
            fail(name, "says", said[0], "and shows", mpmath.nstr(order, 3))
    print(f"effects: the order of {checked} mistakes")


def check_distances(written, entries):
    """How near entries are: the largest distance over the scenes that both have."""
    points = {}
    for name, rows in written.items():
        exact = {(r["scene"], r["steps"]): (mpf(r["theta"]), mpf(r["omega"])) for r in rows}
        allowed = {(r["scene"], r["steps"]): int(r["tolerance"]) for r in rows}
        points[name] = {at: (*map(float, z), allowed[at], *z) for at, z in exact.items()}
    same = {frozenset((n, other)) for n, t in entries.items() for other in t.get("same_as", [])}
    nearest, pairs = math.inf, 0
    for (a, first), (b, other) in itertools.combinations(points.items(), 2):
        shared = first.keys() & other.keys()
        if not shared or {a, b} in same:
            continue
        far, pairs = max(distance(first[key], other[key]) for key in shared), pairs + 1
        nearest = min(nearest, far)
        if far < APART:
            fail(a, "and", b, f"are {far:.2g} tolerances apart")
    print(f"distances: {pairs} pairs, the nearest {nearest:.3g} tolerances of doubles apart")


def distance(x, y):
    """In tolerances of doubles."""
    size = max(abs(x[0]), abs(x[1])) * max(x[2], y[2]) * float(EPSILON["double"])
    if max(abs(x[0] - y[0]), abs(x[1] - y[1])) < 1e-9:
        return float(max(abs(x[3] - y[3]), abs(x[4] - y[4]))) / size
    return max(abs(x[0] - y[0]), abs(x[1] - y[1])) / size


def check_file():
    import jsonschema

    for value in {x for scene in generate.WHOLE.values() for x in scene.values()}:
        if mpf(float(numpy.float32(value))) != mpf(value):
            fail("not exact in single precision:", value)
    text = generate.OUTPUT.read_text()
    schema = json.loads(generate.OUTPUT.with_name("known-answers.schema.json").read_text())
    jsonschema.validate(json.loads(text), schema)
    if text != generate.document():
        fail("the file is not what the generator writes")
    if coefficients.OUTPUT.read_text() != coefficients.document():
        fail("the coefficients are not what the generator writes")


if __name__ == "__main__":
    start, only = time.time(), sys.argv[1:]
    check_file()
    if not only:
        methods, mistakes = tables.read()
        check_tables(methods)
        entries = {**methods, **mistakes}
        written = check_answers(entries)
        check_extras(methods, written)
        check_equations(methods)
        check_effects(mistakes)
        check_distances(written, entries)
    print(f"{len(FAILURES)} wrong, {time.time() - start:.0f} s")
    sys.exit(bool(FAILURES))
