/* GSL 2.7.1 (Debian: libgsl-dev 2.7.1+dfsg-5+deb12u1). The integrator's name is the argument.
   Fixed steps by gsl_odeiv2_step_apply, without control and without evolution. */
#include "gsl.h"
#include "protocol.h"

static int right_hand_side(double t, const double y[], double dy[], void *data) {
    dy[0] = y[1];
    dy[1] = force((struct pendulum *)data, y[0], t);
    return GSL_SUCCESS;
}

static int jacobian(double t, const double y[], double *dfdy, double dfdt[], void *data) {
    const struct pendulum *p = (const struct pendulum *)data;
    return slopes(p->gl, p->a, p->w, t, y, dfdy, dfdt);
}

/* The implicit steppers ask a driver for the accuracy of their Newton
   iteration; no other use is made of it. */
static const char *integrate(const char *name, struct pendulum *p, double theta, double omega,
                             double h, long n, long k, struct path *path) {
    double y[2] = {theta, omega}, error[2];
    gsl_odeiv2_system system = {right_hand_side, jacobian, 2, p};
    gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(&system, find(name, ONE_STEP), h, 1e-13, 1e-13);
    const char *why = NULL;
    for (long i = 0; i < n && !why; i++) {
        int status = gsl_odeiv2_step_apply(driver->s, i * h, h, y, error, NULL, NULL, &system);
        if (status != GSL_SUCCESS) why = gsl_strerror(status);
        if ((i + 1) % k == 0) keep(path, y[0], y[1]);
    }
    gsl_odeiv2_driver_free(driver);
    return why;
}

int main(int argc, char **argv) {
    gsl_set_error_handler_off();
    if (argc < 2 || !find(argv[1], ONE_STEP)) {
        find(NULL, ONE_STEP);
        return 2;
    }
    return serve(argv[1], integrate, 1);
}
