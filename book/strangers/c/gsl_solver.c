/* GSL 2.7.1 (Debian: libgsl-dev 2.7.1+dfsg-5+deb12u1), gsl_odeiv2_driver_apply with the standard
   control. The stepper's name is the argument. Steps end at the times asked for; nothing is
   interpolated, and no events are looked for. */
#include "solver.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

static int right_hand_side(double t, const double y[], double dy[], void *data) {
    rate((struct run *)data, t, y, dy);
    return GSL_SUCCESS;
}

static int jacobian(double t, const double y[], double *dfdy, double dfdt[], void *data) {
    const struct run *run = (const struct run *)data;
    dfdy[0] = 0;
    dfdy[1] = 1;
    dfdy[2] = -run->g * cos(y[0]);
    dfdy[3] = 0;
    dfdt[0] = 0;
    dfdt[1] = -run->a * run->w * sin(run->w * t);
    return GSL_SUCCESS;
}

static const gsl_odeiv2_step_type *find(const char *name) {
    const gsl_odeiv2_step_type *known[] = {
        gsl_odeiv2_step_rk2,    gsl_odeiv2_step_rk4,    gsl_odeiv2_step_rkf45,   gsl_odeiv2_step_rkck,
        gsl_odeiv2_step_rk8pd,  gsl_odeiv2_step_rk1imp, gsl_odeiv2_step_rk2imp,  gsl_odeiv2_step_rk4imp,
        gsl_odeiv2_step_bsimp,  gsl_odeiv2_step_msbdf,  gsl_odeiv2_step_msadams,
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (name && !strcmp(known[i]->name, name)) return known[i];
        if (!name) printf("%s\n", known[i]->name);
    }
    return NULL;
}

/* The first step is a thousandth of the time of a radian of small swings. */
static const char *solve(const char *name, struct run *run, double (*states)[2]) {
    const double scale[2] = {1, sqrt(run->g)};
    double t = run->t0, y[2] = {run->start[0], run->start[1]};
    double first = copysign(1e-3 / scale[1], run->grid[run->n] - t);
    gsl_odeiv2_system system = {right_hand_side, jacobian, 2, run};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_scaled_new(&system, find(name), first, run->tol, run->tol, 1, 0, scale);
    if (!driver) return "gsl_odeiv2_driver_alloc_scaled_new refuses";
    const char *why = NULL;
    for (long i = 0; i < run->n && !why; i++) {
        int status = gsl_odeiv2_driver_apply(driver, &t, run->grid[i + 1], y);
        if (status != GSL_SUCCESS) why = gsl_strerror(status);
        memcpy(states[i], y, sizeof y);
    }
    gsl_odeiv2_driver_free(driver);
    return why;
}

int main(int argc, char **argv) {
    gsl_set_error_handler_off();
    if (argc < 2 || !find(argv[1])) {
        find(NULL);
        return 2;
    }
    return serve(argv[1], solve);
}
