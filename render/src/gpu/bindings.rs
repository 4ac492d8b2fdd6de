//! Bind groups and their layouts, from lists in the order of the binding numbers.

use wgpu::*;

/// A bind group layout; the binding numbers are the indices in `bindings`.
pub(super) fn bind_group_layout(
    device: &Device,
    label: &str,
    visibility: ShaderStages,
    bindings: &[BindingType],
) -> BindGroupLayout {
    let entries: Vec<BindGroupLayoutEntry> = (0..)
        .zip(bindings)
        .map(|(binding, &ty)| BindGroupLayoutEntry {
            binding,
            visibility,
            ty,
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&BindGroupLayoutDescriptor {
        label: Some(label),
        entries: &entries,
    })
}

/// A bind group; the binding numbers are the indices in `resources`.
pub(super) fn bind_group<const N: usize>(
    device: &Device,
    label: &str,
    layout: &BindGroupLayout,
    resources: [BindingResource<'_>; N],
) -> BindGroup {
    let entries: Vec<BindGroupEntry<'_>> = (0..)
        .zip(resources)
        .map(|(binding, resource)| BindGroupEntry { binding, resource })
        .collect();
    device.create_bind_group(&BindGroupDescriptor {
        label: Some(label),
        layout,
        entries: &entries,
    })
}

/// The layout of a pipeline with bind groups of these layouts.
pub(super) fn pipeline_layout(
    device: &Device,
    label: &str,
    groups: &[&BindGroupLayout],
) -> PipelineLayout {
    let groups: Vec<_> = groups.iter().copied().map(Some).collect();
    device.create_pipeline_layout(&PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts: &groups,
        immediate_size: 0,
    })
}

/// The binding of `size_of::<T>()` bytes of a buffer, which start at a dynamic offset.
pub(super) fn block_of<T>(buffer: &Buffer) -> BindingResource<'_> {
    BindingResource::Buffer(BufferBinding {
        buffer,
        offset: 0,
        size: BufferSize::new(size_of::<T>() as u64),
    })
}

pub(super) fn uniform_binding(has_dynamic_offset: bool) -> BindingType {
    BindingType::Buffer {
        ty: BufferBindingType::Uniform,
        has_dynamic_offset,
        min_binding_size: None,
    }
}

pub(super) fn storage_buffer_binding(read_only: bool) -> BindingType {
    BindingType::Buffer {
        ty: BufferBindingType::Storage { read_only },
        has_dynamic_offset: false,
        min_binding_size: None,
    }
}

pub(super) fn texture_binding(
    view_dimension: TextureViewDimension,
    filterable: bool,
) -> BindingType {
    BindingType::Texture {
        sample_type: TextureSampleType::Float { filterable },
        view_dimension,
        multisampled: false,
    }
}

pub(super) fn uint_texture_binding() -> BindingType {
    BindingType::Texture {
        sample_type: TextureSampleType::Uint,
        view_dimension: TextureViewDimension::D2,
        multisampled: false,
    }
}

pub(super) fn storage_texture_binding(format: TextureFormat) -> BindingType {
    BindingType::StorageTexture {
        access: StorageTextureAccess::WriteOnly,
        format,
        view_dimension: TextureViewDimension::D2,
    }
}

/// A uniform buffer of this size in bytes, to be written by the queue.
pub(super) fn uniform_buffer(device: &Device, label: &str, size: u64) -> Buffer {
    device.create_buffer(&BufferDescriptor {
        label: Some(label),
        size,
        usage: BufferUsages::UNIFORM | BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}
