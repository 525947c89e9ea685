/* What the adapters of GSL share: the Jacobian of the pendulum, and its steppers by name. */
#ifndef STRANGERS_GSL_H
#define STRANGERS_GSL_H

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

/* Of theta'' = -g sin theta + a cos(w t). */
static int slopes(double g, double a, double w, double t, const double y[], double *dfdy, double dfdt[]) {
    dfdy[0] = 0;
    dfdy[1] = 1;
    dfdy[2] = -g * cos(y[0]);
    dfdy[3] = 0;
    dfdt[0] = 0;
    dfdt[1] = -a * w * sin(w * t);
    return GSL_SUCCESS;
}

/* The multistep ones stand last: they cannot do without a control of the step. */
enum { ONE_STEP = 9, ALL = 11 };

/* One of the first `count`; NULL if none has this name. Without a name it prints them. */
static const gsl_odeiv2_step_type *find(const char *name, size_t count) {
    const gsl_odeiv2_step_type *known[ALL] = {
        gsl_odeiv2_step_rk2,    gsl_odeiv2_step_rk4,    gsl_odeiv2_step_rkf45,  gsl_odeiv2_step_rkck,
        gsl_odeiv2_step_rk8pd,  gsl_odeiv2_step_rk1imp, gsl_odeiv2_step_rk2imp, gsl_odeiv2_step_rk4imp,
        gsl_odeiv2_step_bsimp,  gsl_odeiv2_step_msbdf,  gsl_odeiv2_step_msadams,
    };
    for (size_t i = 0; i < count; i++) {
        if (name && !strcmp(known[i]->name, name)) return known[i];
        if (!name) printf("%s\n", known[i]->name);
    }
    return NULL;
}

#endif
