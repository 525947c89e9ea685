/* SUNDIALS 6.4.1 (Debian: libsundials-dev 6.4.1+dfsg1-3), ARKODE with fixed steps: every explicit
   table by ERKStep and every diagonally implicit one by ARKStep. The table's name is the argument. */
/* Claims, as quoted from that version:
 *   HEUN_EULER_2_1_2: order=2. “ARKODE_HEUN_EULER_2_1_2 = ARKODE_MIN_ERK_NUM, … int q;           method order
 *     of accuracy … q = 2” (arkode/arkode_butcher_erk.h:72; arkode/arkode_butcher.h:32; the loaded table)
 *   BOGACKI_SHAMPINE_4_2_3: order=3. “ARKODE_BOGACKI_SHAMPINE_4_2_3, … int q;           method order of
 *     accuracy … q = 3” (arkode/arkode_butcher_erk.h:73; arkode/arkode_butcher.h:32; the loaded table)
 *   ARK324L2SA_ERK_4_2_3: order=3. “ARKODE_ARK324L2SA_ERK_4_2_3, … int q;           method order of accuracy
 *     … q = 3” (arkode/arkode_butcher_erk.h:74; arkode/arkode_butcher.h:32; the loaded table)
 *   ZONNEVELD_5_3_4: order=4. “ARKODE_ZONNEVELD_5_3_4, … int q;           method order of accuracy … q = 4”
 *     (arkode/arkode_butcher_erk.h:75; arkode/arkode_butcher.h:32; the loaded table)
 *   ARK436L2SA_ERK_6_3_4: order=4. “ARKODE_ARK436L2SA_ERK_6_3_4, … int q;           method order of accuracy
 *     … q = 4” (arkode/arkode_butcher_erk.h:76; arkode/arkode_butcher.h:32; the loaded table)
 *   SAYFY_ABURUB_6_3_4: order=4. “ARKODE_SAYFY_ABURUB_6_3_4, … int q;           method order of accuracy … q
 *     = 4” (arkode/arkode_butcher_erk.h:77; arkode/arkode_butcher.h:32; the loaded table)
 *   CASH_KARP_6_4_5: order=5. “ARKODE_CASH_KARP_6_4_5, … int q;           method order of accuracy … q = 5”
 *     (arkode/arkode_butcher_erk.h:78; arkode/arkode_butcher.h:32; the loaded table)
 *   FEHLBERG_6_4_5: order=5. “ARKODE_FEHLBERG_6_4_5, … int q;           method order of accuracy … q = 5”
 *     (arkode/arkode_butcher_erk.h:79; arkode/arkode_butcher.h:32; the loaded table)
 *   DORMAND_PRINCE_7_4_5: order=5. “ARKODE_DORMAND_PRINCE_7_4_5, … int q;           method order of accuracy
 *     … q = 5” (arkode/arkode_butcher_erk.h:80; arkode/arkode_butcher.h:32; the loaded table)
 *   ARK548L2SA_ERK_8_4_5: order=5. “ARKODE_ARK548L2SA_ERK_8_4_5, … int q;           method order of accuracy
 *     … q = 5” (arkode/arkode_butcher_erk.h:81; arkode/arkode_butcher.h:32; the loaded table)
 *   VERNER_8_5_6: order=6. “ARKODE_VERNER_8_5_6, … int q;           method order of accuracy … q = 6”
 *     (arkode/arkode_butcher_erk.h:82; arkode/arkode_butcher.h:32; the loaded table)
 *   FEHLBERG_13_7_8: order=8. “ARKODE_FEHLBERG_13_7_8, … int q;           method order of accuracy … q = 8”
 *     (arkode/arkode_butcher_erk.h:83; arkode/arkode_butcher.h:32; the loaded table)
 *   KNOTH_WOLKE_3_3: order=3. “ARKODE_KNOTH_WOLKE_3_3, … int q;           method order of accuracy … q = 3”
 *     (arkode/arkode_butcher_erk.h:84; arkode/arkode_butcher.h:32; the loaded table)
 *   ARK437L2SA_ERK_7_3_4: order=4. “ARKODE_ARK437L2SA_ERK_7_3_4, … int q;           method order of accuracy
 *     … q = 4” (arkode/arkode_butcher_erk.h:85; arkode/arkode_butcher.h:32; the loaded table)
 *   ARK548L2SAb_ERK_8_4_5: order=5. “ARKODE_ARK548L2SAb_ERK_8_4_5, … int q;           method order of
 *     accuracy … q = 5” (arkode/arkode_butcher_erk.h:86; arkode/arkode_butcher.h:32; the loaded table)
 *   SDIRK_2_1_2: order=2. “ARKODE_SDIRK_2_1_2 = ARKODE_MIN_DIRK_NUM, … int q;           method order of
 *     accuracy … q = 2” (arkode/arkode_butcher_dirk.h:72; arkode/arkode_butcher.h:32; the loaded table)
 *   BILLINGTON_3_3_2: order=2. “ARKODE_BILLINGTON_3_3_2, … int q;           method order of accuracy … q = 2”
 *     (arkode/arkode_butcher_dirk.h:73; arkode/arkode_butcher.h:32; the loaded table)
 *   TRBDF2_3_3_2: order=2. “ARKODE_TRBDF2_3_3_2, … int q;           method order of accuracy … q = 2”
 *     (arkode/arkode_butcher_dirk.h:74; arkode/arkode_butcher.h:32; the loaded table)
 *   KVAERNO_4_2_3: order=3. “ARKODE_KVAERNO_4_2_3, … int q;           method order of accuracy … q = 3”
 *     (arkode/arkode_butcher_dirk.h:75; arkode/arkode_butcher.h:32; the loaded table)
 *   ARK324L2SA_DIRK_4_2_3: order=3. “ARKODE_ARK324L2SA_DIRK_4_2_3, … int q;           method order of
 *     accuracy … q = 3” (arkode/arkode_butcher_dirk.h:76; arkode/arkode_butcher.h:32; the loaded table)
 *   CASH_5_2_4: order=4. “ARKODE_CASH_5_2_4, … int q;           method order of accuracy … q = 4”
 *     (arkode/arkode_butcher_dirk.h:77; arkode/arkode_butcher.h:32; the loaded table)
 *   CASH_5_3_4: order=4. “ARKODE_CASH_5_3_4, … int q;           method order of accuracy … q = 4”
 *     (arkode/arkode_butcher_dirk.h:78; arkode/arkode_butcher.h:32; the loaded table)
 *   SDIRK_5_3_4: order=4. “ARKODE_SDIRK_5_3_4, … int q;           method order of accuracy … q = 4”
 *     (arkode/arkode_butcher_dirk.h:79; arkode/arkode_butcher.h:32; the loaded table)
 *   KVAERNO_5_3_4: order=4. “ARKODE_KVAERNO_5_3_4, … int q;           method order of accuracy … q = 4”
 *     (arkode/arkode_butcher_dirk.h:80; arkode/arkode_butcher.h:32; the loaded table)
 *   ARK436L2SA_DIRK_6_3_4: order=4. “ARKODE_ARK436L2SA_DIRK_6_3_4, … int q;           method order of
 *     accuracy … q = 4” (arkode/arkode_butcher_dirk.h:81; arkode/arkode_butcher.h:32; the loaded table)
 *   KVAERNO_7_4_5: order=5. “ARKODE_KVAERNO_7_4_5, … int q;           method order of accuracy … q = 5”
 *     (arkode/arkode_butcher_dirk.h:82; arkode/arkode_butcher.h:32; the loaded table)
 *   ARK548L2SA_DIRK_8_4_5: order=5. “ARKODE_ARK548L2SA_DIRK_8_4_5, … int q;           method order of
 *     accuracy … q = 5” (arkode/arkode_butcher_dirk.h:83; arkode/arkode_butcher.h:32; the loaded table)
 *   ARK437L2SA_DIRK_7_3_4: order=4. “ARKODE_ARK437L2SA_DIRK_7_3_4, … int q;           method order of
 *     accuracy … q = 4” (arkode/arkode_butcher_dirk.h:84; arkode/arkode_butcher.h:32; the loaded table)
 *   ARK548L2SAb_DIRK_8_4_5: order=5. “ARKODE_ARK548L2SAb_DIRK_8_4_5, … int q;           method order of
 *     accuracy … q = 5” (arkode/arkode_butcher_dirk.h:85; arkode/arkode_butcher.h:32; the loaded table)
 *   ESDIRK324L2SA_4_2_3: order=3. “ARKODE_ESDIRK324L2SA_4_2_3, … int q;           method order of accuracy …
 *     q = 3” (arkode/arkode_butcher_dirk.h:86; arkode/arkode_butcher.h:32; the loaded table)
 *   ESDIRK325L2SA_5_2_3: order=3. “ARKODE_ESDIRK325L2SA_5_2_3, … int q;           method order of accuracy …
 *     q = 3” (arkode/arkode_butcher_dirk.h:87; arkode/arkode_butcher.h:32; the loaded table)
 *   ESDIRK32I5L2SA_5_2_3: order=3. “ARKODE_ESDIRK32I5L2SA_5_2_3, … int q;           method order of accuracy
 *     … q = 3” (arkode/arkode_butcher_dirk.h:88; arkode/arkode_butcher.h:32; the loaded table)
 *   ESDIRK436L2SA_6_3_4: order=4. “ARKODE_ESDIRK436L2SA_6_3_4, … int q;           method order of accuracy …
 *     q = 4” (arkode/arkode_butcher_dirk.h:89; arkode/arkode_butcher.h:32; the loaded table)
 *   ESDIRK43I6L2SA_6_3_4: order=4. “ARKODE_ESDIRK43I6L2SA_6_3_4, … int q;           method order of accuracy
 *     … q = 4” (arkode/arkode_butcher_dirk.h:90; arkode/arkode_butcher.h:32; the loaded table)
 *   QESDIRK436L2SA_6_3_4: order=4. “ARKODE_QESDIRK436L2SA_6_3_4, … int q;           method order of accuracy
 *     … q = 4” (arkode/arkode_butcher_dirk.h:91; arkode/arkode_butcher.h:32; the loaded table)
 *   ESDIRK437L2SA_7_3_4: order=4. “ARKODE_ESDIRK437L2SA_7_3_4, … int q;           method order of accuracy …
 *     q = 4” (arkode/arkode_butcher_dirk.h:92; arkode/arkode_butcher.h:32; the loaded table)
 *   ESDIRK547L2SA_7_4_5: order=5. “ARKODE_ESDIRK547L2SA_7_4_5, … int q;           method order of accuracy …
 *     q = 5” (arkode/arkode_butcher_dirk.h:93; arkode/arkode_butcher.h:32; the loaded table)
 *   ESDIRK547L2SA2_7_4_5: order=5. “ARKODE_ESDIRK547L2SA2_7_4_5, … int q;           method order of accuracy
 *     … q = 5” (arkode/arkode_butcher_dirk.h:94; arkode/arkode_butcher.h:32; the loaded table)
 */
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
