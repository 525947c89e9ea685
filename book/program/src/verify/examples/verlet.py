import pendula


def verlet(force, theta, omega, h):
    omega += h / 2 * force(theta)
    theta += h * omega
    return theta, omega + h / 2 * force(theta)


report = pendula.judge(verlet, "order=2 symplectic symmetric")
print(report)
report.check()
