//! Creep and its bound.

use fem_engine::plasticity::Additive;
use fem_engine::tensor::{Tensor, dot, zero};

use crate::experiments::flat::plasticity::relaxation::relaxation;
use crate::experiments::mistake::Mistake;

/// The elastic strain at constant strain after half a second.
pub fn creep() -> Result<Mistake, String> {
    let found = relaxation(0.05)?;
    let at = found.instants.iter().find(|at| at.time >= 0.5 - 1e-9).ok_or("the relaxation is too short")?;
    Ok(Mistake {
        rule: "creep flows by the whole strain",
        right: "by the elastic excess over the yield",
        quantity: "|εᵉ| after 0.5 s of constant strain".to_owned(),
        theirs: at.theirs,
        ours: at.elastic,
        truth: at.closed_form,
        tolerance: 1e-6,
    })
}

const YIELD: f64 = 0.05;
const MAXIMUM: f64 = 0.1;

/// The plastic strain of a body that is stretched in both directions until its bound stops it.
pub fn cap() -> Mistake {
    let strain: Tensor<f64> = [[0.3, 0.0, 0.0], [0.0, 0.3, 0.0], [0.0; 3]];
    let mut of = Additive { mu: 1.0, lambda: 1.0, plastic: zero(), is_in_plane: true };
    for _ in 0..100 {
        of.plastic = of.flow(&strain, YIELD, 0.1, MAXIMUM).0.plastic;
    }
    Mistake {
        rule: "the cap compares another norm than the yield",
        right: "one norm",
        quantity: "bounded |εᵖ| over the maximum".to_owned(),
        theirs: spectral_cap() / MAXIMUM,
        ours: dot(&of.plastic, &of.plastic).sqrt() / MAXIMUM,
        truth: 1.0,
        tolerance: 1e-12,
    }
}

/// |εᵖ| in the Frobenius norm, whose bound is on its largest eigenvalue; equal strains along x and y.
fn spectral_cap() -> f64 {
    let (strain, mut plastic) = (0.3, 0.0f64);
    for _ in 0..100 {
        if (strain - plastic) * 2f64.sqrt() > YIELD {
            plastic = (plastic + 0.1 * (strain - plastic)).min(MAXIMUM);
        }
    }
    plastic * 2f64.sqrt()
}
