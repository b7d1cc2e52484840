//! Shaders as kernels: a pipeline with its arrays, built once.

use wgpu::{Buffer, ComputePass, PipelineCompilationOptions};

use crate::{Device, DeviceError, Number};

/// Invocations of a group.
pub(crate) const GROUP: usize = 64;

/// A compiled source.
pub(crate) struct Program<'a> {
    device: &'a Device,
    module: wgpu::ShaderModule,
}

/// An entry of a source with its arrays, and the number of groups that run it.
pub(crate) struct Kernel {
    pipeline: wgpu::ComputePipeline,
    arrays: wgpu::BindGroup,
    groups: u32,
}

impl<'a> Program<'a> {
    /// Compiles a source whose `real` is the number type.
    pub(crate) fn new<T: Number>(device: &'a Device, source: &str) -> Result<Self, DeviceError> {
        if T::IS_DOUBLE && !device.has_double_precision() {
            return Err(DeviceError::NoDoublePrecision(device.adapter().to_owned()));
        }
        let source = format!("alias real = {};\n{source}", T::WGSL);
        let descriptor = wgpu::ShaderModuleDescriptor { label: None, source: wgpu::ShaderSource::Wgsl(source.into()) };
        let module = device.device.create_shader_module(descriptor);
        device.check()?;
        Ok(Self { device, module })
    }

    /// The kernel of an entry, with the arrays of its bindings, and with values of its constants.
    pub(crate) fn kernel(
        &self,
        entry: &str,
        constants: &[(&str, f64)],
        arrays: &[(u32, &Buffer)],
        groups: usize,
    ) -> Result<Kernel, DeviceError> {
        let device = &self.device.device;
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: None,
            module: &self.module,
            entry_point: Some(entry),
            compilation_options: PipelineCompilationOptions { constants, ..Default::default() },
            cache: None,
        });
        let entries: Vec<_> = arrays
            .iter()
            .map(|&(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let descriptor = wgpu::BindGroupDescriptor {
            label: Some(entry),
            layout: &pipeline.get_bind_group_layout(0),
            entries: &entries,
        };
        let arrays = device.create_bind_group(&descriptor);
        self.device.check()?;
        Ok(Kernel { pipeline, arrays, groups: groups as u32 })
    }
}

impl Kernel {
    /// Runs after what ran before it in the pass.
    pub(crate) fn run(&self, pass: &mut ComputePass) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.arrays, &[]);
        pass.dispatch_workgroups(self.groups, 1, 1);
    }
}
