r"""pyhamsys 0.90 as a stranger: python3 pyhamsys.py INTEGRATOR

Fixed steps: SymplecticIntegrator(name, h), a step a call. (integrate() changes
h to a divisor of the interval of its own, and cannot go back.) Kicks that
follow each other at one place are counted as the library asks for them, twice.

What its documentation claims (paths are in site-packages):

* Verlet: order=2 symplectic
  '`Verlet` (order 2, all-purpose), also referred to as Strang or
  Störmer-Verlet splitting [...] designed specifically for the numerical
  integration of Hamiltonian systems, ensuring the preservation of the
  symplectic structure of phase space' (pyhamsys-0.90.dist-info/METADATA:53 and
  47 (the project page))
* FR: order=4 symplectic
  '`FR` (order 4, all-purpose) [...] designed specifically for the numerical
  integration of Hamiltonian systems, ensuring the preservation of the
  symplectic structure of phase space' (pyhamsys-0.90.dist-info/METADATA:55 and
  47 (the project page))
* Yo4: order=4 symplectic
  '`Yo#`: # should be replaced by an even integer, e.g., `Yo6` for 6th order
  symplectic integrator (all-purpose) [...] designed specifically for the
  numerical integration of Hamiltonian systems, ensuring the preservation of
  the symplectic structure of phase space' (pyhamsys-0.90.dist-info/METADATA:57
  and 47 (the project page))
* Yo6: order=6 symplectic
  (the same words)
* Yo8: order=8 symplectic
  (the same words)
* Yos6: order=6 symplectic
  '`Yos6`: (order 6, all-purpose) optimized symplectic integrator (solution A
  from Table 1) [...] designed specifically for the numerical integration of
  Hamiltonian systems, ensuring the preservation of the symplectic structure of
  phase space' (pyhamsys-0.90.dist-info/METADATA:58 and 47 (the project page))
* M2: order=2 symplectic
  '`M2` (order 2, all-purpose) [...] designed specifically for the numerical
  integration of Hamiltonian systems, ensuring the preservation of the
  symplectic structure of phase space' (pyhamsys-0.90.dist-info/METADATA:60 and
  47 (the project page))
* M4: order=4 symplectic
  '`M4` (order 4, all-purpose) [...] designed specifically for the numerical
  integration of Hamiltonian systems, ensuring the preservation of the
  symplectic structure of phase space' (pyhamsys-0.90.dist-info/METADATA:61 and
  47 (the project page))
* EFRL: order=4 symplectic
  '`EFRL` (order 4) optimized for *H* = *A* + *B* [...] designed specifically
  for the numerical integration of Hamiltonian systems, ensuring the
  preservation of the symplectic structure of phase space'
  (pyhamsys-0.90.dist-info/METADATA:63 and 47 (the project page))
* PEFRL: order=4 symplectic
  '`PEFRL` and `VEFRL` (order 4) optimized for *H* = *A*(*p*) + *B*(*q*). For
  `PEFRL`, *chi* should be exp(*h* X<sub>A</sub>)exp(*h* X<sub>B</sub>). For
  `VEFRL`, *chi* should be exp(*h* X<sub>B</sub>)exp(*h* X<sub>A</sub>). [...]
  designed specifically for the numerical integration of Hamiltonian systems,
  ensuring the preservation of the symplectic structure of phase space'
  (pyhamsys-0.90.dist-info/METADATA:64 and 47 (the project page))
* VEFRL: order=4 symplectic
  (the same words)
* BM4: order=4 symplectic
  '`BM4` (order 4, all-purpose) refers to S<sub>6</sub> [...] designed
  specifically for the numerical integration of Hamiltonian systems, ensuring
  the preservation of the symplectic structure of phase space'
  (pyhamsys-0.90.dist-info/METADATA:66 and 47 (the project page))
* BM6: order=6 symplectic
  '`BM6` (order 6, all-purpose) refers to S<sub>10</sub> [...] designed
  specifically for the numerical integration of Hamiltonian systems, ensuring
  the preservation of the symplectic structure of phase space'
  (pyhamsys-0.90.dist-info/METADATA:67 and 47 (the project page))
* RKN4b: order=4 symplectic
  '`RKN4b` (order 4) refers to SRKN<sub>6</sub><sup>*b*</sup> optimized for *H*
  = *A*(*p*) + *B*(*q*). Here *chi* should be exp(*h* X<sub>B</sub>)exp(*h*
  X<sub>A</sub>). [...] designed specifically for the numerical integration of
  Hamiltonian systems, ensuring the preservation of the symplectic structure of
  phase space' (pyhamsys-0.90.dist-info/METADATA:68 and 47 (the project page))
* RKN6b: order=6 symplectic
  '`RKN6b` (order 6) refers to SRKN<sub>11</sub><sup>*b*</sup> optimized for
  *H* = *A*(*p*) + *B*(*q*). Here *chi* should be exp(*h* X<sub>B</sub>)exp(*h*
  X<sub>A</sub>). [...] designed specifically for the numerical integration of
  Hamiltonian systems, ensuring the preservation of the symplectic structure of
  phase space' (pyhamsys-0.90.dist-info/METADATA:69 and 47 (the project page))
* RKN6a: order=6 symplectic
  '`RKN6a` (order 6) refers to SRKN<sub>14</sub><sup>*a*</sup> optimized for
  *H* = *A*(*p*) + *B*(*q*). Here *chi* should be exp(*h* X<sub>A</sub>)exp(*h*
  X<sub>B</sub>). [...] designed specifically for the numerical integration of
  Hamiltonian systems, ensuring the preservation of the symplectic structure of
  phase space' (pyhamsys-0.90.dist-info/METADATA:70 and 47 (the project page))
* ABA104: order=4 symplectic
  '`ABA104` (order (10,4)) optimized for *H* = *A* + &epsilon; *B*. Here *chi*
  should be exp(*h* X<sub>A</sub>)exp(*h* X<sub>B</sub>). [...] designed
  specifically for the numerical integration of Hamiltonian systems, ensuring
  the preservation of the symplectic structure of phase space'
  (pyhamsys-0.90.dist-info/METADATA:72 and 47 (the project page))
* ABA864: order=4 symplectic
  '`ABA864` (order (8,6,4)) optimized for *H* = *A* + &epsilon; *B*. Here *chi*
  should be exp(*h* X<sub>A</sub>)exp(*h* X<sub>B</sub>). [...] designed
  specifically for the numerical integration of Hamiltonian systems, ensuring
  the preservation of the symplectic structure of phase space'
  (pyhamsys-0.90.dist-info/METADATA:73 and 47 (the project page))
* ABA1064: order=4 symplectic
  '`ABA1064` (order (10,6,4)) optimized for *H* = *A* + &epsilon; *B*. Here
  *chi* should be exp(*h* X<sub>A</sub>)exp(*h* X<sub>B</sub>). [...] designed
  specifically for the numerical integration of Hamiltonian systems, ensuring
  the preservation of the symplectic structure of phase space'
  (pyhamsys-0.90.dist-info/METADATA:74 and 47 (the project page))
"""
import sys

from protocol import serve, steps

from pyhamsys.pyhamsys import SymplecticIntegrator

NAME = sys.argv[1]
# H = A(p) + B(q), A the drift and B the kick.  The documentation asks for
# exp(h X_B) exp(h X_A) with these: the kick acts first; with the others the
# drift.
KICK_FIRST = NAME in ("VEFRL", "RKN4b", "RKN6b")


def solve(ask):
    force, count = ask.force(), 0

    def kick(h, t, y):
        nonlocal count
        count += 1
        return y[0], y[1] + float(h) * force(t, y[0])

    def drift(h, y):
        return y[0] + float(h) * y[1], y[1]

    # `chi` is told the time at its end, `chi_star` that at its start; the
    # time itself moves on with the drift.
    def drift_kick(h, t, y):
        return kick(h, t, drift(h, y))

    def kick_drift_end(h, t, y):
        return drift(h, kick(h, t - h, y))

    def kick_drift(h, t, y):
        return drift(h, kick(h, t, y))

    def drift_kick_start(h, t, y):
        return kick(h, t + h, drift(h, y))

    if KICK_FIRST:
        chi, chi_star = kick_drift_end, drift_kick_start
    else:
        chi, chi_star = drift_kick, kick_drift
    method = SymplecticIntegrator(NAME, ask.h)

    def step(i, y):
        return method._integrate_onestep(i * ask.h, y, chi, chi_star)[1]

    return steps(ask, (ask.theta, ask.omega), step), count


serve(f"pyhamsys {NAME}", solve)
