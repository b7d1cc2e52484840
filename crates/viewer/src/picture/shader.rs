//! The shader of the body, the floor and the shadow. kiss3d's own shader does much more, and takes most of a second per
//! picture on a software renderer; this one is fast there too.

use std::any::Any;
use std::cell::RefCell;
use std::rc::Rc;

use kiss3d::camera::Camera3d;
use kiss3d::color::Color;
use kiss3d::context::Context;
use kiss3d::glamx::{Pose3, Vec3};
use kiss3d::light::LightCollection;
use kiss3d::resource::vertex_index::VERTEX_INDEX_FORMAT;
use kiss3d::resource::{GpuData, GpuMesh3d, Material3d, PipelineCache, RenderContext, multisample_state};
use kiss3d::scene::{InstancesBuffer3d, ObjectData3d};

use super::texture::{self, Texture};
use super::theme;

const FLOATS: usize = 16 + 7 * 4; // in `Scene` of the WGSL code
/// Positions, normals and texture coordinates.
const ATTRIBUTES: [[wgpu::VertexAttribute; 1]; 3] = [
    wgpu::vertex_attr_array![0 => Float32x3],
    wgpu::vertex_attr_array![1 => Float32x3],
    wgpu::vertex_attr_array![2 => Float32x2],
];
const STRIDES: [u64; 3] = [12, 12, 8];

/// The kind of object that a shader draws; the WGSL code has their numbers.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Kind {
    /// Lit from three sides.
    Body,
    /// Flat, fading into the background.
    Floor,
    /// The body, projected onto the floor along the strongest light.
    Shadow,
    /// A flat body: without light.
    Flat,
    /// The face of an obstacle: translucent.
    Obstacle,
}

/// Properties common to all objects of a scene. Lengths are in m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Environment {
    /// Upward unit vector.
    pub up: Vec3,
    /// Unit vector to the right in the first view.
    pub right: Vec3,
    /// Horizontal unit vector towards the eye in the first view.
    pub front: Vec3,
    /// Height of the floor along `up`.
    pub floor: f32,
    /// Centre of the body at rest.
    pub centre: Vec3,
    /// Half of the body's diagonal at rest.
    pub radius: f32,
}

/// The picture on the body, if there is one.
pub type Painting = Rc<RefCell<Option<Texture>>>;

/// A shader in the form that kiss3d shares.
pub type Shared = Rc<RefCell<Box<dyn Material3d>>>;

/// The shader of one kind of object. It reads `environment` and `painting` at each frame; only bodies have a picture.
pub fn shader(kind: Kind, environment: &Rc<RefCell<Environment>>, painting: &Painting) -> Shared {
    let painting = matches!(kind, Kind::Body | Kind::Flat).then(|| Rc::clone(painting)).unwrap_or_default();
    Rc::new(RefCell::new(Box::new(Shader::new(kind, Rc::clone(environment), painting))))
}

struct Shader {
    kind: Kind,
    environment: Rc<RefCell<Environment>>,
    painting: Painting,
    /// In place of a painting.
    white: Texture,
    layout: wgpu::BindGroupLayout,
    pipelines: PipelineCache,
}

/// Uniform buffer of one object.
struct Uniforms {
    buffer: wgpu::Buffer,
    group: wgpu::BindGroup,
}

impl GpuData for Uniforms {
    fn as_any(&self) -> &dyn Any {
        self
    }

    fn as_any_mut(&mut self) -> &mut dyn Any {
        self
    }
}

impl Shader {
    fn new(kind: Kind, environment: Rc<RefCell<Environment>>, painting: Painting) -> Self {
        let context = Context::get();
        let layout = context.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("body, floor and shadow"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let pipeline_layout = context.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("body, floor and shadow"),
            bind_group_layouts: &[Some(&layout), Some(&texture::layout())],
            immediate_size: 0,
        });
        let shader = context.create_shader_module(Some("body, floor and shadow"), include_str!("shader.wgsl"));
        let pipelines = PipelineCache::new(move |samples| pipeline(kind, &pipeline_layout, &shader, samples));
        Shader { kind, environment, painting, white: Texture::white(), layout, pipelines }
    }

    /// `Scene` of the WGSL code as floats.
    fn uniforms(&self, camera: &dyn Camera3d, color: Color) -> [f32; FLOATS] {
        let Environment { up, right, front, floor, centre, radius } = *self.environment.borrow();
        // The shadow lies slightly above the floor, which would hide it.
        let floor = if self.kind == Kind::Shadow { floor + 3e-3 * radius } else { floor };
        let key = (up * 1.0 - right * 0.55 + front * 0.65).normalize();
        let fill = (up * 0.25 + right * 0.9 + front * 0.35).normalize();
        let background = theme::BACKGROUND;
        let rows = [
            camera.eye().extend(f32::from(self.kind as u8)),
            up.extend(floor),
            key.extend(radius),
            fill.extend(if self.painting.borrow().is_some() { 1.0 } else { 0.0 }),
            centre.extend(0.0),
            Vec3::new(color.r, color.g, color.b).extend(color.a),
            Vec3::new(background.r, background.g, background.b).extend(1.0),
        ];
        let mut uniforms = [0.0; FLOATS];
        uniforms[..16].copy_from_slice(&camera.transformation().to_cols_array());
        for (place, row) in uniforms[16..].chunks_exact_mut(4).zip(rows) {
            place.copy_from_slice(&row.to_array());
        }
        uniforms
    }
}

impl Material3d for Shader {
    fn create_gpu_data(&self) -> Box<dyn GpuData> {
        let context = Context::get();
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let buffer = context.create_buffer_simple(Some("body, floor and shadow"), (4 * FLOATS) as u64, usage);
        let group = context.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("body, floor and shadow"),
            layout: &self.layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
        });
        Box::new(Uniforms { buffer, group })
    }

    fn prepare(
        &mut self,
        _: usize,
        _: Pose3,
        _: Vec3,
        camera: &mut dyn Camera3d,
        _: &LightCollection,
        object: &ObjectData3d,
        data: &mut dyn GpuData,
        _: u32,
        _: u32,
    ) {
        let Some(data) = data.as_any().downcast_ref::<Uniforms>() else { return };
        let bytes: Vec<u8> = self.uniforms(camera, object.color()).iter().flat_map(|n| n.to_ne_bytes()).collect();
        Context::get().write_buffer(&data.buffer, 0, &bytes);
    }

    fn render(
        &mut self,
        _: usize,
        _: Pose3,
        _: Vec3,
        _: &mut dyn Camera3d,
        _: &LightCollection,
        _: &ObjectData3d,
        mesh: &mut GpuMesh3d,
        _: &mut InstancesBuffer3d,
        data: &mut dyn GpuData,
        pass: &mut wgpu::RenderPass<'_>,
        context: &RenderContext,
    ) {
        let indices = mesh.num_indices();
        let Some(data) = data.as_any().downcast_ref::<Uniforms>() else { return };
        let Some((coords, faces, normals, places)) = mesh.ensure_on_gpu() else { return };
        pass.set_pipeline(&self.pipelines.get(context.sample_count));
        pass.set_bind_group(0, &data.group, &[]);
        pass.set_bind_group(1, &self.painting.borrow().as_ref().unwrap_or(&self.white).group, &[]);
        pass.set_vertex_buffer(0, coords.slice(..));
        pass.set_vertex_buffer(1, normals.slice(..));
        pass.set_vertex_buffer(2, places.slice(..));
        pass.set_index_buffer(faces.slice(..), VERTEX_INDEX_FORMAT);
        pass.draw_indexed(0..indices, 0, 0..1);
    }
}

fn pipeline(
    kind: Kind,
    layout: &wgpu::PipelineLayout,
    shader: &wgpu::ShaderModule,
    samples: u32,
) -> wgpu::RenderPipeline {
    let vectors: [_; 3] = std::array::from_fn(|i| {
        let (array_stride, attributes) = (STRIDES[i], &ATTRIBUTES[i][..]);
        Some(wgpu::VertexBufferLayout { array_stride, step_mode: wgpu::VertexStepMode::Vertex, attributes })
    });
    let is_translucent = kind == Kind::Obstacle;
    let target = wgpu::ColorTargetState {
        format: Context::render_format(),
        blend: is_translucent.then_some(wgpu::BlendState::ALPHA_BLENDING),
        write_mask: wgpu::ColorWrites::ALL,
    };
    Context::get().create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("body, floor and shadow"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module: shader,
            entry_point: Some("place"),
            buffers: &vectors,
            compilation_options: wgpu::PipelineCompilationOptions::default(),
        },
        fragment: Some(wgpu::FragmentState {
            module: shader,
            entry_point: Some("paint"),
            targets: &[Some(target)],
            compilation_options: wgpu::PipelineCompilationOptions::default(),
        }),
        primitive: wgpu::PrimitiveState::default(), // triangles, both sides
        depth_stencil: Some(wgpu::DepthStencilState {
            format: Context::depth_format(),
            depth_write_enabled: Some(!is_translucent),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        }),
        multisample: multisample_state(samples),
        multiview_mask: None,
        cache: None,
    })
}
