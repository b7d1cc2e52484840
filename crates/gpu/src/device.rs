//! A graphics device: opening, arrays, commands, and errors.

use std::sync::{Arc, Mutex, PoisonError};

use bytemuck::Pod;
use wgpu::{Buffer, BufferUsages, Features, PollType, PowerPreference};

use crate::DeviceError;
use crate::quiet::without_wayland_message;

/// An open device. Its arrays and pipelines live as long as it does.
pub struct Device {
    adapter: String,
    is_software: bool,
    has_double: bool,
    pub(crate) device: wgpu::Device,
    queue: wgpu::Queue,
    /// The first thing that went wrong.
    trouble: Arc<Mutex<Option<String>>>,
}

impl Device {
    /// Opens the fastest adapter of this machine. Mesa's llvmpipe, which computes on the processor, is one too.
    pub fn open() -> Result<Arc<Self>, DeviceError> {
        let options =
            wgpu::RequestAdapterOptions { power_preference: PowerPreference::HighPerformance, ..Default::default() };
        let adapter = without_wayland_message(|| {
            let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle_from_env());
            pollster::block_on(instance.request_adapter(&options))
        });
        let adapter = adapter.map_err(|error| DeviceError::NoAdapter(error.to_string()))?;
        let wgpu::AdapterInfo { name, device_type, .. } = adapter.get_info();
        let is_software = device_type == wgpu::DeviceType::Cpu;
        let has_double = adapter.features().contains(Features::SHADER_F64);
        let descriptor = wgpu::DeviceDescriptor {
            label: Some("finite elements"),
            required_features: if has_double { Features::SHADER_F64 } else { Features::empty() },
            required_limits: adapter.limits(),
            ..Default::default()
        };
        let (device, queue) = pollster::block_on(adapter.request_device(&descriptor))
            .map_err(|error| DeviceError::Failed { adapter: name.clone(), message: error.to_string() })?;
        let trouble = Arc::new(Mutex::new(None));
        let note = Arc::clone(&trouble);
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| record(&note, error.to_string())));
        let note = Arc::clone(&trouble);
        device.set_device_lost_callback(move |reason, message| {
            // Dropping the device ends it on purpose.
            if reason != wgpu::DeviceLostReason::Destroyed {
                record(&note, format!("the device was lost: {message}"));
            }
        });
        Ok(Arc::new(Self { adapter: name, is_software, has_double, device, queue, trouble }))
    }

    /// Name of the adapter.
    pub fn adapter(&self) -> &str {
        &self.adapter
    }

    /// Returns true if the adapter is a program that computes on the processor, such as Mesa's llvmpipe.
    pub fn is_software(&self) -> bool {
        self.is_software
    }

    /// Returns true if the device computes in double precision.
    pub fn has_double_precision(&self) -> bool {
        self.has_double
    }

    /// Ends the device, as the loss of a card does: what runs on it fails from now on.
    pub fn lose(&self) {
        record(&self.trouble, "the device was lost".to_owned());
        self.device.destroy();
    }

    /// An array of a device: numbers of a type, zero at first. `what` names them in an error.
    pub(crate) fn array<T: Pod>(&self, what: &'static str, len: usize) -> Result<Buffer, DeviceError> {
        let usage = BufferUsages::STORAGE | BufferUsages::COPY_SRC | BufferUsages::COPY_DST;
        self.buffer(what, (size_of::<T>() * len.max(1)) as u64, usage)
    }

    /// The same with these numbers.
    pub(crate) fn array_of<T: Pod>(&self, what: &'static str, numbers: &[T]) -> Result<Buffer, DeviceError> {
        let buffer = self.array::<T>(what, numbers.len())?;
        self.write(&buffer, numbers);
        Ok(buffer)
    }

    /// Numbers that all invocations of a shader read.
    pub(crate) fn uniform(&self, numbers: &[u32]) -> Result<Buffer, DeviceError> {
        let usage = BufferUsages::UNIFORM | BufferUsages::COPY_DST;
        let buffer = self.buffer("sizes", size_of_val(numbers) as u64, usage)?;
        self.write(&buffer, numbers);
        Ok(buffer)
    }

    /// An array that the processor reads.
    pub(crate) fn landing(&self, bytes: u64) -> Result<Buffer, DeviceError> {
        self.buffer("results", bytes, BufferUsages::MAP_READ | BufferUsages::COPY_DST)
    }

    fn buffer(&self, what: &'static str, bytes: u64, usage: BufferUsages) -> Result<Buffer, DeviceError> {
        let limits = self.device.limits();
        let limit = limits.max_buffer_size.min(limits.max_storage_buffer_binding_size);
        if bytes > limit {
            return Err(DeviceError::TooLarge { what, bytes, limit, adapter: self.adapter.clone() });
        }
        let size = bytes.next_multiple_of(wgpu::COPY_BUFFER_ALIGNMENT);
        let descriptor = wgpu::BufferDescriptor { label: Some(what), size, usage, mapped_at_creation: false };
        let buffer = self.device.create_buffer(&descriptor);
        self.check()?;
        Ok(buffer)
    }

    /// Sets the first numbers of an array.
    pub(crate) fn write<T: Pod>(&self, buffer: &Buffer, numbers: &[T]) {
        self.write_at(buffer, 0, numbers);
    }

    /// Sets the numbers of an array from a place on.
    pub(crate) fn write_at<T: Pod>(&self, buffer: &Buffer, place: usize, numbers: &[T]) {
        if !numbers.is_empty() {
            self.queue.write_buffer(buffer, (place * size_of::<T>()) as u64, bytemuck::cast_slice(numbers));
        }
    }

    /// Runs commands. The index tells when they have ended, see [`wait`](Self::wait).
    pub(crate) fn submit(&self, encoder: wgpu::CommandEncoder) -> Result<wgpu::SubmissionIndex, DeviceError> {
        let index = self.queue.submit([encoder.finish()]);
        self.check()?;
        Ok(index)
    }

    /// Waits until commands have ended.
    pub(crate) fn wait(&self, index: wgpu::SubmissionIndex) -> Result<(), DeviceError> {
        let submission = PollType::Wait { submission_index: Some(index), timeout: None };
        self.device.poll(submission).map_err(|error| self.failed(error.to_string()))?;
        self.check()
    }

    /// New commands.
    pub(crate) fn commands(&self) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default())
    }

    /// Waits for the device, and reads what commands have copied into a landing array.
    pub(crate) fn read<T: Pod>(&self, landing: &Buffer, len: usize) -> Result<Vec<T>, DeviceError> {
        let slice = landing.slice(..(size_of::<T>() * len) as u64);
        slice.map_async(wgpu::MapMode::Read, |_| ());
        self.device.poll(PollType::wait_indefinitely()).map_err(|error| self.failed(error.to_string()))?;
        self.check()?;
        let view = slice.get_mapped_range().map_err(|error| self.failed(error.to_string()))?;
        let numbers = bytemuck::pod_collect_to_vec(&view);
        drop(view);
        landing.unmap();
        Ok(numbers)
    }

    /// Returns the first error that the device has reported so far.
    pub(crate) fn check(&self) -> Result<(), DeviceError> {
        match self.trouble.lock().unwrap_or_else(PoisonError::into_inner).clone() {
            Some(message) => Err(self.failed(message)),
            None => Ok(()),
        }
    }

    fn failed(&self, message: String) -> DeviceError {
        DeviceError::Failed { adapter: self.adapter.clone(), message }
    }
}

fn record(trouble: &Mutex<Option<String>>, message: String) {
    trouble.lock().unwrap_or_else(PoisonError::into_inner).get_or_insert(message);
}
