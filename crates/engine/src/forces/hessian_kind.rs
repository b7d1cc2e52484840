//! Whether a Hessian is exact or made positive semi-definite.

/// Kind of a Hessian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum HessianKind {
    /// The second derivative as it is.
    Exact,
    /// The part of each element and of each force is projected to a positive semi-definite matrix.
    Projected,
}
