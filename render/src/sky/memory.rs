//! Checked memory allocation for the samples that a picture declares.

/// There is not enough memory.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error("its pixels take {mebibytes} MiB of memory, which there are not")]
pub(super) struct NoMemory {
    mebibytes: usize,
}

/// `count` zeros, or an error if there is not enough memory.
pub(super) fn zeros(count: usize) -> Result<Vec<f32>, NoMemory> {
    let mut samples = Vec::new();
    samples
        .try_reserve_exact(count)
        .map_err(|_| no_memory(count.saturating_mul(4)))?;
    samples.resize(count, 0.0);
    Ok(samples)
}

/// Checks that `bytes` can be allocated, before a library call that would abort the program on failure.
pub(super) fn check(bytes: u64) -> Result<(), NoMemory> {
    let bytes = usize::try_from(bytes).unwrap_or(usize::MAX);
    Vec::<u8>::new()
        .try_reserve_exact(bytes)
        .map_err(|_| no_memory(bytes))
}

fn no_memory(bytes: usize) -> NoMemory {
    NoMemory {
        mebibytes: bytes >> 20,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn memory_that_is_not_there_is_an_error() {
        assert_eq!(zeros(7), Ok(vec![0.0; 7]));
        assert!(zeros(usize::MAX / 8).is_err());
        assert!(check(1 << 20).is_ok());
        let told = check(u64::MAX).unwrap_err().to_string();
        assert!(told.contains("17592186044415 MiB"), "{told}");
    }
}
