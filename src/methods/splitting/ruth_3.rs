//! Ruth's symplectic method of order 3.

use crate::methods::splitting::Splitting;
use crate::methods::{Info, MethodInfo};

/// Ruth's method of order 3: three kicks and three drifts, the first symplectic method beyond
/// order 2.
///
/// Order 3, symplectic, not symmetric, three force evaluations a step. R. D. Ruth: A canonical
/// integration technique, *IEEE Transactions on Nuclear Science* 30 (1983), 2669–2671,
/// doi:10.1109/TNS.1983.4332919.
#[derive(Clone, Copy, Debug, Default)]
pub struct Ruth3;

impl Info for Ruth3 {
    fn info(&self) -> MethodInfo {
        MethodInfo {
            title: "Ruth 3",
            aliases: &["Ruth’s third-order method"],
            symplectic: true,
            start_evaluations: 1,
            reference: "R. D. Ruth, IEEE Trans. Nucl. Sci. 30 (1983) 2669",
            ..MethodInfo::new("ruth-3", 3)
        }
    }
}

impl Splitting for Ruth3 {
    const KICKS: &'static [f64] = &[7.0 / 24.0, 3.0 / 4.0, -1.0 / 24.0, 0.0];
    const DRIFTS: &'static [f64] = &[2.0 / 3.0, -2.0 / 3.0, 1.0];
}
