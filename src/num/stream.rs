//! Results of many jobs from several threads, in order, as they are done.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Condvar, Mutex, MutexGuard, PoisonError};

/// A switch that ends a long computation from outside; clones share it. Running jobs finish; no new ones begin.
///
/// ```
/// # mod equipod { pub use equipod_num::Cancel; pub mod methods { pub use equipod_num::poly; } }
/// let cancel = equipod::Cancel::new();
/// let from_another_thread = cancel.clone();
/// from_another_thread.cancel();
/// assert!(cancel.is_cancelled());
/// ```
#[derive(Debug, Clone, Default)]
pub struct Cancel(Arc<AtomicBool>);

impl Cancel {
    /// A new switch, not cancelled.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Cancels the computation. It cannot be undone.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether it is cancelled.
    #[must_use]
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }
}

/// Number of jobs per worker that may run ahead of the next returned result. It bounds both the delay by a slow job and
/// the memory of waiting results.
const AHEAD: usize = 16;

type Outcome<T> = Result<T, Box<dyn std::any::Any + Send>>;
type Job<I, T> = Arc<dyn Fn(I) -> T + Send + Sync>;

/// The inputs, and the number of returned results.
struct Queue<I> {
    inputs: Box<dyn Iterator<Item = I> + Send>,
    taken: usize,
    handed_out: usize,
    ended: bool,
}

struct Shared<I> {
    queue: Mutex<Queue<I>>,
    moved: Condvar,
    ahead: usize,
    cancel: Cancel,
}

impl<I> Shared<I> {
    /// A panic of the inputs leaves the queue unchanged, so the next caller continues.
    fn lock(&self) -> MutexGuard<'_, Queue<I>> {
        self.queue.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The next input with its number, if there is one and it is not too far ahead.
    fn next(&self) -> Option<(usize, I)> {
        let mut queue = self.lock();
        while !queue.ended && queue.taken >= queue.handed_out + self.ahead {
            queue = self.moved.wait(queue).unwrap_or_else(PoisonError::into_inner);
        }
        if queue.ended || self.cancel.is_cancelled() {
            return None;
        }
        let input = queue.inputs.next()?;
        queue.taken += 1;
        Some((queue.taken - 1, input))
    }

    fn end(&self) {
        self.lock().ended = true;
        self.moved.notify_all();
    }

    fn hand_out(&self) {
        self.lock().handed_out += 1;
        self.moved.notify_all();
    }
}

/// The results of `job` for all inputs, in the order of the inputs. It ends early after cancellation; dropping it
/// cancels it.
#[allow(missing_debug_implementations, reason = "a job is a function")]
pub struct Stream<I, T> {
    shared: Arc<Shared<I>>,
    job: Job<I, T>,
    /// `None` if the calling thread does the work.
    arriving: Option<Receiver<(usize, Outcome<T>)>>,
    waiting: BTreeMap<usize, T>,
    next: usize,
}

impl<I: Send + 'static, T: Send + 'static> Stream<I, T> {
    /// Starts `workers` threads; with one, the calling thread does the work on request.
    pub fn new(
        inputs: impl Iterator<Item = I> + Send + 'static,
        workers: usize,
        cancel: Cancel,
        job: impl Fn(I) -> T + Send + Sync + 'static,
    ) -> Self {
        let queue = Queue { inputs: Box::new(inputs), taken: 0, handed_out: 0, ended: false };
        let shared =
            Shared { queue: Mutex::new(queue), moved: Condvar::new(), ahead: AHEAD * workers.max(1), cancel };
        let (shared, job): (_, Job<I, T>) = (Arc::new(shared), Arc::new(job));
        let arriving = (workers > 1).then(|| {
            let (sender, receiver) = channel();
            for _ in 0..workers {
                let (shared, job, sender) = (shared.clone(), job.clone(), sender.clone());
                std::thread::spawn(move || work(&shared, &job, &sender));
            }
            receiver
        });
        Self { shared, job, arriving, waiting: BTreeMap::new(), next: 0 }
    }
}

fn work<I, T>(shared: &Shared<I>, job: &Job<I, T>, sender: &Sender<(usize, Outcome<T>)>) {
    while let Some((i, input)) = shared.next() {
        let result = catch_unwind(AssertUnwindSafe(|| job(input)));
        if sender.send((i, result)).is_err() {
            return; // no receiver is left
        }
    }
}

impl<I, T> Iterator for Stream<I, T> {
    type Item = T;

    fn next(&mut self) -> Option<T> {
        let Some(arriving) = &self.arriving else {
            // no space in the queue is needed after cancellation
            if self.shared.cancel.is_cancelled() {
                return None;
            }
            let input = self.shared.lock().inputs.next()?;
            return Some((self.job)(input));
        };
        if self.shared.cancel.is_cancelled() {
            return None;
        }
        loop {
            if let Some(result) = self.waiting.remove(&self.next) {
                self.next += 1;
                self.shared.hand_out();
                return Some(result);
            }
            // all workers have ended: the inputs are used up, or the stream was cancelled
            let (i, result) = arriving.recv().ok()?;
            match result {
                Ok(result) => self.waiting.insert(i, result),
                // a panic in a worker continues in the caller
                Err(payload) => resume_unwind(payload),
            };
        }
    }
}

impl<I, T> Drop for Stream<I, T> {
    fn drop(&mut self) {
        self.shared.end();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::AtomicUsize;
    use std::time::Duration;

    fn squares(workers: usize, cancel: &Cancel) -> Stream<u64, u64> {
        Stream::new(0..200, workers, cancel.clone(), |k| {
            if k % 7 == 0 {
                std::thread::sleep(Duration::from_micros(200));
            }
            k * k
        })
    }

    #[test]
    fn results_come_in_the_order_of_the_inputs_whatever_the_threads() {
        let expected: Vec<u64> = (0..200).map(|k| k * k).collect();
        for workers in [0, 1, 2, 7] {
            assert_eq!(squares(workers, &Cancel::new()).collect::<Vec<_>>(), expected, "{workers}");
        }
        let none = Stream::new(std::iter::empty::<u64>(), 3, Cancel::new(), |k| k);
        assert_eq!(none.count(), 0);
    }

    #[test]
    fn a_cancelled_stream_ends_and_a_dropped_one_lets_its_threads_go() {
        for workers in [1, 3] {
            let cancel = Cancel::new();
            let mut stream = squares(workers, &cancel);
            assert_eq!((stream.next(), stream.next()), (Some(0), Some(1)));
            cancel.cancel();
            assert_eq!(stream.next(), None, "{workers}");
        }
        let started = Arc::new(AtomicUsize::new(0));
        let count = started.clone();
        let mut endless = Stream::new(0.., 2, Cancel::new(), move |k: u64| {
            count.fetch_add(1, Ordering::Relaxed);
            k
        });
        assert_eq!(endless.next(), Some(0));
        drop(endless);
        // each thread holds a clone until it ends
        for _ in 0..500 {
            if Arc::strong_count(&started) == 1 {
                break;
            }
            std::thread::sleep(Duration::from_millis(10));
        }
        assert_eq!(Arc::strong_count(&started), 1);
        assert!(started.load(Ordering::Relaxed) <= 1 + 2 * AHEAD);
    }

    #[test]
    fn a_slow_job_does_not_pile_up_the_others() {
        let done = Arc::new(AtomicUsize::new(0));
        let (seen, count) = (done.clone(), done.clone());
        let mut stream = Stream::new(0..1000, 2, Cancel::new(), move |k: u64| {
            if k == 0 {
                while seen.load(Ordering::Relaxed) + 1 < 2 * AHEAD {
                    std::thread::sleep(Duration::from_millis(1));
                }
                std::thread::sleep(Duration::from_millis(20));
            }
            count.fetch_add(1, Ordering::Relaxed);
            k
        });
        assert_eq!(stream.next(), Some(0));
        assert!(done.load(Ordering::Relaxed) <= 2 * AHEAD + 2);
        assert_eq!(stream.count(), 999);
    }

    #[test]
    fn a_panic_in_a_job_goes_on_in_the_caller() {
        for workers in [1, 3] {
            let result = catch_unwind(|| {
                let job = |k: u64| if k == 40 { panic!("forty") } else { k };
                Stream::new(0..1000, workers, Cancel::new(), job).count()
            });
            assert_eq!(result.unwrap_err().downcast_ref(), Some(&"forty"), "{workers}");
        }
    }
}
