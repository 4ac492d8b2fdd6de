//! What a shader is specialised for in the camera.

use super::source::alias_module;
use crate::camera::{Camera, Mapping};
use crate::shaders::Modules;

/// What a shader is specialised for in the camera: its motion, and its map from view directions to the picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub struct CameraKey {
    /// Whether the observer of the row moves.
    pub(super) radial: bool,
    /// Whether the camera has a boost relative to that observer.
    pub(super) boosted: bool,
    /// The map from view directions to the picture.
    pub(super) mapping: Mapping,
}

impl CameraKey {
    /// A camera at rest, in perspective.
    pub const AT_REST: CameraKey = CameraKey {
        radial: false,
        boosted: false,
        mapping: Mapping::Perspective,
    };
    /// A camera with a boost relative to an observer at rest, in perspective.
    pub const BOOSTED: CameraKey = CameraKey {
        boosted: true,
        ..CameraKey::AT_REST
    };

    /// The key of a camera.
    pub fn of(camera: &Camera) -> Self {
        CameraKey {
            radial: !camera.observer.is_at_rest(),
            boosted: camera.boost.is_some(),
            mapping: camera.mapping,
        }
    }

    /// The key where a radial motion is part of the row.
    pub(super) fn without_radial_motion(self) -> Self {
        CameraKey {
            radial: false,
            ..self
        }
    }

    /// The modules that it selects, by the names that other modules import.
    pub(super) fn define(self, modules: &mut Modules) {
        let either = |is: bool, yes: &str, no: &str| alias_module(if is { yes } else { no });
        modules.define("view", either(self.boosted, "view_boosted", "view_rest"));
        modules.define(
            "observe",
            either(self.boosted, "observe_boosted", "observe_rest"),
        );
        modules.define("start", either(self.radial, "start_moving", "start_rest"));
        modules.define(
            "ray",
            alias_module(match self.mapping {
                Mapping::Perspective => "ray_perspective",
                Mapping::Equirectangular => "ray_equirectangular",
                Mapping::Equidistant => "ray_equidistant",
            }),
        );
    }
}
