"""How far the library's sines are from the truth, in units of the last place: reads what `cargo
bench --bench sine` prints.

Needs gmpy2, which is MPFR (pip install gmpy2). The truth has 140 bits.
"""

import struct
import sys

import gmpy2

gmpy2.get_context().precision = 140


def number(bits):
    return struct.unpack("<d", int(bits, 16).to_bytes(8, "little"))[0]


def error(value, truth):
    # The unit of the truth's own binade, with a significand of 53 bits: 2^(e - 53) for 2^(e-1) <=
    # |truth| < 2^e.
    return abs(gmpy2.mul_2exp(value - truth, 53 - gmpy2.get_exp(truth)))


worst = {}
for line in sys.stdin:
    name, *bits = line.split()
    x, *values = map(number, bits)
    sine, cosine = gmpy2.sin_cos(gmpy2.mpfr(x))
    row = worst.setdefault(name, [0, (0, 0), (0, 0), (0, 0)])
    row[0] += 1
    for i, (value, truth) in enumerate(zip(values, (sine, cosine, sine)), start=1):
        row[i] = max(row[i], (float(error(gmpy2.mpfr(value), truth)), x))

print(f"{'range':22}{'points':>9}{'sin':>8}{'cos':>8}{'force':>8}   ulp, and the worst x of each")
for name, (points, *errors) in worst.items():
    print(
        f"{name:22}{points:9}" + "".join(f"{e:8.3f}" for e, _ in errors),
        *(repr(x) for _, x in errors),
    )
