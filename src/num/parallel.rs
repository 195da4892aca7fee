//! Independent tasks on threads, with results independent of the number of threads.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;

/// Applies `f` to every index below `total`, on `threads` threads; results are in index order, so they do not depend on
/// the number of threads. `tick` gets the number of finished tasks and the last of them.
pub fn parallel<T: Send>(
    total: usize,
    threads: usize,
    f: impl Fn(usize) -> T + Sync,
    tick: &mut dyn FnMut(usize, &T),
) -> Vec<T> {
    if threads.min(total) < 2 {
        // in a page there are no threads
        let one = |k| {
            let value = f(k);
            tick(k + 1, &value);
            value
        };
        return (0..total).map(one).collect();
    }
    let next = AtomicUsize::new(0);
    let (send, receive) = mpsc::channel();
    let mut slots: Vec<Option<T>> = (0..total).map(|_| None).collect();
    std::thread::scope(|scope| {
        for _ in 0..threads.clamp(1, total.max(1)) {
            let (send, next, f) = (send.clone(), &next, &f);
            scope.spawn(move || {
                loop {
                    let k = next.fetch_add(1, Ordering::Relaxed);
                    if k >= total || send.send((k, f(k))).is_err() {
                        break;
                    }
                }
            });
        }
        drop(send);
        for (done, (k, value)) in receive.iter().enumerate() {
            tick(done + 1, &value);
            slots[k] = Some(value);
        }
    });
    slots.into_iter().flatten().collect()
}
