//! What is known of a method.

/// The properties of a method. They are defined once, beside the method's step, and read by every
/// test, table and page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MethodInfo {
    /// Name on the command line and in test names.
    pub name: &'static str,
    /// Name in tables and text.
    pub title: &'static str,
    /// Other names in use for the same method.
    pub aliases: &'static [&'static str],
    /// Order p: the global error of the state is O(hᵖ).
    pub order: u32,
    /// Whether one step preserves area in phase space for every Hamiltonian system.
    pub symplectic: bool,
    /// Whether a step with −h undoes a step with h.
    pub symmetric: bool,
    /// Whether a step solves equations by iteration. The number of evaluations then depends on the
    /// number of sweeps, and where the step is too long for the iteration to converge, every
    /// component of the state is NaN.
    pub implicit: bool,
    /// Force evaluations a step; for an implicit method, those of one sweep of its iteration, which
    /// begins with one more.
    pub force_evaluations: u64,
    /// Force evaluations once, before the first step.
    pub start_evaluations: u64,
    /// Where the method is defined and analysed.
    pub reference: &'static str,
}

impl MethodInfo {
    /// An explicit method of `name` and order p of which nothing else is claimed, with p force
    /// evaluations a step. What is known of it follows by name:
    ///
    /// ```
    /// use pendula::MethodInfo;
    ///
    /// let leapfrog = MethodInfo {
    ///     symplectic: true,
    ///     symmetric: true,
    ///     force_evaluations: 1,
    ///     ..MethodInfo::new("leapfrog", 2)
    /// };
    /// assert_eq!(leapfrog.title, "leapfrog");
    /// ```
    pub const fn new(name: &'static str, order: u32) -> Self {
        Self {
            name,
            title: name,
            aliases: &[],
            order,
            symplectic: false,
            symmetric: false,
            implicit: false,
            force_evaluations: order as u64,
            start_evaluations: 0,
            reference: "",
        }
    }
}

/// A method with a [`MethodInfo`].
pub trait Info {
    /// The properties of the method.
    fn info(&self) -> MethodInfo;
}
