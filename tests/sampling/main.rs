//! Lights chosen for a shading point: as often as the density says, for what the BRDF says; on straight, curved, crossing
//! and crowded scratches of every kind of base BRDF, seen from anywhere, in points and in wide pixels.

mod bounces;
#[path = "../support/chi_square.rs"]
mod chi_square;
mod distribution;
mod energy;
#[path = "../support/hosts.rs"]
mod hosts;
mod integrals;
mod many;
mod reverse;
mod scenes;
#[path = "../support/mod.rs"]
mod support;
mod zones;

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

/// What `judge` says of each one, on all cores, in order.
fn each<T: Sync, R: Send>(all: &[T], judge: impl Fn(usize, &T) -> R + Sync) -> Vec<R> {
    let next = AtomicUsize::new(0);
    let results = Mutex::new(Vec::new());
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..cores {
            scope.spawn(|| {
                loop {
                    let i = next.fetch_add(1, Ordering::Relaxed);
                    let Some(one) = all.get(i) else { break };
                    let result = judge(i, one);
                    results.lock().unwrap().push((i, result));
                }
            });
        }
    });
    let mut results = results.into_inner().unwrap();
    results.sort_by_key(|(i, _)| *i);
    results.into_iter().map(|(_, result)| result).collect()
}
