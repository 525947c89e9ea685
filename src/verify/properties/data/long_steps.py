"""Errors in given numbers of steps, in arithmetic of 60 digits: writes long_steps.csv.

For θ' = q, q' = −sin θ from z₀ to the time 4: method − exact, for Runge–Kutta methods explicit and
implicit, for the discrete gradient, for Cieśliński's and Ratkiewicz's and Deuflhard's methods and
for Taylor series. Nothing is extrapolated: each row is what the formulas lead to in that number of
steps. Each method has the first three numbers of steps with which its error is below 1e-4. The
tables are written out here from the sources once more, or computed, and know nothing of the
library. Needs mpmath.
"""

from itertools import islice

from mpmath import (
    cos,
    findroot,
    floor,
    legendre,
    mp,
    mpf,
    odefun,
    pi,
    polyroots,
    sin,
    tan,
    taylor,
)

mp.dps = 60
END = mpf(4)
STARTS = [("1", "0"), ("-2", "0.5"), ("0.5", "2.5")]
LADDER = [n * 2**k for k in range(14) for n in (2, 3)]


def rate(theta, q):
    return q, -sin(theta)


def combined(weights, slopes):
    return tuple(sum(w * k[i] for w, k in zip(weights, slopes)) for i in (0, 1))


def explicit(rows, weights):
    """Of the rows below the diagonal and the weights of an explicit Runge–Kutta method."""

    def step(z, x):
        slopes = [rate(*z)]
        for row in rows:
            k = combined(row, slopes)
            slopes.append(rate(z[0] + x * k[0], z[1] + x * k[1]))
        k = combined(weights, slopes)
        return z[0] + x * k[0], z[1] + x * k[1]

    return step


def gauss(stages):
    """Collocation at the zeros of Legendre's polynomial: aᵢⱼ integrate Lagrange's polynomials."""
    poly = taylor(lambda y: legendre(stages, 2 * y - 1), 0, stages)[::-1]
    nodes = sorted(polyroots(poly, maxsteps=400, extraprec=400))

    def integral(j, upper):
        coefficients = [mpf(1)]
        for m, node in enumerate(nodes):
            if m != j:
                shifted, lower = coefficients + [mpf(0)], [mpf(0)] + [
                    c * node for c in coefficients
                ]
                coefficients = [(a - b) / (nodes[j] - node) for a, b in zip(shifted, lower)]
        powers = enumerate(reversed(coefficients), 1)
        return sum(c * upper**n / n for n, c in powers)

    table = [[integral(j, c) for j in range(stages)] for c in nodes]
    weights = [integral(j, mpf(1)) for j in range(stages)]

    def step(z, x):
        slopes = [rate(*z)] * stages
        while True:
            new = []
            for row in table:
                k = combined(row, slopes)
                new.append(rate(z[0] + x * k[0], z[1] + x * k[1]))
            change = max(abs(a - b) for k, l in zip(new, slopes) for a, b in zip(k, l))
            slopes = new
            if change < mpf(10) ** -55:
                break
        k = combined(weights, slopes)
        return z[0] + x * k[0], z[1] + x * k[1]

    return step


def two_points(equations):
    """A step whose end solves two equations in the start and the end, by Newton's method."""

    def step(z, x):
        return tuple(findroot(lambda *end: equations(z, end, x), z))

    return step


def trapezoidal(z, end, x):
    return (
        end[0] - z[0] - x * (z[1] + end[1]) / 2,
        end[1] - z[1] + x * (sin(z[0]) + sin(end[0])) / 2,
    )


def discrete_gradient(z, end, x):
    """The difference quotient of the potential −cos θ, as it stands."""
    way = end[0] - z[0]
    mean = (cos(z[0]) - cos(end[0])) / way if way else sin(z[0])
    return end[0] - z[0] - x * (z[1] + end[1]) / 2, end[1] - z[1] + x * mean


def cieslinski_ratkiewicz(z, end, x):
    return discrete_gradient(z, end, 2 * tan(x / 2))


def deuflhard(z, x):
    """Half a kick by θ − sin θ, a rotation about the bottom, half a kick.

    Where the step begins and ends in different wells, the rotation is a kick, a drift and a kick,
    each kick from its own bottom.
    """

    def beyond(theta):
        return theta - 2 * pi * floor(theta / (2 * pi) + mpf(1) / 2)

    theta, q = z
    rest = beyond(theta)
    q += x / 2 * (rest - sin(rest))
    one_well = (rest * cos(x) + q * sin(x), q * cos(x) - rest * sin(x))
    if abs(one_well[0]) < pi:
        q = one_well[1]
        theta += one_well[0] - rest
    else:
        q -= tan(x / 2) * rest
        theta += sin(x) * q
        q -= tan(x / 2) * beyond(theta)
    rest = beyond(theta)
    return theta, q + x / 2 * (rest - sin(rest))


def series(order):
    """s' = cθ', c' = −sθ', order by order."""

    def step(z, x):
        theta, q, s, c = [z[0]], [z[1]], [sin(z[0])], [cos(z[0])]
        for k in range(1, order + 1):
            theta.append(q[k - 1] / k)
            q.append(-s[k - 1] / k)
            s.append(sum(j * theta[j] * c[k - j] for j in range(1, k + 1)) / k)
            c.append(-sum(j * theta[j] * s[k - j] for j in range(1, k + 1)) / k)
        return tuple(sum(a * x**k for k, a in enumerate(of)) for of in (theta, q))

    return step


def row(size, **terms):
    return [mpf(terms.get(f"k{j}", "0")) for j in range(1, size + 1)]


# Dormand, Prince (1980), Table 2.
FIFTH = [
    [mpf(n) / d for n, d in row]
    for row in (
        [(1, 5)],
        [(3, 40), (9, 40)],
        [(44, 45), (-56, 15), (32, 9)],
        [(19372, 6561), (-25360, 2187), (64448, 6561), (-212, 729)],
        [(9017, 3168), (-355, 33), (46732, 5247), (49, 176), (-5103, 18656)],
        [(35, 384), (0, 1), (500, 1113), (125, 192), (-2187, 6784), (11, 84)],
    )
]

# The digits of dop853.f.
EIGHTH = [
    row(1, k1="5.26001519587677318785587544488e-2"),
    row(2, k1="1.97250569845378994544595329183e-2", k2="5.91751709536136983633785987549e-2"),
    row(3, k1="2.95875854768068491816892993775e-2", k3="8.87627564304205475450678981324e-2"),
    row(
        4,
        k1="2.41365134159266685502369798665e-1",
        k3="-8.84549479328286085344864962717e-1",
        k4="9.24834003261792003115737966543e-1",
    ),
    row(
        5,
        k1="3.7037037037037037037037037037e-2",
        k4="1.70828608729473871279604482173e-1",
        k5="1.25467687566822425016691814123e-1",
    ),
    row(
        6,
        k1="3.7109375e-2",
        k4="1.70252211019544039314978060272e-1",
        k5="6.02165389804559606850219397283e-2",
        k6="-1.7578125e-2",
    ),
    row(
        7,
        k1="3.70920001185047927108779319836e-2",
        k4="1.70383925712239993810214054705e-1",
        k5="1.07262030446373284651809199168e-1",
        k6="-1.53194377486244017527936158236e-2",
        k7="8.27378916381402288758473766002e-3",
    ),
    row(
        8,
        k1="6.24110958716075717114429577812e-1",
        k4="-3.36089262944694129406857109825e0",
        k5="-8.68219346841726006818189891453e-1",
        k6="2.75920996994467083049415600797e1",
        k7="2.01540675504778934086186788979e1",
        k8="-4.34898841810699588477366255144e1",
    ),
    row(
        9,
        k1="4.77662536438264365890433908527e-1",
        k4="-2.48811461997166764192642586468e0",
        k5="-5.90290826836842996371446475743e-1",
        k6="2.12300514481811942347288949897e1",
        k7="1.52792336328824235832596922938e1",
        k8="-3.32882109689848629194453265587e1",
        k9="-2.03312017085086261358222928593e-2",
    ),
    row(
        10,
        k1="-9.3714243008598732571704021658e-1",
        k4="5.18637242884406370830023853209e0",
        k5="1.09143734899672957818500254654e0",
        k6="-8.14978701074692612513997267357e0",
        k7="-1.85200656599969598641566180701e1",
        k8="2.27394870993505042818970056734e1",
        k9="2.49360555267965238987089396762e0",
        k10="-3.0467644718982195003823669022e0",
    ),
    row(
        11,
        k1="2.27331014751653820792359768449e0",
        k4="-1.05344954667372501984066689879e1",
        k5="-2.00087205822486249909675718444e0",
        k6="-1.79589318631187989172765950534e1",
        k7="2.79488845294199600508499808837e1",
        k8="-2.85899827713502369474065508674e0",
        k9="-8.87285693353062954433549289258e0",
        k10="1.23605671757943030647266201528e1",
        k11="6.43392746015763530355970484046e-1",
    ),
    row(
        12,
        k1="5.42937341165687622380535766363e-2",
        k6="4.45031289275240888144113950566e0",
        k7="1.89151789931450038304281599044e0",
        k8="-5.8012039600105847814672114227e0",
        k9="3.1116436695781989440891606237e-1",
        k10="-1.52160949662516078556178806805e-1",
        k11="2.01365400804030348374776537501e-1",
        k12="4.47106157277725905176885569043e-2",
    ),
]

METHODS = {
    "dormand-prince": explicit(FIFTH[:-1], FIFTH[-1]),
    "dop853": explicit(EIGHTH[:-1], EIGHTH[-1]),
    "implicit-midpoint": gauss(1),
    "trapezoidal": two_points(trapezoidal),
    "gauss-4": gauss(2),
    "gauss-6": gauss(3),
    "gauss-16": gauss(8),
    "discrete-gradient": two_points(discrete_gradient),
    "cieslinski-ratkiewicz": two_points(cieslinski_ratkiewicz),
    "deuflhard": deuflhard,
    "taylor-24": series(24),
}


def error(step, z, exact, steps):
    try:
        for _ in range(steps):
            z = step(z, END / steps)
    except ValueError:
        # The equations of a step so long have no root nearby.
        return [mp.inf, mp.inf]
    return [a - b for a, b in zip(z, exact)]


with open("long_steps.csv", "w") as out:
    out.write("method,theta0,q0,steps,theta,q\n")
    for start in STARTS:
        z = tuple(mpf(c) for c in start)
        exact = odefun(lambda _, y: [y[1], -sin(y[0])], 0, z, tol=mpf(10) ** -45)(END)
        for name, step in METHODS.items():
            errors = ((n, error(step, z, exact, n)) for n in LADDER)
            small = ((n, e) for n, e in errors if max(map(abs, e)) < mpf("1e-4"))
            for n, (theta, q) in islice(small, 3):
                out.write(
                    f"{name},{start[0]},{start[1]},{n},{mp.nstr(theta, 12)},{mp.nstr(q, 12)}\n"
                )
