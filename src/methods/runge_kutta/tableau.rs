//! Explicit Runge–Kutta methods as tables of coefficients.
//!
//! A [`Tableau`] is data. From one table the macro `tableau!` generates both that data, with the
//! digits as its source has them, and straight-line code that evaluates the stages: no loop, no
//! index, no product with zero.

/// A coefficient of a tableau.
#[derive(Clone, Copy, Debug)]
pub struct Coefficient {
    /// The nearest f64, which the step uses.
    pub value: f64,
    /// As the source has it, a fraction or all its digits: for tests of the rounding of the f64.
    pub written: &'static str,
}

/// A stage, k = f(t + c h, z + h Σ aⱼ kⱼ), or a weighted sum of stages.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The name of the stage or of the sum.
    pub name: &'static str,
    /// The node c of a stage, in steps; a sum has none.
    pub node: Option<Coefficient>,
    /// The stages with a non-zero coefficient, by name, and that coefficient.
    pub terms: &'static [(&'static str, Coefficient)],
}

/// The coefficients of an explicit Runge–Kutta method, or of stages added to one.
#[derive(Clone, Copy, Debug)]
pub struct Tableau {
    /// The stages that are already known: k₁ = f(t, z), or those of another tableau.
    pub known: &'static [&'static str],
    /// The stages, in the order in which they are evaluated.
    pub stages: &'static [Row],
    /// The weighted sums of them: the step itself, error estimates, dense output.
    pub sums: &'static [Row],
}

impl Tableau {
    /// The largest sum of a row's |coefficients|: a bound on the displacement of a stage or a sum,
    /// in steps.
    pub const fn reach(&self) -> f64 {
        Row::longest(self.stages).max(Row::longest(self.sums))
    }
}

impl Row {
    const fn longest(rows: &[Self]) -> f64 {
        let (mut longest, mut i) = (0.0_f64, 0);
        while i < rows.len() {
            let (mut sum, mut j) = (0.0, 0);
            while j < rows[i].terms.len() {
                sum += rows[i].terms[j].1.value.abs();
                j += 1;
            }
            longest = f64::max(longest, sum);
            i += 1;
        }
        longest
    }
}

/// Generates from a table the `struct $Stages`, with a function `evaluate` for the stages and a
/// method for each sum, and the table as data, `$TABLEAU`.
macro_rules! tableau {
    (
        $(#[$doc:meta])*
        $Stages:ident, $TABLEAU:ident, from [$($known:ident),+];
        stages {$(
            $k:ident at $c:expr => { $k_first:ident: $a_first:expr, $($k_other:ident: $a:expr,)* }
        )*}
        sums {$(
            $(#[$sum_doc:meta])*
            $sum:ident => { $b_of:ident: $b_first:expr, $($b_other:ident: $b:expr,)* }
        )+}
    ) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug)]
        pub struct $Stages<D> {
            $(#[doc = "A stage known before."] pub $known: D,)+
            $(#[doc = "A stage."] pub $k: D,)*
        }

        impl<D: $crate::Vector> $Stages<D> {
            /// Evaluates the stages of a step `h` (s) from `z` at time `t` (s), given the known
            /// ones.
            #[inline(always)]
            #[allow(unused_variables, reason = "where no stage is added, nothing is evaluated")]
            pub fn evaluate<S>(
                system: &S,
                t: f64,
                h: f64,
                z: S::State,
                known: [D; [$(stringify!($known)),+].len()],
            ) -> Self
            where
                S: $crate::System<State: $crate::State<Displacement = D>>,
            {
                let [$($known),+] = known;
                $(
                    let slope = $k_first * const { $a_first } $(+ $k_other * const { $a })*;
                    let $k = system.rate(t + const { $c } * h, z + slope * h);
                )*
                Self { $($known,)+ $($k,)* }
            }

            $(
                $(#[$sum_doc])*
                #[inline(always)]
                pub fn $sum(&self) -> D {
                    self.$b_of * const { $b_first } $(+ self.$b_other * const { $b })*
                }
            )+
        }

        $(#[$doc])*
        pub const $TABLEAU: Tableau = Tableau {
            known: &[$(stringify!($known)),+],
            stages: &[$(
                row!($k, Some(coefficient!($c)),
                    $k_first: $a_first, $($k_other: $a,)*),
            )*],
            sums: &[$(
                row!($sum, None, $b_of: $b_first, $($b_other: $b,)*),
            )+],
        };
    };
}

macro_rules! row {
    ($name:ident, $node:expr, $($k:ident: $a:expr,)+) => {
        Row {
            name: stringify!($name),
            node: $node,
            terms: &[$((stringify!($k), coefficient!($a))),+],
        }
    };
}

macro_rules! coefficient {
    ($a:expr) => {
        Coefficient { value: $a, written: stringify!($a) }
    };
}

pub(crate) use coefficient;
pub(crate) use row;
pub(crate) use tableau;
