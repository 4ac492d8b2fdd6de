//! Choice of the wgpu backend (the graphics API): any, or one of those that `WGPU_BACKEND` names.

use super::GpuError;
use std::env;
use wgpu::{Backends, Instance};

/// The environment variable that names the backends.
const VARIABLE: &str = "WGPU_BACKEND";
/// The names that `WGPU_BACKEND` accepts; each has shorter aliases, such as `vk`.
const NAMES: [(&str, Backends); 4] = [
    ("vulkan", Backends::VULKAN),
    ("metal", Backends::METAL),
    ("dx12", Backends::DX12),
    ("gl", Backends::GL),
];

/// The backends on which to look for adapters: those that `WGPU_BACKEND` names, or all that are available.
///
/// # Errors
/// [`GpuError::Backend`] if it names one that is unknown or not available on this system.
pub(super) fn asked_for() -> Result<Backends, GpuError> {
    let has = Instance::enabled_backend_features();
    match env::var_os(VARIABLE) {
        Some(names) => named(&names.to_string_lossy(), has),
        None => Ok(has),
    }
}

/// The backends in a comma-separated list of names; all available ones if it is empty.
fn named(names: &str, has: Backends) -> Result<Backends, GpuError> {
    if names.trim().is_empty() {
        return Ok(has);
    }
    let mut all = Backends::empty();
    for name in names.split(',') {
        let one = Backends::from_comma_list(name);
        if one.is_empty() || !has.contains(one) {
            let known = NAMES.iter().filter(|(_, backend)| has.contains(*backend));
            let known: Vec<&str> = known.map(|(name, _)| *name).collect();
            return Err(GpuError::Backend {
                asked: names.to_owned(),
                known: known.join(" or "),
            });
        }
        all |= one;
    }
    Ok(all)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_looked_up_among_those_that_there_are() {
        let has = Backends::VULKAN | Backends::DX12;
        assert_eq!(named("", has), Ok(has));
        assert_eq!(named(" ", has), Ok(has));
        assert_eq!(named("vulkan", has), Ok(Backends::VULKAN));
        assert_eq!(named("VK , dx12", has), Ok(has));
        for bad in ["foo", "metal", "vulkan,foo", "vulkan,", ",", "noop"] {
            let error = named(bad, has).unwrap_err().to_string();
            assert!(
                error.contains(bad) && error.contains("vulkan or dx12"),
                "{error}"
            );
        }
    }

    #[test]
    fn each_name_is_one_that_the_library_knows() {
        for (name, backend) in NAMES {
            assert_eq!(Backends::from_comma_list(name), backend);
        }
    }
}
