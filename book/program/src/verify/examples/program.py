import sys
from math import sin

for line in sys.stdin:
    word, *numbers = line.split()
    if word == "hello":
        print("hello 1 my verlet")
    elif word == "pendulum":
        g_over_l, theta, omega, h = map(float, numbers[:4])
        n, k = map(int, numbers[4:])
        force, evaluations = -g_over_l * sin(theta), 1
        for step in range(1, n + 1):
            omega += h / 2 * force
            theta += h * omega
            force, evaluations = -g_over_l * sin(theta), evaluations + 1
            omega += h / 2 * force
            if step % k == 0:
                print(theta, omega)
        print("done", evaluations)
    elif word == "bye":
        break
    else:
        print("unsupported")
    sys.stdout.flush()
