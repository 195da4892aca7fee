//! Leaves AVX-512 out of builds below the highest optimisation, the profile `dev` above all: every loop over lanes is
//! compiled once for each vector unit, and this one takes some 20 of 550 s of a whole build, by estimate.

fn main() {
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rustc-check-cfg=cfg(without_avx512)");
    let is =
        |name: &str, values: &[&str]| std::env::var(name).is_ok_and(|value| values.contains(&value.as_str()));
    if is("OPT_LEVEL", &["0", "1", "2"]) && is("CARGO_CFG_TARGET_ARCH", &["x86_64"]) {
        println!("cargo::rustc-cfg=without_avx512");
    }
}
