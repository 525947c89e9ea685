"""Checks tables and answers: python3 check.py"""

import functools
import itertools
import json
import sys
import time

import mpmath

import generate
import tables
from arithmetic import Digits, Plain, mpf
from steps import Method, Pendulum, taylor

# What sixty digits leave after the cancellations of the checks.
NOTHING = mpf(10) ** -48


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
    stages = range(len(a))

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
        sums = (abs(sum(b * x for b, x in zip(weights, stage(tree))) - 1 / density(tree)) for tree in trees(n))
        defects.append(max(sums))
    return defects
