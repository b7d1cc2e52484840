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
    Document {
        animations() -> Empty<Animation>,
        default_scene() -> Option<Scene>,
        materials() -> Empty<Material>,
        meshes() -> Empty<Mesh>,
        nodes() -> Empty<Node>,
        scenes() -> Empty<Scene>,
    }
    Scene { nodes() -> Empty<Node>, }
    Node {
        children() -> Empty<Node>,
        index() -> usize,
        mesh() -> Option<Mesh>,
        skin() -> Option<Skin>,
        transform() -> Transform,
        weights() -> Option<&[f32]>,
    }
    Transform { decomposed() -> ([f32; 3], [f32; 4], [f32; 3]), }
    Mesh {
        index() -> usize,
        name() -> Option<&str>,
        primitives() -> Empty<Primitive>,
        weights() -> Option<&[f32]>,
    }
    Primitive {
        material() -> Material,
        mode() -> mesh::Mode,
        reader<'a>(impl Fn(Buffer) -> Option<&'a buffer::Data>) -> Reader,
    }
    Skin {
        joints() -> Empty<Node>,
        reader<'a>(impl Fn(Buffer) -> Option<&'a buffer::Data>) -> Reader,
    }
    Buffer { index() -> usize, }
    Reader {
        read_indices() -> Option<Integers>,
        read_inputs() -> Option<Empty<f32>>,
        read_inverse_bind_matrices() -> Option<Empty<[[f32; 4]; 4]>>,
        read_joints(u32) -> Option<Joints>,
        read_morph_targets() -> Empty<(Points, Points, Points)>,
        read_normals() -> Option<Empty<[f32; 3]>>,
        read_outputs() -> Option<animation::util::ReadOutputs>,
        read_positions() -> Option<Empty<[f32; 3]>>,
        read_tex_coords(u32) -> Option<Coordinates>,
        read_weights(u32) -> Option<Vectors>,
    }
    Integers { into_u32() -> Empty<u32>, }
    Joints { into_u16() -> Empty<[u16; 4]>, }
    Coordinates { into_f32() -> Empty<[f32; 2]>, }
    Vectors { into_f32() -> Empty<[f32; 4]>, }
    Numbers { into_f32() -> Empty<f32>, }
    Material {
        emissive_factor() -> [f32; 3],
        emissive_texture() -> Option<TextureInfo>,
        index() -> Option<usize>,
        normal_texture() -> Option<TextureInfo>,
        occlusion_texture() -> Option<TextureInfo>,
        pbr_metallic_roughness() -> PbrMetallicRoughness,
    }
    PbrMetallicRoughness {
        base_color_factor() -> [f32; 4],
        base_color_texture() -> Option<TextureInfo>,
        metallic_factor() -> f32,
        metallic_roughness_texture() -> Option<TextureInfo>,
        roughness_factor() -> f32,
    }
    TextureInfo { texture() -> Texture, }
    Texture { source() -> Source, }
    Source { index() -> usize, }
    Animation {
        channels() -> Empty<Channel>,
        name() -> Option<&str>,
    }
    Channel {
        reader<'a>(impl Fn(Buffer) -> Option<&'a buffer::Data>) -> Reader,
        sampler() -> Sampler,
        target() -> Target,
    }
    Sampler { interpolation() -> animation::Interpolation, }
    Target { node() -> Node, }
}

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
