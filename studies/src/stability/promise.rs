use super::TOLERANCE;
use crate::methods::{Family, MethodInfo};
use crate::table_error::Zone;
use lensbake_core::Observer;

/// The largest error that one of this project's own methods may have for `observer`, rad: [`TOLERANCE`], and below the
/// horizon, of the table only, the error that `bake diff --motion fall` allows it there.
pub fn promise(info: &MethodInfo, observer: &Observer) -> f64 {
    match (info.family, Zone::of(observer)) {
        (Family::Table, Zone::Below) => 2e-6,
        (Family::Table, Zone::Deep) => 3e-5,
        _ => TOLERANCE,
    }
}
