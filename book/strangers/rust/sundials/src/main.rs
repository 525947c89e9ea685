//! SUNDIALS 7.1.1, as the crate sundials-sys 0.6.2 brings it: ARKODE with fixed steps, the
//! symplectic partitioned methods by SPRKStep and the explicit tables by ERKStep. The bindings
//! leave both modules out, so they are declared here.

use std::ffi::{CString, c_char, c_int, c_long, c_void};
use strangers_protocol::{Integrator, Path, Pendulum, Request, serve};
use sundials_sys::{
    N_VDestroy, N_VGetArrayPointer, N_VNew_Serial, N_Vector, SUNContext, SUNContext_Create,
    SUNContext_Free,
};

type Rhs = unsafe extern "C" fn(f64, N_Vector, N_Vector, *mut c_void) -> c_int;

extern "C" {
    fn SPRKStepCreate(f1: Rhs, f2: Rhs, t0: f64, y0: N_Vector, context: SUNContext) -> *mut c_void;
    fn SPRKStepSetMethodName(ark: *mut c_void, name: *const c_char) -> c_int;
    fn ERKStepCreate(f: Rhs, t0: f64, y0: N_Vector, context: SUNContext) -> *mut c_void;
    fn ERKStepSetTableName(ark: *mut c_void, name: *const c_char) -> c_int;
    fn ARKodeSetFixedStep(ark: *mut c_void, h: f64) -> c_int;
    fn ARKodeSetMaxNumSteps(ark: *mut c_void, most: c_long) -> c_int;
    fn ARKodeSetUserData(ark: *mut c_void, data: *mut c_void) -> c_int;
    fn ARKodeEvolve(ark: *mut c_void, end: f64, y: N_Vector, t: *mut f64, task: c_int) -> c_int;
    fn ARKodeFree(ark: *mut *mut c_void);
}
const ONE_STEP: c_int = 2;

unsafe fn two<'a>(v: N_Vector) -> &'a mut [f64; 2] {
    &mut *N_VGetArrayPointer(v).cast()
}

/// The momentum's rate, by the coordinate.
unsafe extern "C" fn kick(t: f64, y: N_Vector, rate: N_Vector, data: *mut c_void) -> c_int {
    two(rate)[1] = (*data.cast::<Pendulum>()).force(two(y)[0], t);
    0
}

/// The coordinate's rate, by the momentum.
unsafe extern "C" fn drift(_: f64, y: N_Vector, rate: N_Vector, _: *mut c_void) -> c_int {
    two(rate)[0] = two(y)[1];
    0
}

unsafe extern "C" fn both(t: f64, y: N_Vector, rate: N_Vector, data: *mut c_void) -> c_int {
    drift(t, y, rate, data) + kick(t, y, rate, data)
}

fn steps(name: &str, pendulum: &Pendulum, asked: &Request) -> Path {
    let table = CString::new(format!("ARKODE_{name}")).map_err(|why| why.to_string())?;
    let mut path = Vec::with_capacity(asked.n);
    // Everything is freed below; the pendulum outlives the integration.
    unsafe {
        let mut context: SUNContext = std::ptr::null_mut();
        SUNContext_Create(0, &mut context);
        let y = N_VNew_Serial(2, context);
        *two(y) = [asked.theta, asked.omega];
        let (mut ark, mut status);
        if name.starts_with("SPRK") {
            ark = SPRKStepCreate(kick, drift, 0.0, y, context);
            status = SPRKStepSetMethodName(ark, table.as_ptr());
        } else {
            ark = ERKStepCreate(both, 0.0, y, context);
            status = ERKStepSetTableName(ark, table.as_ptr());
        }
        let data: *const Pendulum = pendulum;
        status |= ARKodeSetUserData(ark, data.cast_mut().cast());
        status |= ARKodeSetFixedStep(ark, asked.h);
        status |= ARKodeSetMaxNumSteps(ark, -1);
        let mut t = 0.0;
        while status >= 0 && path.len() < asked.n {
            status = ARKodeEvolve(ark, asked.n as f64 * asked.h, y, &mut t, ONE_STEP);
            path.push(*two(y));
        }
        ARKodeFree(&mut ark);
        N_VDestroy(y);
        SUNContext_Free(&mut context);
        if status < 0 { Err(format!("ARKODE answers {status}")) } else { Ok(path) }
    }
}

fn main() {
    let names = [
        "SPRK_EULER_1_1",
        "SPRK_LEAPFROG_2_2",
        "SPRK_PSEUDO_LEAPFROG_2_2",
        "SPRK_RUTH_3_3",
        "SPRK_MCLACHLAN_2_2",
        "SPRK_MCLACHLAN_3_3",
        "SPRK_CANDY_ROZMUS_4_4",
        "SPRK_MCLACHLAN_4_4",
        "SPRK_MCLACHLAN_5_6",
        "SPRK_YOSHIDA_6_8",
        "SPRK_SUZUKI_UMENO_8_16",
        "SPRK_SOFRONIOU_10_36",
        "FORWARD_EULER_1_1",
        "RALSTON_EULER_2_1_2",
        "EXPLICIT_MIDPOINT_EULER_2_1_2",
        "HEUN_EULER_2_1_2",
        "ARK2_ERK_3_1_2",
        "BOGACKI_SHAMPINE_4_2_3",
        "ARK324L2SA_ERK_4_2_3",
        "SHU_OSHER_3_2_3",
        "KNOTH_WOLKE_3_3",
        "SOFRONIOU_SPALETTA_5_3_4",
        "ZONNEVELD_5_3_4",
        "ARK436L2SA_ERK_6_3_4",
        "ARK437L2SA_ERK_7_3_4",
        "SAYFY_ABURUB_6_3_4",
        "CASH_KARP_6_4_5",
        "FEHLBERG_6_4_5",
        "DORMAND_PRINCE_7_4_5",
        "ARK548L2SA_ERK_8_4_5",
        "ARK548L2SAb_ERK_8_4_5",
        "VERNER_8_5_6",
        "VERNER_9_5_6",
        "VERNER_10_6_7",
        "VERNER_13_7_8",
        "FEHLBERG_13_7_8",
        "VERNER_16_8_9",
    ];
    let one =
        |name| Integrator::new(name, true, move |pendulum, asked| steps(name, pendulum, asked));
    serve(names.map(one).into());
}
