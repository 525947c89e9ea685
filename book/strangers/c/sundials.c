/* SUNDIALS 6.4.1 (Debian: libsundials-dev 6.4.1+dfsg1-3), ARKODE with fixed steps: every explicit
   table by ERKStep and every diagonally implicit one by ARKStep. The table's name is the argument. */
#include "protocol.h"

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

static const struct {
    const char *name;
    int id;
} tables[] = {
#define TABLE(name) {#name, ARKODE_##name}
    TABLE(HEUN_EULER_2_1_2),      TABLE(BOGACKI_SHAMPINE_4_2_3), TABLE(ARK324L2SA_ERK_4_2_3),
    TABLE(ZONNEVELD_5_3_4),       TABLE(ARK436L2SA_ERK_6_3_4),   TABLE(SAYFY_ABURUB_6_3_4),
    TABLE(CASH_KARP_6_4_5),       TABLE(FEHLBERG_6_4_5),         TABLE(DORMAND_PRINCE_7_4_5),
    TABLE(ARK548L2SA_ERK_8_4_5),  TABLE(VERNER_8_5_6),           TABLE(FEHLBERG_13_7_8),
    TABLE(KNOTH_WOLKE_3_3),       TABLE(ARK437L2SA_ERK_7_3_4),   TABLE(ARK548L2SAb_ERK_8_4_5),
    TABLE(SDIRK_2_1_2),           TABLE(BILLINGTON_3_3_2),       TABLE(TRBDF2_3_3_2),
    TABLE(KVAERNO_4_2_3),         TABLE(ARK324L2SA_DIRK_4_2_3),  TABLE(CASH_5_2_4),
    TABLE(CASH_5_3_4),            TABLE(SDIRK_5_3_4),            TABLE(KVAERNO_5_3_4),
    TABLE(ARK436L2SA_DIRK_6_3_4), TABLE(KVAERNO_7_4_5),          TABLE(ARK548L2SA_DIRK_8_4_5),
    TABLE(ARK437L2SA_DIRK_7_3_4), TABLE(ARK548L2SAb_DIRK_8_4_5), TABLE(ESDIRK324L2SA_4_2_3),
    TABLE(ESDIRK325L2SA_5_2_3),   TABLE(ESDIRK32I5L2SA_5_2_3),   TABLE(ESDIRK436L2SA_6_3_4),
    TABLE(ESDIRK43I6L2SA_6_3_4),  TABLE(QESDIRK436L2SA_6_3_4),   TABLE(ESDIRK437L2SA_7_3_4),
    TABLE(ESDIRK547L2SA_7_4_5),   TABLE(ESDIRK547L2SA2_7_4_5),
};
enum { COUNT = sizeof tables / sizeof *tables };

static int find(const char *name) {
    for (int i = 0; i < COUNT; i++)
        if (!strcmp(tables[i].name, name)) return tables[i].id;
    return -1;
}

static int right_hand_side(realtype t, N_Vector y, N_Vector dy, void *data) {
    NV_Ith_S(dy, 0) = NV_Ith_S(y, 1);
    NV_Ith_S(dy, 1) = force((struct pendulum *)data, NV_Ith_S(y, 0), t);
    return 0;
}

static int jacobian(realtype t, N_Vector y, N_Vector fy, SUNMatrix j, void *data, N_Vector a,
                    N_Vector b, N_Vector c) {
    SM_ELEMENT_D(j, 0, 0) = 0;
    SM_ELEMENT_D(j, 0, 1) = 1;
    SM_ELEMENT_D(j, 1, 0) = -((struct pendulum *)data)->gl * cos(NV_Ith_S(y, 0));
    SM_ELEMENT_D(j, 1, 1) = 0;
    return 0;
}

static const char *integrate(const char *name, struct pendulum *p, double theta, double omega,
                             double h, long n, long k, struct path *path) {
    int id = find(name), explicit = id < ARKODE_MIN_DIRK_NUM, failed = 0;
    SUNContext context;
    SUNContext_Create(NULL, &context);
    N_Vector y = N_VNew_Serial(2, context);
    NV_Ith_S(y, 0) = theta;
    NV_Ith_S(y, 1) = omega;
    SUNMatrix matrix = SUNDenseMatrix(2, 2, context);
    SUNLinearSolver solver = SUNLinSol_Dense(y, matrix, context);
    void *ark;
    if (explicit) {
        ark = ERKStepCreate(right_hand_side, 0, y, context);
        failed |= ERKStepSetUserData(ark, p);
        failed |= ERKStepSetTableNum(ark, (ARKODE_ERKTableID)id);
        failed |= ERKStepSetFixedStep(ark, h);
    } else {
        ark = ARKStepCreate(NULL, right_hand_side, 0, y, context);
        failed |= ARKStepSetUserData(ark, p);
        failed |= ARKStepSetTableNum(ark, (ARKODE_DIRKTableID)id, ARKODE_ERK_NONE);
        failed |= ARKStepSetFixedStep(ark, h);
        failed |= ARKStepSStolerances(ark, 1e-13, 1e-13); /* of the Newton iteration */
        failed |= ARKStepSetMaxNonlinIters(ark, 20);
        failed |= ARKStepSetLinearSolver(ark, solver, matrix);
        failed |= ARKStepSetJacFn(ark, jacobian);
    }
    double t;
    for (long i = 0; i < n && !failed; i++) {
        failed = (explicit ? ERKStepEvolve : ARKStepEvolve)(ark, n * h, y, &t, ARK_ONE_STEP) < 0;
        if ((i + 1) % k == 0) keep(path, NV_Ith_S(y, 0), NV_Ith_S(y, 1));
    }
    (explicit ? ERKStepFree : ARKStepFree)(&ark);
    SUNLinSolFree(solver);
    SUNMatDestroy(matrix);
    N_VDestroy(y);
    SUNContext_Free(&context);
    return failed ? "ARKODE failed" : NULL;
}

int main(int argc, char **argv) {
    if (argc < 2 || find(argv[1]) < 0) {
        for (int i = 0; i < COUNT; i++) printf("%s\n", tables[i].name);
        return 2;
    }
    return serve(argv[1], integrate, 1);
}
