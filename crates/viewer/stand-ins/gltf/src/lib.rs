//! Stands for [gltf](https://docs.rs/gltf), a reader of glTF scenes. kiss3d calls it in its `loader/gltf.rs`, behind
//! `SceneNode3d::add_gltf`, which nothing here calls: fem-mesh reads glTF files itself. Importing returns an error, so that no other
//! value of this package ever exists; the types say so (`Never`), and hold what kiss3d names.

use std::iter::Empty;

/// glTF is not read here.
#[derive(Debug)]
pub struct Error;

impl std::fmt::Display for Error {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("this program is built without kiss3d's reader of glTF files")
    }
}

impl std::error::Error for Error {}

type Import = (Document, Vec<buffer::Data>, Vec<image::Data>);

pub fn import<P: AsRef<std::path::Path>>(_path: P) -> Result<Import, Error> {
    Err(Error)
}

pub fn import_slice<S: AsRef<[u8]>>(_bytes: S) -> Result<Import, Error> {
    Err(Error)
}

/// Has no value.
#[derive(Clone, Copy)]
enum Never {}

/// Types without a value, and their methods, which cannot be called.
macro_rules! never {
    ($($type:ident { $($method:ident $(<$lifetime:lifetime>)? ($($argument:ty),*) -> $result:ty,)* })*) => {
        $(
            pub struct $type(Never);

            impl $type {
                $(pub fn $method $(<$lifetime>)? (&self, $(_: $argument),*) -> $result {
                    match self.0 {}
                })*
            }
        )*
    };
}

never! {
    Part {
        animations() -> Empty<Part>,
        channels() -> Empty<Part>,
        children() -> Empty<Part>,
        decomposed() -> ([f32; 3], [f32; 4], [f32; 3]),
        default_scene() -> Option<Part>,
        index() -> usize,
        interpolation() -> animation::Interpolation,
        into_u16() -> Empty<[u16; 4]>,
        into_u32() -> Empty<u32>,
        joints() -> Empty<Part>,
        material() -> Material,
        materials() -> Empty<Material>,
        mesh() -> Option<Part>,
        meshes() -> Empty<Part>,
        mode() -> mesh::Mode,
        name() -> Option<&str>,
        node() -> Part,
        nodes() -> Empty<Part>,
        primitives() -> Empty<Part>,
        read_indices() -> Option<Part>,
        read_inputs() -> Option<Empty<f32>>,
        read_inverse_bind_matrices() -> Option<Empty<[[f32; 4]; 4]>>,
        read_joints(u32) -> Option<Part>,
        read_morph_targets() -> Empty<(Points, Points, Points)>,
        read_normals() -> Option<Empty<[f32; 3]>>,
        read_outputs() -> Option<animation::util::ReadOutputs>,
        read_positions() -> Option<Empty<[f32; 3]>>,
        read_tex_coords(u32) -> Option<Coordinates>,
        read_weights(u32) -> Option<Vectors>,
        reader<'a>(impl Fn(Part) -> Option<&'a buffer::Data>) -> Part,
        sampler() -> Part,
        scenes() -> Empty<Part>,
        skin() -> Option<Part>,
        source() -> Part,
        target() -> Part,
        texture() -> Part,
        transform() -> Part,
        weights() -> Option<&[f32]>,
    }
    Material {
        base_color_factor() -> [f32; 4],
        base_color_texture() -> Option<Part>,
        emissive_factor() -> [f32; 3],
        emissive_texture() -> Option<Part>,
        index() -> Option<usize>,
        metallic_factor() -> f32,
        metallic_roughness_texture() -> Option<Part>,
        normal_texture() -> Option<Part>,
        occlusion_texture() -> Option<Part>,
        pbr_metallic_roughness() -> Material,
        roughness_factor() -> f32,
    }
    Coordinates { into_f32() -> Empty<[f32; 2]>, }
    Vectors { into_f32() -> Empty<[f32; 4]>, }
    Numbers { into_f32() -> Empty<f32>, }
}

// One type has the methods of all that differ in nothing.
pub type Document = Part;
pub type Primitive = Part;
pub type Skin = Part;
pub type Animation = Part;

pub mod buffer {
    pub struct Data(super::Never);
}

pub mod mesh {
    #[derive(Debug, PartialEq)]
    pub enum Mode {
        Triangles,
    }
}

pub mod animation {
    pub enum Interpolation {
        Linear,
        Step,
        CubicSpline,
    }

    pub mod util {
        use crate::{Numbers, Vectors};
        use std::iter::Empty;

        pub enum ReadOutputs {
            Translations(Empty<[f32; 3]>),
            Rotations(Vectors),
            Scales(Empty<[f32; 3]>),
            MorphTargetWeights(Numbers),
        }
    }
}

pub mod image {
    pub struct Data {
        pub pixels: Vec<u8>,
        pub format: Format,
        pub width: u32,
        pub height: u32,
    }

    pub enum Format {
        R8,
        R8G8,
        R8G8B8,
        R8G8B8A8,
        R16,
        R16G16,
        R16G16B16,
        R16G16B16A16,
        R32G32B32FLOAT,
        R32G32B32A32FLOAT,
    }
}

/// Positions, normals or tangents that may be missing.
type Points = Option<Empty<[f32; 3]>>;
