/* GSL 2.7.1 (Debian: libgsl-dev 2.7.1+dfsg-5+deb12u1). The integrator's name is the argument.
   Fixed steps by gsl_odeiv2_step_apply, without control and without evolution. */
#include "protocol.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

static int right_hand_side(double t, const double y[], double dy[], void *data) {
    dy[0] = y[1];
    dy[1] = force((struct pendulum *)data, y[0], t);
    return GSL_SUCCESS;
}

static int jacobian(double t, const double y[], double *dfdy, double dfdt[], void *data) {
    struct pendulum *p = (struct pendulum *)data;
    dfdy[0] = 0;
    dfdy[1] = 1;
    dfdy[2] = -p->gl * cos(y[0]);
    dfdy[3] = 0;
    dfdt[0] = 0;
    dfdt[1] = -p->a * p->w * sin(p->w * t);
    return GSL_SUCCESS;
}

static const gsl_odeiv2_step_type *find(const char *name) {
    const gsl_odeiv2_step_type *known[] = {
        gsl_odeiv2_step_rk2,    gsl_odeiv2_step_rk4,    gsl_odeiv2_step_rkf45,  gsl_odeiv2_step_rkck,
        gsl_odeiv2_step_rk8pd,  gsl_odeiv2_step_rk1imp, gsl_odeiv2_step_rk2imp, gsl_odeiv2_step_rk4imp,
        gsl_odeiv2_step_bsimp,
    };
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (name && !strcmp(known[i]->name, name)) return known[i];
        if (!name) printf("%s\n", known[i]->name);
    }
    return NULL;
}

/* The implicit steppers ask a driver for the accuracy of their Newton
   iteration; no other use is made of it. */
static const char *integrate(const char *name, struct pendulum *p, double theta, double omega,
                             double h, long n, long k, struct path *path) {
    double y[2] = {theta, omega}, error[2];
    gsl_odeiv2_system system = {right_hand_side, jacobian, 2, p};
    gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(&system, find(name), h, 1e-13, 1e-13);
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
    if (argc < 2 || !find(argv[1])) {
        find(NULL);
        return 2;
    }
    return serve(argv[1], integrate, 1);
}
