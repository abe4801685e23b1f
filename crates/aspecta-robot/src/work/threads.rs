//! Work spread over threads, in the order of its items whatever the number of threads.
//!
//! The pool (`rayon`, behind the feature `threads`) sees nothing but a `dyn Fn(usize)`: its machinery is
//! compiled once, not once for each task of each robot's dimensions, which was a seventh of the library's
//! code.

use std::sync::{Mutex, PoisonError};

/// Most tasks that one call is cut into: enough for any machine to stay busy to the end.
const MOST: usize = 512;

/// [f(0), …, f(count − 1)], computed on all threads.
pub fn map_range<R: Send>(count: usize, f: impl Fn(usize) -> R + Sync) -> Vec<R> {
    flat_map_range(count, |k| Some(f(k)))
}

/// The items of f(0), …, f(count − 1), one after the other, computed on all threads.
pub fn flat_map_range<I: IntoIterator<Item: Send>>(
    count: usize,
    f: impl Fn(usize) -> I + Sync,
) -> Vec<I::Item> {
    let each = count.div_ceil(MOST).max(1);
    let parts: Vec<Mutex<Vec<I::Item>>> = (0..count.div_ceil(each)).map(|_| Mutex::default()).collect();
    run(parts.len(), &|k| {
        let part = (k * each..count.min((k + 1) * each)).flat_map(&f).collect();
        *parts[k].lock().unwrap_or_else(PoisonError::into_inner) = part;
    });
    let mut all = Vec::new();
    parts
        .into_iter()
        .for_each(|part| all.append(&mut part.into_inner().unwrap_or_else(PoisonError::into_inner)));
    all
}

/// The items of `f` of each item, one after the other, computed on all threads.
pub fn flat_map<'a, T: Sync, I: IntoIterator<Item: Send>>(
    items: &'a [T],
    f: impl Fn(&'a T) -> I + Sync,
) -> Vec<I::Item> {
    flat_map_range(items.len(), |k| f(&items[k]))
}

/// `f` of each item, in their order, computed on all threads.
pub fn map<T: Sync, R: Send>(items: &[T], f: impl Fn(&T) -> R + Sync) -> Vec<R> {
    map_range(items.len(), |k| f(&items[k]))
}

/// Changes each item by `f`, on all threads.
pub fn update<T: Send>(items: &mut [T], f: impl Fn(&mut T) + Sync) {
    let items: Vec<Mutex<&mut T>> = items.iter_mut().map(Mutex::new).collect();
    run(items.len(), &|k| f(&mut items[k].lock().unwrap_or_else(PoisonError::into_inner)));
}

/// Both results, computed side by side.
pub fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    #[cfg(feature = "threads")]
    return rayon::join(a, b);
    #[cfg(not(feature = "threads"))]
    return (a(), b());
}

/// The number of threads that work is spread over.
pub fn thread_count() -> usize {
    #[cfg(feature = "threads")]
    return rayon::current_num_threads();
    #[cfg(not(feature = "threads"))]
    return 1;
}

/// Does `work` on as many threads, each with a stack of so many bytes; on those there are, where none can be
/// had.
pub fn with_stack<R: Send>(bytes: usize, work: impl FnOnce() -> R + Send) -> R {
    #[cfg(feature = "threads")]
    if let Ok(pool) = rayon::ThreadPoolBuilder::new().num_threads(thread_count()).stack_size(bytes).build() {
        return pool.install(work);
    }
    let _ = bytes;
    work()
}

/// Does task(0), …, task(count − 1), in any order.
fn run(count: usize, task: &(dyn Fn(usize) + Sync)) {
    #[cfg(feature = "threads")]
    {
        use rayon::prelude::*;
        (0..count).into_par_iter().for_each(task);
    }
    #[cfg(not(feature = "threads"))]
    (0..count).for_each(task);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_order_and_every_item_once() {
        for count in [0, 1, 2, MOST - 1, MOST, MOST + 1, 5 * MOST + 3] {
            assert_eq!(map_range(count, |k| k), (0..count).collect::<Vec<_>>());
            let mut items: Vec<usize> = map(&map_range(count, |k| k), |k| 2 * k);
            update(&mut items, |k| *k += 1);
            assert!(items.iter().enumerate().all(|(k, item)| *item == 2 * k + 1) && items.len() == count);
        }
    }
}
