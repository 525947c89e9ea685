/* cc -O2 -o verlet verlet.c -lm */
#include <math.h>
#include <stdio.h>
#include <string.h>

int main(void) {
    char line[512];
    double g_over_l, theta, omega, h;
    long n, k;
    while (fgets(line, sizeof line, stdin) && strncmp(line, "bye", 3) != 0) {
        if (strncmp(line, "hello", 5) == 0) {
            puts("hello 1 my verlet");
        } else if (sscanf(line, "pendulum %lf %lf %lf %lf %ld %ld",
                          &g_over_l, &theta, &omega, &h, &n, &k) == 6) {
            double force = -g_over_l * sin(theta);
            long evaluations = 1;
            for (long step = 1; step <= n; step++) {
                omega += h / 2 * force;
                theta += h * omega;
                force = -g_over_l * sin(theta);
                evaluations++;
                omega += h / 2 * force;
                if (step % k == 0) printf("%.17g %.17g\n", theta, omega);
            }
            printf("done %ld\n", evaluations);
        } else {
            puts("unsupported");
        }
        fflush(stdout);
    }
    return 0;
}
