//! Work that several threads share. rayon compiles its queues and its care for panics anew for each closure, which made a tenth of the
//! engine's code; here it is compiled once, and every task is one indirect call. Work is divided in the same way whatever the number of threads.

/// Calls both, side by side if a thread is free.
pub fn join<A: Send, B: Send>(first: impl FnOnce() -> A + Send, second: impl FnOnce() -> B + Send) -> (A, B) {
    let (mut first, mut second) = (Some(first), Some(second));
    let (mut a, mut b) = (None, None);
    both(&mut || a = first.take().map(|work| work()), &mut || b = second.take().map(|work| work()));
    match (a, b) {
        (Some(a), Some(b)) => (a, b),
        _ => unreachable!("both have been called, and the panic of one goes on from there"),
    }
}

fn both(first: &mut (dyn FnMut() + Send), second: &mut (dyn FnMut() + Send)) {
    rayon::join(first, second);
}

/// Work on a part, given the number of its first item.
pub type Work<'a, X> = &'a (dyn Fn(usize, &mut [X]) + Sync);

/// The same for parts of two slices.
pub type WorkOfTwo<'a, X, Y> = &'a (dyn Fn(usize, &mut [X], &mut [Y]) + Sync);

/// Calls `work` for parts of `len` items each.
pub fn over_parts<X: Send>(items: &mut [X], len: usize, work: Work<X>) {
    over_parts_from(0, items, len, work);
}

fn over_parts_from<X: Send>(first: usize, items: &mut [X], len: usize, work: Work<X>) {
    if items.len() <= len {
        return work(first, items);
    }
    let middle = items.len().div_ceil(len) / 2 * len;
    let (left, right) = items.split_at_mut(middle);
    join(|| over_parts_from(first, left, len, work), || over_parts_from(first + middle, right, len, work));
}

/// The same for two slices of the same length.
pub fn over_parts_of_two<X: Send, Y: Send>((x, y): (&mut [X], &mut [Y]), len: usize, work: WorkOfTwo<X, Y>) {
    over_two_from(0, (x, y), len, work);
}

fn over_two_from<X: Send, Y: Send>(first: usize, (x, y): (&mut [X], &mut [Y]), len: usize, work: WorkOfTwo<X, Y>) {
    if x.len() <= len {
        return work(first, x, y);
    }
    let middle = x.len().div_ceil(len) / 2 * len;
    let ((x, x_right), (y, y_right)) = (x.split_at_mut(middle), y.split_at_mut(middle));
    join(|| over_two_from(first, (x, y), len, work), || over_two_from(first + middle, (x_right, y_right), len, work));
}

/// Combines the results of parts of `len` items each at most.
pub fn reduce<X: Sync, R: Send>(items: &[X], len: usize, of: &(dyn Fn(&[X]) -> R + Sync), combine: fn(R, R) -> R) -> R {
    if items.len() <= len {
        return of(items);
    }
    let (left, right) = items.split_at(items.len() / 2);
    let (left, right) = join(|| reduce(left, len, of, combine), || reduce(right, len, of, combine));
    combine(left, right)
}
