//! Volumes of elements over those of the undeformed body, det F.

use nalgebra::{Matrix3, Vector3};

use super::Simulator;
use fem_solvers::Real;

impl<T: Real> Simulator<T> {
    pub(super) fn min_J_now(&self) -> (f64, usize) {
        if self.system.elements.count() == 0 {
            let of_elements = self.det_F_of_mesh().enumerate().map(|(element, J)| (J, element));
            return of_elements.min_by(|a, b| a.0.total_cmp(&b.0)).unwrap_or((f64::INFINITY, 0));
        }
        let (J, element) = self.system.elements.min_det_F(&self.state.u);
        (J.as_f64(), element)
    }

    pub(super) fn inverted_elements_now(&self) -> usize {
        if self.system.elements.count() == 0 {
            return self.det_F_of_mesh().filter(|J| *J <= 0.0).count();
        }
        self.system.elements.inverted(&self.state.u)
    }

    /// The warning of elements that may be inverted between their quadrature points, where no law and no line search sees it.
    pub(super) fn hidden_inversion(&self) -> Option<String> {
        let mesh = &self.system.shape.mesh;
        if mesh.element().order == 1 || self.inverted_elements_now() > 0 {
            return None;
        }
        let u = self.system.numbering.to_mesh(&self.state.u);
        let bound = |element: usize| (mesh.least_det_F(element, |node| Vector3::from(u[node].map(T::as_f64))), element);
        let bounds: Vec<(f64, usize)> = (0..mesh.elements()).map(bound).filter(|(J, _)| *J <= 0.0).collect();
        let (least, element) = *bounds.iter().min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some(format!(
            "{} elements may be inverted between their quadrature points, element {element} most of all (det F ≥ {least:.3e}); use a finer mesh \
             there, or smaller loads",
            bounds.len()
        ))
    }

    /// det F of each element of the mesh, elastic or not.
    fn det_F_of_mesh(&self) -> impl Iterator<Item = f64> {
        let u = self.system.numbering.to_mesh(&self.state.u);
        let mesh = &self.system.shape.mesh;
        let G = move |element| mesh.displacement_gradient(element, |node| Vector3::from(u[node].map(T::as_f64)));
        (0..mesh.elements()).map(move |element| (Matrix3::identity() + G(element)).determinant())
    }
}
