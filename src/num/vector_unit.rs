//! One place where loops over lanes are given to the vector unit of the machine.

use pulp::WithSimd;

/// Runs `op` as it was compiled for the widest vector unit that the machine turns out to have; the binary stays
/// portable.
///
/// WebAssembly has no way to ask, and its vectors of two doubles gain nothing over single ones (measured: equal times
/// within 3 %), so that the page carries each loop once.
#[inline]
pub fn on_vector_unit<Op: WithSimd>(op: Op) -> Op::Output {
    #[cfg(not(target_arch = "wasm32"))]
    return pulp::Arch::new().dispatch(op);
    #[cfg(target_arch = "wasm32")]
    return pulp::Simd::vectorize(pulp::Scalar, op);
}
