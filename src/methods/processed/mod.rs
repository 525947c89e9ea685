//! Processed methods: a cheap kernel that takes the steps, between a change of variables before the
//! first step and its inverse where somebody looks.
//!
//! A kernel K and a processor π make the method π K π⁻¹, and n steps of it are π Kⁿ π⁻¹: what is in
//! the middle cancels. So the processor may cost what it will, and the kernel needs to meet only
//! those order conditions that no change of variables can meet for it. J. C. Butcher called this
//! the *effective order* of K (*Lecture Notes in Mathematics* 109 (1969) 133–139).
//!
//! The kernels here kick with the force and its gradient along itself, for systems with a
//! [`ForceGradient`](crate::systems::ForceGradient). The processor is that of
//! [`Processor`](crate::systems::Processor): it preserves area and is even in the step, so that the
//! whole method is as symplectic and symmetric as its kernel. What an observer sees is processed;
//! where nobody looks the compiler removes it.

pub(crate) mod processed_4;
pub(crate) mod processed_6;

pub use processed_4::Processed4;
pub use processed_6::Processed6;
