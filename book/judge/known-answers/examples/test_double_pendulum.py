from math import cos, sin

import pendula

def accelerations(state, m1=1.0, m2=1.0, l1=1.0, l2=1.0, g=9.81):  # yours
    theta1, theta2, omega1, omega2 = state
    delta = theta1 - theta2
    den = 2 * m1 + m2 - m2 * cos(2 * delta)
    weight = (2 * m1 + m2) * g * sin(theta1) + m2 * g * sin(theta1 - 2 * theta2)
    turning = l2 * omega2**2 + l1 * omega1**2 * cos(delta)
    upper = (m1 + m2) * (l1 * omega1**2 + g * cos(theta1))
    alpha1 = -(weight + 2 * m2 * sin(delta) * turning) / (l1 * den)
    return alpha1, 2 * sin(delta) * (upper + m2 * l2 * omega2**2 * cos(delta)) / (l2 * den)

def test_accelerations():
    pendula.check_right_hand_side(
        "double-pendulum",
        lambda z: accelerations(z[:4], z.mass1, z.mass2, z.length1, z.length2, z.g),
    ).check()
