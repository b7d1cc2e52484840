//! The observed order of convergence: the slope of log error over log step by least squares, with its confidence interval.

use serde::{Deserialize, Serialize};

/// A fitted order of convergence.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ConvergenceOrder {
    /// p of error ∝ step^p.
    pub value: f64,
    /// Half-width of the 95 % confidence interval (Student's t); `None` for two points.
    pub half_width: Option<f64>,
    /// Number of points of the fit.
    pub points: usize,
}

/// 97.5 % quantiles of Student's t with 1, 2, … degrees of freedom.
const STUDENT: [f64; 8] = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306];

/// Fits pairs of step and error. `None` if fewer than two pairs are positive and finite, or all steps are equal.
pub fn fit(pairs: &[(f64, f64)]) -> Option<ConvergenceOrder> {
    let usable = |&&(step, error): &&(f64, f64)| step > 0.0 && error > 0.0 && step.is_finite() && error.is_finite();
    let logs: Vec<(f64, f64)> = pairs.iter().filter(usable).map(|&(step, error)| (step.ln(), error.ln())).collect();
    let n = logs.len() as f64;
    let mean = |of: fn(&(f64, f64)) -> f64| logs.iter().map(of).sum::<f64>() / n;
    let (x, y) = (mean(|pair| pair.0), mean(|pair| pair.1));
    let sxx: f64 = logs.iter().map(|pair| (pair.0 - x).powi(2)).sum();
    if logs.len() < 2 || !(sxx > 0.0) {
        return None;
    }
    let value = logs.iter().map(|pair| (pair.0 - x) * (pair.1 - y)).sum::<f64>() / sxx;
    let half_width = logs.len().checked_sub(3).map(|more| {
        let left: f64 = logs.iter().map(|pair| (pair.1 - y - value * (pair.0 - x)).powi(2)).sum();
        STUDENT[more.min(STUDENT.len() - 1)] * (left / (n - 2.0) / sxx).sqrt()
    });
    Some(ConvergenceOrder { value, half_width, points: logs.len() })
}

/// Fits the finest steps, at most `most` of them, whose errors exceed `floor`, the accuracy of the reference.
pub fn asymptotic(pairs: &[(f64, f64)], most: usize, floor: f64) -> Option<ConvergenceOrder> {
    let mut usable: Vec<_> = pairs.iter().copied().filter(|(_, error)| *error > floor && error.is_finite()).collect();
    usable.sort_by(|a, b| a.0.total_cmp(&b.0));
    usable.truncate(most);
    fit(&usable)
}

impl ConvergenceOrder {
    /// `2.00 ± 0.01`
    pub fn text(&self) -> String {
        match self.half_width {
            Some(width) => format!("{:.2} ± {:.2}", self.value, width),
            None => format!("{:.2}", self.value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn powers(p: f64, noise: &[f64]) -> Vec<(f64, f64)> {
        let pair = |(i, noise): (usize, &f64)| {
            let step = 0.5f64.powi(i as i32);
            (step, 3.0 * step.powf(p) * noise)
        };
        noise.iter().enumerate().map(pair).collect()
    }

    #[test]
    fn an_exact_power_has_an_exact_fit() {
        let order = fit(&powers(2.0, &[1.0; 4])).unwrap();
        assert!((order.value - 2.0).abs() < 1e-12 && order.half_width.unwrap() < 1e-10, "{order:?}");
    }

    #[test]
    fn scatter_widens_the_confidence_interval() {
        // Logs are 0 and ±1 along, e^{0, 0.3, 0} up: slope 0, residuals −0.1, 0.2, −0.1; t(1) √(0.06/1/2).
        let e = std::f64::consts::E;
        let order = fit(&[(1.0 / e, 1.0), (1.0, 0.3f64.exp()), (e, 1.0)]).unwrap();
        assert!(order.value.abs() < 1e-12);
        assert!((order.half_width.unwrap() - 12.706 * 0.03f64.sqrt()).abs() < 1e-9, "{order:?}");
    }

    #[test]
    fn points_at_the_floor_and_failed_runs_are_excluded() {
        let mut pairs = powers(4.0, &[1.0; 5]);
        pairs.push((1e-3, 1e-13));
        pairs.push((2.0, f64::NAN));
        let order = asymptotic(&pairs, 3, 1e-12).unwrap();
        assert!((order.value - 4.0).abs() < 1e-12 && order.points == 3, "{order:?}");
    }

    #[test]
    fn one_point_has_no_order() {
        assert_eq!(fit(&[(1.0, 1.0)]), None);
        assert_eq!(fit(&[(1.0, 1.0), (1.0, 2.0)]), None);
        assert_eq!(fit(&[(1.0, 1.0), (0.5, 0.0)]), None);
    }
}
