//! Pictures on surfaces.

use kiss3d::context::Context;

use super::color_scale;

const COLORS: u32 = 256; // of the picture of a colour scale

/// A picture that a shader reads, with its sampler.
#[derive(Clone)]
pub struct Texture {
    /// The bind group of [`layout`].
    pub group: wgpu::BindGroup,
}

impl Texture {
    /// A picture of `width` × `height` pixels: red, green, blue, opacity (sRGB) row by row from the upper left.
    pub fn new([width, height]: [u32; 2], rgba: &[u8]) -> Self {
        let context = Context::get();
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        let texture = context.create_texture(&wgpu::TextureDescriptor {
            label: Some("picture"),
            size,
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba8UnormSrgb,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let rows = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
        context.write_texture(texture.as_image_copy(), rgba, rows, size);
        let sampler = context.create_sampler(&wgpu::SamplerDescriptor {
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..wgpu::SamplerDescriptor::default()
        });
        let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
        let group = context.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("picture"),
            layout: &layout(),
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&view) },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::Sampler(&sampler) },
            ],
        });
        Texture { group }
    }

    /// A white pixel.
    pub fn white() -> Self {
        Self::new([1, 1], &[255; 4])
    }

    /// The colours of scales, from left to right.
    pub fn colors() -> Self {
        let share = |i: u32| i as f32 / (COLORS - 1) as f32;
        let rgba: Vec<u8> = (0..COLORS)
            .flat_map(|i| {
                let [r, g, b] = color_scale::color(share(i));
                [r, g, b, 255]
            })
            .collect();
        Self::new([COLORS, 1], &rgba)
    }
}

/// Texture coordinate of a place on a colour scale, from 0 to 1.
pub fn place_of_color(share: f32) -> f32 {
    (0.5 + share * (COLORS - 1) as f32) / COLORS as f32
}

/// The layout of a picture and its sampler.
pub fn layout() -> wgpu::BindGroupLayout {
    let entry =
        |binding, ty| wgpu::BindGroupLayoutEntry { binding, visibility: wgpu::ShaderStages::FRAGMENT, ty, count: None };
    let texture = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: true },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    let sampler = wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering);
    Context::get().create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("picture"),
        entries: &[entry(0, texture), entry(1, sampler)],
    })
}
