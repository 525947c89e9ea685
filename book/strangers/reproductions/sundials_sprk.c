/* SUNDIALS: q' = p, p' = cos t, both 0 at t = 0, so q(1) = 1 - cos 1, by SPRKStep's leapfrog. */
#include <arkode/arkode_sprkstep.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#define AT(y, i) NV_Ith_S(y, i)
static int asked;
static int drift(double t, N_Vector y, N_Vector dy, void *_) { return AT(dy, 0) = AT(y, 1), 0; }
static int kick(double t, N_Vector y, N_Vector dy, void *_) {
    if (asked++ == 1) printf("in the step from 0 to 0.1 the force is asked at t = %g\n", t);
    return AT(dy, 1) = cos(t), 0;
}
int main(void) {
    for (int n = 10; n <= 40; n *= 2) {
        SUNContext context;
        SUNContext_Create(SUN_COMM_NULL, &context);
        N_Vector y = N_VNew_Serial(2, context);
        double t, q = 0, p = 0, h = 1.0 / n;
        void *sprk = (N_VConst(0, y), SPRKStepCreate(kick, drift, 0, y, context));
        SPRKStepSetMethodName(sprk, "ARKODE_SPRK_LEAPFROG_2_2"), ARKodeSetFixedStep(sprk, h);
        ARKodeSetStopTime(sprk, 1), ARKodeEvolve(sprk, 1, y, &t, ARK_NORMAL);
        for (int i = 0; i < n; i++) q += h / 2 * p, p += h * cos((i + 0.5) * h), q += h / 2 * p;
        printf("%d steps: %.9f, leapfrog %.9f, right %.9f\n", n, AT(y, 0), q, 1 - cos(1));
    }
}
