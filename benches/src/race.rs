//! Several programs in turn, round after round, so that other load on the machine affects all of them alike.

use fem_output::quantile;
use serde::Serialize;

use crate::end::End;

/// Seconds per step.
#[derive(Clone, Copy, Debug, Serialize)]
pub struct Time {
    /// Wall-clock time.
    pub wall: f64,
    /// Processor time.
    pub cpu: f64,
}

/// A timed program.
pub type Contestant<'a> = Box<dyn Fn() -> Result<Time, End> + 'a>;

/// The median of each contestant's times.
pub fn race(rounds: usize, contestants: &[Contestant]) -> Result<Vec<Time>, End> {
    let mut times = vec![Vec::with_capacity(rounds); contestants.len()];
    for _ in 0..rounds {
        for (contestant, times) in contestants.iter().zip(&mut times) {
            times.push(contestant()?);
        }
    }
    Ok(times.iter().map(|times| median(times)).collect())
}

/// Medians of wall-clock and processor times.
fn median(times: &[Time]) -> Time {
    let of = |which: fn(&Time) -> f64| {
        let values: Vec<f64> = times.iter().map(which).collect();
        quantile(&values, 0.5).unwrap_or(f64::NAN)
    };
    Time { wall: of(|time| time.wall), cpu: of(|time| time.cpu) }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;

    #[test]
    fn contestants_run_in_turn_and_keep_their_medians() {
        let log = RefCell::new(String::new());
        let contestant = |name: char, times: [f64; 3]| -> Contestant {
            let log = &log;
            Box::new(move || {
                let round = log.borrow().matches(name).count();
                log.borrow_mut().push(name);
                Ok(Time { wall: times[round], cpu: 2.0 * times[round] })
            })
        };
        let times = race(3, &[contestant('a', [5.0, 1.0, 2.0]), contestant('b', [7.0, 9.0, 8.0])]).unwrap();
        assert_eq!(*log.borrow(), "ababab");
        assert_eq!(times.iter().map(|time| (time.wall, time.cpu)).collect::<Vec<_>>(), [(2.0, 4.0), (8.0, 16.0)]);
    }
}
