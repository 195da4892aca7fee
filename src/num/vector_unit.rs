//! The single place at which loops over lanes use the vector unit of the machine.

use pulp::WithSimd;

/// Runs `op` compiled for the widest vector unit available at run time; the binary stays portable.
///
/// WebAssembly has no run-time detection, and its vectors of two doubles are not faster than single ones (measured:
/// equal times within 3 %). The page therefore has each loop once. Builds of little optimisation know AVX2 at most.
#[inline]
pub fn on_vector_unit<Op: WithSimd>(op: Op) -> Op::Output {
    #[cfg(target_arch = "wasm32")]
    return pulp::Simd::vectorize(pulp::Scalar, op);
    #[cfg(without_avx512)]
    return match pulp::x86::V3::try_new() {
        Some(unit) => pulp::Simd::vectorize(unit, op),
        None => pulp::Simd::vectorize(pulp::Scalar, op),
    };
    #[cfg(not(any(target_arch = "wasm32", without_avx512)))]
    return pulp::Arch::new().dispatch(op);
}
