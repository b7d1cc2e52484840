//! The arguments of the command line.

/// A body, its material, and the settings of the solver. Lengths are in m, times in s, moduli in Pa.
pub struct Options {
    /// Edges of the body: two of a rectangle (rapier2d, plane strain, 1 m thick), three of a box (rapier3d).
    pub size: Vec<f64>,
    /// Cells per metre.
    pub cells: usize,
    pub young: f64,
    pub poisson: f64,
    /// Density, kg/m³.
    pub density: f64,
    /// Acceleration, m/s²; the third number is ignored in two dimensions.
    pub gravity: Vec<f64>,
    pub law: Law,
    pub double: bool,
    pub dt: f64,
    pub steps: usize,
    /// `num_solver_iterations`, each of which is a linearly implicit step of dt / substeps.
    pub substeps: usize,
    /// `max_linear_iterations`: bound of the conjugate gradient iterations in a substep.
    pub iterations: usize,
    /// `linear_tolerance`: relative residual at which they end.
    pub tolerance: f64,
    /// `max_dense_dofs`: degrees of freedom up to which a step factorizes its matrix for contacts.
    pub max_dense: usize,
    /// `elastic_damping_ratio`.
    pub damping: f64,
    /// File for the final positions.
    pub state: Option<String>,
}

/// A constitutive law that rapier has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Law {
    Corotated,
    StableNeoHookean,
}

impl Options {
    /// Reads `--key value` pairs. What is left out has rapier's default, or belongs to the body and must be given.
    ///
    /// Returns a message with the key if one is unknown, missing or has an unusable value.
    pub fn read(arguments: impl IntoIterator<Item = String>) -> Result<Self, String> {
        let mut options = Self {
            size: Vec::new(),
            cells: 0,
            young: 0.0,
            poisson: 0.0,
            density: 0.0,
            gravity: Vec::new(),
            law: Law::Corotated,
            double: false,
            dt: 1.0 / 60.0,
            steps: 0,
            substeps: 4,
            iterations: 20,
            tolerance: 1e-5,
            max_dense: 600,
            damping: 1.0,
            state: None,
        };
        let mut arguments = arguments.into_iter();
        while let Some(key) = arguments.next() {
            let value = arguments.next().ok_or(format!("{key} lacks a value"))?;
            options.set(&key, &value)?;
        }
        options.check()?;
        Ok(options)
    }

    fn set(&mut self, key: &str, value: &str) -> Result<(), String> {
        match key {
            "--size" => self.size = numbers(key, value)?,
            "--gravity" => self.gravity = numbers(key, value)?,
            "--cells" => self.cells = count(key, value)?,
            "--young" => self.young = number(key, value)?,
            "--poisson" => self.poisson = number(key, value)?,
            "--density" => self.density = number(key, value)?,
            "--dt" => self.dt = number(key, value)?,
            "--steps" => self.steps = count(key, value)?,
            "--substeps" => self.substeps = count(key, value)?,
            "--iterations" => self.iterations = count(key, value)?,
            "--tolerance" => self.tolerance = number(key, value)?,
            "--max-dense" => {
                self.max_dense = value.parse().map_err(|_| format!("{key} {value}: give a whole number"))?
            }
            "--damping" => self.damping = number(key, value)?,
            "--precision" => self.double = choice(key, value, ["f32", "f64"])? == 1,
            "--law" => {
                let laws = [Law::Corotated, Law::StableNeoHookean];
                self.law = laws[choice(key, value, ["corotated", "stable_neo_hookean"])?];
            }
            "--state" => self.state = Some(value.to_owned()),
            _ => return Err(format!("{key} is unknown; src/options.rs lists the keys")),
        }
        Ok(())
    }

    fn check(&self) -> Result<(), String> {
        if !(2..=3).contains(&self.size.len()) || self.size.iter().any(|edge| *edge <= 0.0) {
            return Err("--size: give two positive lengths of a rectangle, or three of a box".to_owned());
        }
        if self.gravity.len() != 3 {
            return Err("--gravity: give three numbers".to_owned());
        }
        for (key, value) in [("--young", self.young), ("--density", self.density), ("--dt", self.dt)] {
            if value <= 0.0 {
                return Err(format!("{key}: give a positive number"));
            }
        }
        for (key, value) in [("--cells", self.cells), ("--steps", self.steps)] {
            if value == 0 {
                return Err(format!("{key}: give a whole number, 1 or more"));
            }
        }
        Ok(())
    }
}

fn number(key: &str, value: &str) -> Result<f64, String> {
    match value.parse::<f64>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(format!("{key} {value}: give a number")),
    }
}

fn numbers(key: &str, value: &str) -> Result<Vec<f64>, String> {
    value.split(',').map(|part| number(key, part)).collect()
}

fn count(key: &str, value: &str) -> Result<usize, String> {
    match value.parse() {
        Ok(0) | Err(_) => Err(format!("{key} {value}: give a whole number, 1 or more")),
        Ok(count) => Ok(count),
    }
}

fn choice(key: &str, value: &str, names: [&str; 2]) -> Result<usize, String> {
    let place = names.iter().position(|name| *name == value);
    place.ok_or(format!("{key} {value}: give {} or {}", names[0], names[1]))
}
