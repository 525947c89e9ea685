/* The judge's text protocol, version 1, for C and C++, of solvers that choose
   their steps: one solver a program. An adapter defines `solve` and calls
   `serve` from main. */
#ifndef STRANGERS_SOLVER_H
#define STRANGERS_SOLVER_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* theta'' = -g sin theta + a cos(w t); `count` counts its evaluations. */
struct run {
    double g, a, w;
    double start[2]; /* theta, omega */
    double t0, tol;
    double each[2];     /* the tolerance of theta and of omega, for a library that takes two */
    const double *grid; /* where the run begins, and then each of the times once */
    long n;             /* the times behind the first */
    long count;
};

static inline void rate(struct run *run, double t, const double y[2], double dy[2]) {
    run->count++;
    double force = -run->g * sin(y[0]);
    dy[0] = y[1];
    dy[1] = run->a != 0.0 ? force + run->a * cos(run->w * t) : force;
}

/* Writes theta and omega at grid[1] to grid[n]. It returns NULL, or why it could not. */
typedef const char *solve_t(const char *name, struct run *run, double (*states)[2]);

/* The times as a grid, or why they are none. */
static inline const char *times(struct run *run, double *grid, const double *asked, long count) {
    grid[0] = run->t0;
    run->grid = grid;
    run->n = 0;
    for (long i = 0; i < count; i++)
        if (asked[i] != grid[run->n]) grid[++run->n] = asked[i];
    /* A library that hangs with these, or takes them for others, is not asked. */
    for (long i = 0; i <= run->n; i++)
        if (!isfinite(grid[i])) return "a time is not finite";
    for (long i = 2; i <= run->n; i++)
        if ((grid[i] > grid[i - 1]) != (grid[1] > grid[0])) return "the times turn round";
    return NULL;
}

static inline void answer(const char *name, solve_t *solve, struct run *run, const double *asked,
                          long count) {
    double *grid = (double *)malloc(sizeof(double) * (size_t)(count + 1));
    double(*states)[2] = (double(*)[2])calloc((size_t)(count + 1), sizeof *states);
    const char *why = count < 1 ? "no time is asked for" : times(run, grid, asked, count);
    /* A run of no length is left to no library. */
    if (!why && run->n > 0) why = solve(name, run, states + 1);
    if (why) {
        printf("error %s\n", why);
    } else {
        memcpy(states[0], run->start, sizeof run->start);
        for (long i = 0, at = 0; i < count; i++) {
            if (asked[i] != grid[at]) at++;
            printf("%.17g %.17g\n", states[at][0], states[at][1]);
        }
        printf("done %ld\n", run->count);
    }
    free(grid);
    free(states);
}

static inline int serve(const char *name, solve_t *solve) {
    char *line = NULL;
    size_t room = 0;
    while (getline(&line, &room, stdin) > 0) {
        int driven = !strncmp(line, "driven-solve ", 13);
        if (!strncmp(line, "bye", 3)) break;
        if (!strncmp(line, "hello ", 6)) {
            printf("hello 1 %s\n", name);
        } else if (driven || !strncmp(line, "solve ", 6)) {
            double *x = (double *)malloc(sizeof(double) * (strlen(line) / 2 + 1));
            char *at = strchr(line, ' '), *end;
            long count = 0, k = driven ? 3 : 1;
            for (double value = strtod(at, &end); end != at; value = strtod(at = end, &end))
                x[count++] = value;
            if (count < k + 4) {
                printf("error numbers are missing\n");
            } else {
                double a = driven ? x[1] : 0, w = driven ? x[2] : 0, tol = x[k + 3];
                struct run run = {x[0], a, w, {x[k], x[k + 1]}, x[k + 2], tol, {tol, tol * sqrt(fabs(x[0]))},
                                  NULL, 0, 0};
                answer(name, solve, &run, x + k + 4, count - k - 4);
            }
            free(x);
        } else {
            printf("unsupported\n");
        }
        fflush(stdout);
    }
    free(line);
    return 0;
}

#endif
