//! The surface of a body as a picture shows it.

use bevy::asset::RenderAssetUsages;
use bevy::mesh::{Indices, Mesh, PrimitiveTopology, VertexAttributeValues};
use fem_model::simulation::Shape;
use nalgebra::Vector3;

/// The triangles of a body's surface.
pub struct Topology {
    /// Corners of each triangle, as numbers of the surface's vertices.
    pub triangles: Vec<[u32; 3]>,
    /// The node of each vertex, where the surface is the boundary of the elements; `None` for a display surface.
    nodes: Option<Vec<usize>>,
}

/// Vertices of a surface at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Surface {
    /// m
    pub positions: Vec<[f32; 3]>,
    /// Unit normals, means of those of the triangles around the vertex weighted by their areas.
    pub normals: Vec<[f32; 3]>,
}

impl Topology {
    /// The display surface of a body, or else its boundary.
    pub fn new(shape: &Shape) -> Self {
        let as_u32 = |triangle: &[usize; 3]| triangle.map(|vertex| vertex as u32);
        if let Some(display) = &shape.display {
            return Self { triangles: display.elements.iter().map(as_u32).collect(), nodes: None };
        }
        let mut nodes: Vec<usize> = shape.boundary.iter().flatten().copied().collect();
        nodes.sort_unstable();
        nodes.dedup();
        let vertex = |node| nodes.partition_point(|&other| other < node);
        let triangles = shape.boundary.iter().map(|triangle| as_u32(&triangle.map(vertex))).collect();
        Self { triangles, nodes: Some(nodes) }
    }

    /// The surface at `display_positions` of the simulation, m.
    pub fn surface(&self, display_positions: &[Vector3<f64>]) -> Surface {
        let single = |x: &Vector3<f64>| [x.x as f32, x.y as f32, x.z as f32];
        let positions: Vec<[f32; 3]> = match &self.nodes {
            Some(nodes) => nodes.iter().map(|&node| single(&display_positions[node])).collect(),
            None => display_positions.iter().map(single).collect(),
        };
        let normals = self.normals(&positions);
        Surface { positions, normals }
    }

    fn normals(&self, positions: &[[f32; 3]]) -> Vec<[f32; 3]> {
        let mut sums = vec![Vector3::<f32>::zeros(); positions.len()];
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(|vertex| Vector3::from(positions[vertex as usize]));
            let area_vector = (b - a).cross(&(c - a));
            triangle.iter().for_each(|&vertex| sums[vertex as usize] += area_vector);
        }
        sums.iter().map(|sum| sum.try_normalize(0.0).unwrap_or_else(Vector3::z).into()).collect()
    }

    /// The surface as a mesh of Bevy, which stays in main memory so that later states can be written to it.
    pub fn mesh(&self, surface: &Surface) -> Mesh {
        Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
            .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, surface.positions.clone())
            .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, surface.normals.clone())
            .with_inserted_indices(Indices::U32(self.triangles.as_flattened().to_vec()))
    }
}

/// Two surfaces of one body, and the place between them: 0 at the first, 1 at the second.
#[derive(Clone, Copy)]
pub struct Blend<'a> {
    /// The two surfaces.
    pub between: [&'a Surface; 2],
    /// From 0 to 1.
    pub fraction: f32,
}

impl Blend<'_> {
    /// Writes positions and normals to a mesh of the same body. A mesh that others have changed stays as it is.
    pub fn write(&self, mesh: &mut Mesh) {
        let [a, b] = self.between;
        if let Ok(VertexAttributeValues::Float32x3(out)) = mesh.try_attribute_mut(Mesh::ATTRIBUTE_POSITION) {
            interpolate(&a.positions, &b.positions, self.fraction, out);
        }
        // Shaders scale normals to unit length.
        if let Ok(VertexAttributeValues::Float32x3(out)) = mesh.try_attribute_mut(Mesh::ATTRIBUTE_NORMAL) {
            interpolate(&a.normals, &b.normals, self.fraction, out);
        }
    }
}

fn interpolate(a: &[[f32; 3]], b: &[[f32; 3]], fraction: f32, out: &mut [[f32; 3]]) {
    for ((a, b), out) in a.as_flattened().iter().zip(b.as_flattened()).zip(out.as_flattened_mut()) {
        *out = a + fraction * (b - a);
    }
}
