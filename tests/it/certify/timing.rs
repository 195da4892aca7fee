//! `cargo test --release --test it certify::timing -- --ignored --nocapture`

use std::time::Instant;

use equipod::methods::solve::certify::distinct;

use super::support::{pose, problems};

#[test]
#[ignore = "a measurement"]
#[allow(clippy::print_stdout)]
fn microseconds_per_certificate() {
    for p in problems() {
        let poses: Vec<_> = p.roots.iter().map(pose).collect();
        let mut times: Vec<f64> = (0..301)
            .map(|_| {
                let start = Instant::now();
                let certifier = p.certifier();
                for pose in &poses {
                    std::hint::black_box(certifier.certify(std::hint::black_box(pose)));
                }
                start.elapsed().as_secs_f64() * 1e6 / poses.len() as f64
            })
            .collect();
        times.sort_by(f64::total_cmp);
        let certificates = p.certificates();
        let start = Instant::now();
        for _ in 0..100 {
            std::hint::black_box(distinct(std::hint::black_box(&certificates)));
        }
        let apart = start.elapsed().as_secs_f64() * 1e4;
        println!("{:16} {:6.2} us a root, {apart:6.2} us to tell all apart", p.name, times[150]);
    }
}
