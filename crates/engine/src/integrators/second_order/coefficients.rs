//! The coefficients of a step, which define a method of this family.

/// A linear combination of the quantities at the start of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Combination {
    /// Factor of the velocity.
    pub velocity: f64,
    /// Factor of the acceleration.
    pub acceleration: f64,
    /// Factor of the displacement increment of the step before.
    pub increment: f64,
    /// Factor of the velocity at the start of the step before.
    pub earlier_velocity: f64,
}

/// One step of `dt` seconds as an equation for the increment z from its start to a stage within it:
/// M (z − ẑ)/τ² + C v_s + ∇V(u₀ + z) = f_o, with the stage's velocity v_s = (1 − θ) v₀ + θ v₁. At its end, u₁ = u₀ + z/θ,
/// v₁ = `velocity` + k a_s and a₁ = `acceleration` + `of_acceleration` a_s, with the stage's acceleration a_s = (z − ẑ)/τ².
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficients {
    /// τ, s.
    pub tau: f64,
    /// θ, the part of the step before the stage.
    pub stage: f64,
    /// ẑ, m.
    pub inertial: Combination,
    /// The part of v₁ that is known at the start, m/s.
    pub velocity: Combination,
    /// k, s.
    pub of_velocity: f64,
    /// The factor of a₀ in a₁, and that of a_s; zero for methods that keep no acceleration.
    pub acceleration: [f64; 2],
    /// κ, the multiple of the forces of obstacles in the equation.
    pub obstacles: f64,
    /// The time for which the end's forces of obstacles act beyond that of the step in `velocity` + k a_s; v₁ takes their impulse back, s.
    pub beyond: f64,
}

impl Coefficients {
    /// g, the stage's velocity being g (z − ž)/τ.
    pub fn stage_velocity(&self) -> f64 {
        self.stage * self.of_velocity / self.tau
    }

    /// The stage's velocity without a stage's acceleration: (1 − θ) v₀ + θ `velocity`, m/s.
    pub fn known_stage_velocity(&self) -> Combination {
        let Combination { velocity, acceleration, increment, earlier_velocity } = self.velocity;
        let theta = self.stage;
        Combination {
            velocity: 1.0 - theta + theta * velocity,
            acceleration: theta * acceleration,
            increment: theta * increment,
            earlier_velocity: theta * earlier_velocity,
        }
    }
}
