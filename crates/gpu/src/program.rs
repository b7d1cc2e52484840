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

/// An entry of a source with its arrays, and the number of groups that run it, in rows and columns.
pub(crate) struct Kernel {
    pipeline: wgpu::ComputePipeline,
    arrays: wgpu::BindGroup,
    groups: [u32; 2],
}

/// Largest number of groups in a row that every device supports.
const LONGEST_ROW: usize = 65_535;

/// Rows and columns of groups for so many invocations. Those beyond the last are idle.
fn groups_for(invocations: usize) -> [u32; 2] {
    let groups = invocations.div_ceil(GROUP).max(1);
    let columns = groups.div_ceil(LONGEST_ROW);
    [groups.div_ceil(columns) as u32, columns as u32]
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
        let pipeline = self.pipeline(entry, constants);
        let arrays = self.bound(&pipeline, entry, arrays);
        self.device.check()?;
        Ok(Kernel { pipeline, arrays, groups: [groups as u32, 1] })
    }

    /// The same with so many invocations, whose number may be larger than one row of groups has; the shader takes them row by row.
    pub(crate) fn kernel_of(
        &self,
        entry: &str,
        constants: &[(&str, f64)],
        arrays: &[(u32, &Buffer)],
        invocations: usize,
    ) -> Result<Kernel, DeviceError> {
        Ok(Kernel { groups: groups_for(invocations), ..self.kernel(entry, constants, arrays, 1)? })
    }

    /// Kernels of one entry, each with its own arrays and number of invocations.
    pub(crate) fn kernels_of<'b>(
        &self,
        entry: &str,
        kernels: impl Iterator<Item = (Vec<(u32, &'b Buffer)>, usize)>,
    ) -> Result<Vec<Kernel>, DeviceError> {
        let pipeline = self.pipeline(entry, &[]);
        let bound = kernels.map(|(arrays, invocations)| Kernel {
            arrays: self.bound(&pipeline, entry, &arrays),
            groups: groups_for(invocations),
            pipeline: pipeline.clone(),
        });
        let kernels = bound.collect();
        self.device.check()?;
        Ok(kernels)
    }

    fn pipeline(&self, entry: &str, constants: &[(&str, f64)]) -> wgpu::ComputePipeline {
        let device = &self.device.device;
        device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: Some(entry),
            layout: None,
            module: &self.module,
            entry_point: Some(entry),
            compilation_options: PipelineCompilationOptions { constants, ..Default::default() },
            cache: None,
        })
    }

    fn bound(&self, pipeline: &wgpu::ComputePipeline, entry: &str, arrays: &[(u32, &Buffer)]) -> wgpu::BindGroup {
        let entries: Vec<_> = arrays
            .iter()
            .map(|&(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let layout = &pipeline.get_bind_group_layout(0);
        self.device.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some(entry),
            layout,
            entries: &entries,
        })
    }
}

impl Kernel {
    /// Number of its invocations, idle ones included.
    pub(crate) fn invocations(&self) -> usize {
        self.groups[0] as usize * self.groups[1] as usize * GROUP
    }

    /// Runs after what ran before it in the pass.
    pub(crate) fn run(&self, pass: &mut ComputePass) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, &self.arrays, &[]);
        let [rows, columns] = self.groups;
        pass.dispatch_workgroups(rows, columns, 1);
    }
}
