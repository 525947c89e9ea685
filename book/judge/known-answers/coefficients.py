"""Writes coefficients.json: python3 coefficients.py

The tables as data in double precision, so that a program can take the steps without reading
expressions: an entry a line, in the order of the tables. Numbers are the nearest doubles, in the
fewest digits that read back to them. What is left out: methods that are no table, mistakes that are
another equation or another g/L (the equation is found beside the method), and those that hand on
from step to step what no row shows."""

import ast
import json
import pathlib

import tables
from steps import Method

OUTPUT = pathlib.Path(__file__).with_name("coefficients.json")
# What a step of theirs leaves behind, a row does not show.
HIDDEN = ("first force handed on", "velocity before the last kick")
# The drag of a formula is a parameter, as g/L is.
DRAG = {"0.1*": "c*", "0.999*": "(1-c*h)*"}
OPERATORS = {ast.Add: "+", ast.Sub: "-", ast.Mult: "*", ast.Div: "/"}


def number(x):
    """The nearest double, as JSON has it: 1 for 1.0."""
    x = float(x)
    return int(x) if x == int(x) else x


def row(xs):
    """Numbers without the zeros at their end."""
    xs = [number(x) for x in xs]
    while xs and xs[-1] == 0:
        xs.pop()
    return xs


def postfix(node):
    """An expression as the words of a stack: "q h p * +"."""
    match node:
        case ast.BinOp(left, op, right):
            return [*postfix(left), *postfix(right), OPERATORS[type(op)]]
        case ast.Name(name):
            return [name]
        case ast.Constant(value):
            return [repr(number(value))]
        case ast.Call(ast.Name("f"), [inside]):
            return [*postfix(inside), "f"]
    raise ValueError(ast.dump(node))


def formula(text):
    for drag, parameter in DRAG.items():
        text = text.replace(drag, parameter)
    found = []
    for line in text.strip().splitlines():
        name, expression = line.split("=")
        words = postfix(ast.parse(expression.strip(), mode="eval").body)
        found.append(f"{name.strip()} = {' '.join(words)}")
    return found


def runge_kutta(method, table):
    nodes, a = method.tableau()
    found = {"c": row(nodes), "a": [row(xs) for xs in a], "b": row(method.row("b"))}
    if "a_theta" in table:
        found["a_theta"] = [row(xs) for xs in method.tableau("a_theta")[1]]
    if "b_theta" in table:
        found["b_theta"] = row(method.row("b_theta"))
    if "times" in table:
        found["times"] = row(method.row("times"))
    return found


def splitting(method, table):
    found, elapsed, kicks = [], 0, 0
    times = method.row("times") if "times" in table else None
    for what, length, gradient in tables.alternation(table, method.reader):
        if what == "drift":
            elapsed = elapsed + length
            if length != 0:
                found.append([number(length)])
        elif length != 0:
            at = times[kicks] if times else elapsed
            kicks += 1
            found.append([number(length), number(at), number(gradient or 0)])
    more = {"old_force": True} if "mistake" in table else {}
    return {"moves": found} | more | ({"times": True} if times else {})


def multistep(method, table):
    lists = ("values", "explicit", "implicit")
    return {key: row(method.row(key)) for key in lists if table.get(key)}


def entry(table):
    """The table as data, or None where it is not told here."""
    wrong = "force" in table or "drive" in table or "time" in table or "wrap" in table
    hidden = table.get("mistake") in HIDDEN or "reuse_first" in table or "euler_before" in table
    if wrong or hidden:
        return None
    method = Method(table)
    found = {
        "formula": lambda: {"formula": formula(table["formula"])},
        "rk": lambda: runge_kutta(method, table),
        "rkn": lambda: runge_kutta(method, table),
        "splitting": lambda: splitting(method, table),
        "multistep": lambda: multistep(method, table),
    }.get(method.kind)
    if not found:
        return None
    is_wrong = {"wrong": True} if "of" in table else {}
    return {"name": table["name"], "kind": method.kind} | is_wrong | found()


def line(value):
    return json.dumps(value, ensure_ascii=False, separators=(",", ":"))


def document():
    methods, mistakes = tables.read()
    found = [entry(table) for table in (*methods.values(), *mistakes.values())]
    return "[\n" + ",\n".join(line(x) for x in found if x) + "\n]\n"


if __name__ == "__main__":
    text = document()
    OUTPUT.write_text(text)
    print(f"{len(text.encode())} bytes")
