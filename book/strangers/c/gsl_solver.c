/* GSL 2.7.1 (Debian: libgsl-dev 2.7.1+dfsg-5+deb12u1), gsl_odeiv2_driver_apply with the standard
   control. The stepper's name is the argument. Steps end at the times asked for; nothing is
   interpolated, and no events are looked for. */
#include "gsl.h"
#include "solver.h"

static int right_hand_side(double t, const double y[], double dy[], void *data) {
    rate((struct run *)data, t, y, dy);
    return GSL_SUCCESS;
}

static int jacobian(double t, const double y[], double *dfdy, double dfdt[], void *data) {
    const struct run *run = (const struct run *)data;
    return slopes(run->g, run->a, run->w, t, y, dfdy, dfdt);
}

/* The first step is a thousandth of the time of a radian of small swings. */
static const char *solve(const char *name, struct run *run, double (*states)[2]) {
    const double scale[2] = {1, sqrt(run->g)};
    double t = run->t0, y[2] = {run->start[0], run->start[1]};
    double first = copysign(1e-3 / scale[1], run->grid[run->n] - t);
    gsl_odeiv2_system system = {right_hand_side, jacobian, 2, run};
    gsl_odeiv2_driver *driver =
        gsl_odeiv2_driver_alloc_scaled_new(&system, find(name, ALL), first, run->tol, run->tol, 1, 0, scale);
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
    if (argc < 2 || !find(argv[1], ALL)) {
        find(NULL, ALL);
        return 2;
    }
    return serve(argv[1], solve);
}
