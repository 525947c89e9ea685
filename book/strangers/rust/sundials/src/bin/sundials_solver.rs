//! SUNDIALS 7.1.1, as the crate sundials-sys 0.6.2 brings it: CVODE, and ARKODE, with the explicit
//! tables by ERKStep and the diagonally implicit ones by ARKStep with the Jacobian. A step ends at
//! the last time, which is the stop time; those before are interpolated. The bindings leave most of
//! ARKODE out, so it is declared here.

use std::ffi::{c_char, c_int, c_long, c_void, CString};
use std::ptr::null_mut;
use strangers_protocol::solver::{serve, Crossings, Run, Solver, States};
use sundials_sys::{
    CVode, CVodeCreate, CVodeFree, CVodeInit, CVodeRootInit, CVodeSVtolerances, CVodeSetJacFn,
    CVodeSetLinearSolver, CVodeSetMaxNumSteps, CVodeSetStopTime, CVodeSetUserData, N_VDestroy,
    N_VGetArrayPointer, N_VNew_Serial, N_Vector, SUNContext, SUNContext_Create, SUNContext_Free,
    SUNDenseMatrix, SUNDenseMatrix_Column, SUNLinSolFree, SUNLinSol_Dense, SUNLinearSolver,
    SUNMatDestroy, SUNMatrix,
};

type Rhs = unsafe extern "C" fn(f64, N_Vector, N_Vector, *mut c_void) -> c_int;
type Root = unsafe extern "C" fn(f64, N_Vector, *mut f64, *mut c_void) -> c_int;
type Jacobian = unsafe extern "C" fn(
    f64,
    N_Vector,
    N_Vector,
    SUNMatrix,
    *mut c_void,
    N_Vector,
    N_Vector,
    N_Vector,
) -> c_int;

extern "C" {
    fn ERKStepCreate(f: Rhs, t0: f64, y0: N_Vector, context: SUNContext) -> *mut c_void;
    fn ERKStepSetTableName(ark: *mut c_void, name: *const c_char) -> c_int;
    fn ARKStepCreate(
        e: Option<Rhs>,
        i: Option<Rhs>,
        t0: f64,
        y0: N_Vector,
        context: SUNContext,
    ) -> *mut c_void;
    fn ARKStepSetTableName(ark: *mut c_void, dirk: *const c_char, erk: *const c_char) -> c_int;
    fn ARKodeSVtolerances(ark: *mut c_void, relative: f64, absolute: N_Vector) -> c_int;
    fn ARKodeSetLinearSolver(ark: *mut c_void, solver: SUNLinearSolver, matrix: SUNMatrix)
        -> c_int;
    fn ARKodeSetJacFn(ark: *mut c_void, jacobian: Jacobian) -> c_int;
    fn ARKodeSetMaxNumSteps(ark: *mut c_void, most: c_long) -> c_int;
    fn ARKodeSetUserData(ark: *mut c_void, data: *mut c_void) -> c_int;
    fn ARKodeSetStopTime(ark: *mut c_void, stop: f64) -> c_int;
    fn ARKodeRootInit(ark: *mut c_void, count: c_int, root: Root) -> c_int;
    fn ARKodeEvolve(ark: *mut c_void, end: f64, y: N_Vector, t: *mut f64, task: c_int) -> c_int;
    fn ARKodeFree(ark: *mut *mut c_void);
}
/// ARK_NORMAL and CV_NORMAL: to the time, by interpolation.
const NORMAL: c_int = 1;
/// ARK_ROOT_RETURN and CV_ROOT_RETURN.
const AT_A_ROOT: c_int = 2;
const MOST: c_long = 1_000_000;

unsafe fn two<'a>(v: N_Vector) -> &'a mut [f64; 2] {
    &mut *N_VGetArrayPointer(v).cast()
}

unsafe extern "C" fn rate(t: f64, y: N_Vector, rate: N_Vector, data: *mut c_void) -> c_int {
    *two(rate) = (*data.cast::<Run>()).rate(t, *two(y));
    0
}

unsafe extern "C" fn theta(_: f64, y: N_Vector, out: *mut f64, _: *mut c_void) -> c_int {
    *out = two(y)[0];
    0
}

unsafe extern "C" fn jacobian(
    _: f64,
    y: N_Vector,
    _: N_Vector,
    j: SUNMatrix,
    data: *mut c_void,
    _: N_Vector,
    _: N_Vector,
    _: N_Vector,
) -> c_int {
    let gl = (*data.cast::<Run>()).pendulum.gl;
    let [first, second] = [0, 1].map(|k| &mut *SUNDenseMatrix_Column(j, k).cast::<[f64; 2]>());
    *first = [0.0, -gl * two(y)[0].cos()];
    *second = [1.0, 0.0];
    0
}

/// Tells the states at the times of the grid after its first, or those at the roots.
fn walk(
    name: &str,
    run: &Run,
    roots: bool,
    mut tell: impl FnMut(f64, [f64; 2]),
) -> Result<(), String> {
    let method = match name {
        "CVODE_ADAMS" => Some(1),
        "CVODE_BDF" => Some(2),
        _ => None,
    };
    let table = CString::new(format!("ARKODE_{name}")).map_err(|why| why.to_string())?;
    // Everything is freed below; the run outlives the integration.
    unsafe {
        let mut context: SUNContext = null_mut();
        SUNContext_Create(0, &mut context);
        let [y, tolerances] = [N_VNew_Serial(2, context), N_VNew_Serial(2, context)];
        (*two(y), *two(tolerances)) = (run.start, run.each);
        let matrix = SUNDenseMatrix(2, 2, context);
        let solver = SUNLinSol_Dense(y, matrix, context);
        let data: *const Run = run;
        let data: *mut c_void = data.cast_mut().cast();
        let mut status;
        let mut code;
        if let Some(method) = method {
            code = CVodeCreate(method, context);
            status = CVodeInit(code, Some(rate), run.from(), y);
            status |= CVodeSVtolerances(code, run.tol, tolerances);
            status |= CVodeSetUserData(code, data);
            status |= CVodeSetMaxNumSteps(code, MOST);
            status |= CVodeSetLinearSolver(code, solver, matrix);
            status |= CVodeSetJacFn(code, Some(jacobian));
            status |= CVodeSetStopTime(code, run.end());
            if roots {
                status |= CVodeRootInit(code, 1, Some(theta));
            }
        } else {
            let implicit =
                name.contains("DIRK") || name.starts_with("KVAERNO") || name.starts_with("CASH_5");
            if implicit || name.starts_with("TRBDF2") {
                code = ARKStepCreate(None, Some(rate), run.from(), y, context);
                let none = c"ARKODE_ERK_NONE";
                status = ARKStepSetTableName(code, table.as_ptr(), none.as_ptr());
                status |= ARKodeSetLinearSolver(code, solver, matrix);
                status |= ARKodeSetJacFn(code, jacobian);
            } else {
                code = ERKStepCreate(rate, run.from(), y, context);
                status = ERKStepSetTableName(code, table.as_ptr());
            }
            status |= ARKodeSVtolerances(code, run.tol, tolerances);
            status |= ARKodeSetUserData(code, data);
            status |= ARKodeSetMaxNumSteps(code, MOST);
            status |= ARKodeSetStopTime(code, run.end());
            if roots {
                status |= ARKodeRootInit(code, 1, theta);
            }
        }
        let evolve = |until, t: &mut f64| match method {
            Some(_) => CVode(code, until, y, t, NORMAL),
            None => ARKodeEvolve(code, until, y, t, NORMAL),
        };
        let mut t = run.from();
        let times = if roots { &run.grid[run.grid.len() - 1..] } else { &run.grid[1..] };
        for until in times {
            while status >= 0 {
                status = evolve(*until, &mut t);
                if status >= 0 && (!roots || status == AT_A_ROOT) {
                    tell(t, *two(y));
                }
                if status != AT_A_ROOT {
                    break;
                }
            }
        }
        match method {
            Some(_) => CVodeFree(&mut code),
            None => ARKodeFree(&mut code),
        }
        SUNLinSolFree(solver);
        SUNMatDestroy(matrix);
        N_VDestroy(y);
        N_VDestroy(tolerances);
        SUNContext_Free(&mut context);
        if status < 0 {
            Err(format!("SUNDIALS returned {status}"))
        } else {
            Ok(())
        }
    }
}

fn states(name: &str, run: &Run) -> States {
    let mut rows = Vec::new();
    walk(name, run, false, |_, y| rows.push(y))?;
    Ok(rows)
}

fn crossings(name: &str, run: &Run) -> Crossings {
    let mut rows = Vec::new();
    walk(name, run, true, |t, y| rows.push([t, y[0], y[1]]))?;
    Ok(rows)
}

macro_rules! solvers {
    ($($name:ident)*) => {
        vec![$(Solver {
            name: stringify!($name),
            solve: |run| states(stringify!($name), run),
            crossings: Some(|run| crossings(stringify!($name), run)),
        }),*]
    };
}

fn main() {
    serve(solvers![
        CVODE_ADAMS CVODE_BDF
        HEUN_EULER_2_1_2 BOGACKI_SHAMPINE_4_2_3 SHU_OSHER_3_2_3 SOFRONIOU_SPALETTA_5_3_4
        ZONNEVELD_5_3_4 SAYFY_ABURUB_6_3_4 CASH_KARP_6_4_5 FEHLBERG_6_4_5 DORMAND_PRINCE_7_4_5
        ARK548L2SA_ERK_8_4_5 VERNER_8_5_6 VERNER_9_5_6 VERNER_10_6_7 VERNER_13_7_8 FEHLBERG_13_7_8
        VERNER_16_8_9
        SDIRK_2_1_2 TRBDF2_3_3_2 KVAERNO_4_2_3 KVAERNO_5_3_4 KVAERNO_7_4_5 ARK548L2SA_DIRK_8_4_5
        ESDIRK547L2SA_7_4_5
    ]);
}
