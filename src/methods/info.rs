//! What is known of a method.

/// What is known of a method. It stands once, beside the method's step, and every test, table and
/// page reads it there.
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
    /// Whether a step solves equations by iteration. It then takes as many evaluations as the
    /// iteration needs sweeps, and where the step is too long for it to converge, no component of
    /// the state is a number.
    pub implicit: bool,
    /// Force evaluations a step; of an implicit method, a sweep of its iteration, which one
    /// evaluation more begins.
    pub force_evaluations: u64,
    /// Force evaluations once, before the first step.
    pub start_evaluations: u64,
    /// Where the method is defined and analysed.
    pub reference: &'static str,
}

/// A method that can say what is known of it.
pub trait Info {
    /// The method's entry.
    fn info(&self) -> MethodInfo;
}
