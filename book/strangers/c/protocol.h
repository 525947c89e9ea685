/* The judge's text protocol, version 1, for C and C++: one integrator a
   program. An adapter defines `integrate` and calls `serve` from main. */
#ifndef STRANGERS_PROTOCOL_H
#define STRANGERS_PROTOCOL_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* theta'' = -gl sin theta + a cos(w t); `forces` counts its evaluations. */
struct pendulum {
    double gl, a, w;
    long forces;
};

static inline double force(struct pendulum *p, double theta, double t) {
    p->forces++;
    double f = -p->gl * sin(theta);
    return p->a != 0.0 ? f + p->a * cos(p->w * t) : f;
}

/* y = theta, omega. After k, 2k, ... n steps of h `integrate` calls keep.
   It returns NULL, or why it could not. */
struct path {
    double *states;
    long kept, room;
};

static inline void keep(struct path *path, double theta, double omega) {
    if (path->kept == path->room) return;
    path->states[2 * path->kept] = theta;
    path->states[2 * path->kept + 1] = omega;
    path->kept++;
}

typedef const char *integrate_t(const char *name, struct pendulum *p, double theta,
                                double omega, double h, long n, long k, struct path *path);

/* drives: does this integrator know the time of its stages? */
static inline int serve(const char *name, integrate_t *integrate, int drives) {
    char line[4096];
    while (fgets(line, sizeof line, stdin)) {
        struct pendulum p = {0, 0, 0, 0};
        double theta, omega, h;
        long n, k;
        if (!strncmp(line, "bye", 3)) return 0;
        if (!strncmp(line, "hello ", 6)) {
            printf("hello 1 %s\n", name);
        } else if (sscanf(line, "pendulum %lf %lf %lf %lf %ld %ld", &p.gl, &theta, &omega, &h, &n, &k) == 6 ||
                   (drives && sscanf(line, "driven %lf %lf %lf %lf %lf %lf %ld %ld", &p.gl, &p.a, &p.w,
                                     &theta, &omega, &h, &n, &k) == 8)) {
            if (n < 1 || k < 1 || n % k) {
                printf("error k must divide n\n");
            } else {
                struct path path = {(double *)malloc(2 * sizeof(double) * (size_t)(n / k)), 0, n / k};
                const char *why = integrate(name, &p, theta, omega, h, n, k, &path);
                if (why) {
                    printf("error %s\n", why);
                } else {
                    for (long i = 0; i < path.kept; i++)
                        printf("%.17g %.17g\n", path.states[2 * i], path.states[2 * i + 1]);
                    printf("done %ld\n", p.forces);
                }
                free(path.states);
            }
        } else {
            printf("unsupported\n");
        }
        fflush(stdout);
    }
    return 0;
}

#endif
