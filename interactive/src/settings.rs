//! Settings of the window: keys, mouse and panel change them, a frame reads them.

use crate::fall::Fall;
use crate::keys::Change;
use crate::motion::{self, ORBIT_SPEEDS, USUAL_CLOCK_RATE};
use crate::resolution::Resolution;
use lensbake_core::Motion;
use lensbake_render::camera::View;
use lensbake_render::disc::Disc;
use lensbake_render::exposure;
use lensbake_render::gpu::{EdgeMode, FrameContent, Presentation};
use lensbake_render::lens::{Deflection, Lens};
use lensbake_render::scene::Sampling;
use lensbake_render::shadow::Shadow;
use lensbake_render::shift::{Rendition, Shift};
use std::ops::RangeInclusive;
use std::time::Duration;
use thiserror::Error;

/// Comparison of table lookup and direct integration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// The table alone.
    Table,
    /// Direct integration alone.
    Direct,
    /// The table on the left, direct integration on the right of a divider.
    Split,
    /// The difference of the two pictures, amplified.
    Difference,
}

impl Comparison {
    /// All comparisons, in the order in which the key cycles through them.
    pub const ALL: [Comparison; 4] = [
        Comparison::Table,
        Comparison::Direct,
        Comparison::Split,
        Comparison::Difference,
    ];

    /// The name in panel and title bar.
    pub fn name(self) -> &'static str {
        match self {
            Comparison::Table => "table",
            Comparison::Direct => "direct",
            Comparison::Split => "split",
            Comparison::Difference => "difference",
        }
    }
}

/// What of the frequency shift can be shown, in the order in which the key cycles through it.
pub const SHIFTS: [Shift; 3] = [Shift::Off, Shift::Brightness, Shift::Colour];

/// The settings.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Position, orientation and field of view of the camera; its size in pixels is replaced by the window's.
    pub view: View,
    /// The velocity that a flag gave, which can be chosen as a motion.
    pub given_velocity: Option<Motion>,
    /// The fall by proper time, once the camera has let go.
    pub fall: Option<Fall>,
    /// Index of the proper time per second.
    pub clock_rate: usize,
    /// Whether the camera in orbit moves by the true period.
    pub true_period: bool,
    /// Index into [`ORBIT_SPEEDS`], for the camera at rest.
    pub orbit_speed: usize,
    /// Whether light is deflected.
    pub deflection: bool,
    /// Deflection method, or a comparison of two.
    pub comparison: Comparison,
    /// Step of the direct integrator, rad.
    pub step: f64,
    /// How a pixel samples its area.
    pub sampling: Sampling,
    /// Position of the divider, as a part of the window's width.
    pub divider: f64,
    /// Factor that amplifies the difference.
    pub gain: f32,
    /// Exposure of the picture, stops.
    pub exposure: f32,
    /// What of the frequency shift of the sky is shown.
    pub shift: Shift,
    /// Whether the disc is shown.
    pub disc_shown: bool,
    /// The disc, which keeps its values while it is not shown.
    pub disc: Disc,
    /// Whether the exposure makes up for the brightness of the frequency shift.
    pub auto_exposure: bool,
    /// Resolution of the picture relative to the window.
    pub resolution: Resolution,
    /// Frame-time target of the dynamic resolution, ms.
    pub target_ms: f64,
    /// Whether the panel is shown.
    pub panel: bool,
    /// Whether the help is shown.
    pub help: bool,
}

/// A setting that is out of range.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("{what} {value} is not from {least} to {most}")]
pub struct OutOfRange {
    /// Name of the setting.
    pub what: &'static str,
    /// Value of the setting.
    pub value: f64,
    /// Least valid value.
    pub least: f64,
    /// Greatest valid value.
    pub most: f64,
}

impl Settings {
    /// Valid gains; 1 does not amplify.
    pub const GAINS: RangeInclusive<f32> = 1.0..=1048576.0;

    /// Valid exposures, stops.
    pub const EXPOSURES: RangeInclusive<f32> = -8.0..=8.0;

    /// Valid frame-time targets, ms.
    pub const TARGETS_MS: RangeInclusive<f64> = 4.0..=200.0;

    /// The settings at the start, with this view and step of direct integration (rad).
    pub fn new(view: View, step: f64) -> Self {
        Settings {
            view: motion::unwound(&view),
            given_velocity: Some(view.motion)
                .filter(|motion| matches!(motion, Motion::Velocity { .. })),
            fall: None,
            clock_rate: USUAL_CLOCK_RATE,
            true_period: false,
            orbit_speed: 0,
            deflection: true,
            comparison: Comparison::Table,
            step,
            sampling: Sampling::Filtered,
            divider: 0.5,
            gain: 256.0,
            exposure: 0.0,
            shift: Shift::Off,
            disc_shown: false,
            disc: Disc::default(),
            auto_exposure: true,
            resolution: Resolution::Full,
            target_ms: 1000.0 / 60.0,
            panel: true,
            help: false,
        }
    }

    /// One function for each part on which it depends whether the settings can be drawn. It copies the part from the
    /// second settings to the first, so that a change can be kept in part. The last two are for numbers that are possible
    /// only together: the radii of a disc, and a radius and a motion.
    pub const PARTS: [fn(&mut Settings, &Settings); 22] = [
        |to, from| to.view.radius = from.view.radius,
        |to, from| to.view.fov_deg = from.view.fov_deg,
        |to, from| to.view.yaw_deg = from.view.yaw_deg,
        |to, from| to.view.pitch_deg = from.view.pitch_deg,
        |to, from| to.view.roll_deg = from.view.roll_deg,
        |to, from| to.view.orbit_deg = from.view.orbit_deg,
        |to, from| to.view.latitude_deg = from.view.latitude_deg,
        |to, from| to.divider = from.divider,
        |to, from| to.gain = from.gain,
        |to, from| to.exposure = from.exposure,
        |to, from| to.target_ms = from.target_ms,
        |to, from| to.view.heading_deg = from.view.heading_deg,
        |to, from| to.view.motion = from.view.motion,
        |to, from| to.disc.inner = from.disc.inner,
        |to, from| to.disc.outer = from.disc.outer,
        |to, from| to.disc.orientation.inclination_deg = from.disc.orientation.inclination_deg,
        |to, from| to.disc.orientation.node_deg = from.disc.orientation.node_deg,
        |to, from| to.disc.opacity = from.disc.opacity,
        |to, from| to.disc.peak_kelvin = from.disc.peak_kelvin,
        |to, from| to.disc.brightness = from.disc.brightness,
        |to, from| (to.disc.inner, to.disc.outer) = (from.disc.inner, from.disc.outer),
        |to, from| (to.view.radius, to.view.motion) = (from.view.radius, from.view.motion),
    ];

    /// Checks the numbers that belong neither to the camera nor to the disc.
    ///
    /// # Errors
    /// [`OutOfRange`] for the first number that is not in its range.
    pub fn check(&self) -> Result<(), OutOfRange> {
        let wide = |range: RangeInclusive<f32>| f64::from(*range.start())..=f64::from(*range.end());
        let numbers = [
            ("divider", self.divider, 0.0..=1.0),
            ("amplification", self.gain.into(), wide(Self::GAINS)),
            ("exposure", self.exposure.into(), wide(Self::EXPOSURES)),
            ("frame time", self.target_ms, Self::TARGETS_MS),
        ];
        for (what, value, range) in numbers {
            if !range.contains(&value) {
                let (least, most) = range.into_inner();
                return Err(OutOfRange {
                    what,
                    value,
                    least,
                    most,
                });
            }
        }
        Ok(())
    }

    /// Deflection method; direct integration for a comparison.
    pub fn method(&self) -> Deflection {
        match self.comparison {
            _ if !self.deflection => Deflection::Flat,
            Comparison::Table => Deflection::Lut,
            _ => Deflection::Direct { step: self.step },
        }
    }

    /// What a frame that is `width` pixels wide shows.
    pub fn show(&self, width: u32) -> FrameContent {
        match self.comparison {
            Comparison::Split if self.is_split() => FrameContent::Split {
                divider: self.divider_column(width),
            },
            Comparison::Difference if self.deflection => {
                FrameContent::Difference { gain: self.gain }
            }
            _ => FrameContent::Picture,
        }
    }

    /// How the light of the sky becomes light of the picture of `lens`.
    pub fn rendition(&self, lens: &Lens) -> Rendition {
        let stops = match self.auto_exposure {
            true => exposure::automatic(lens, self.shift),
            false => 0.0,
        };
        Rendition {
            shift: self.shift,
            light_scale: stops.exp2(),
        }
    }

    /// How the picture of `lens` is shown in a window that is `width` pixels wide.
    pub fn presentation(&self, width: u32, lens: &Lens) -> Presentation {
        let edge = match (self.show(width), lens.deflection) {
            // A disc covers a part of the shadow.
            _ if self.disc_shown => EdgeMode::AsDrawn,
            // Direct integration draws its own shadow boundary, which is shown as it is.
            (FrameContent::Picture, Deflection::Lut | Deflection::Flat) => {
                EdgeMode::Redrawn(Shadow::of(lens))
            }
            _ => EdgeMode::AsDrawn,
        };
        Presentation {
            edge,
            divider: self.is_split().then(|| self.divider_column(width)),
            exposure: self.exposure,
        }
    }

    /// Column of the divider in a frame that is `width` pixels wide.
    pub fn divider_column(&self, width: u32) -> u32 {
        (self.divider * f64::from(width)).round() as u32
    }

    /// Applies the change of a key.
    pub fn change(&mut self, change: Change) {
        match change {
            Change::NextMotion => self.choose_next_motion(),
            Change::LetGo => self.let_go(),
            Change::BackToLetGo => self.back_to_let_go(),
            Change::SlowerClock => self.change_clock_rate(-1),
            Change::FasterClock => self.change_clock_rate(1),
            Change::NextOrbitSpeed => self.next_orbit_speed(),
            Change::ToggleDisc => self.disc_shown ^= true,
            Change::NextShift => self.shift = next(&SHIFTS, self.shift),
            Change::ToggleAutoExposure => self.auto_exposure ^= true,
            Change::ToggleDeflection => self.deflection ^= true,
            Change::ToggleFilter => {
                let all = [Sampling::Filtered, Sampling::Anisotropic, Sampling::Single];
                self.sampling = next(&all, self.sampling);
            }
            Change::NextComparison => self.comparison = next(&Comparison::ALL, self.comparison),
            Change::NextResolution => self.resolution = next(&Resolution::ALL, self.resolution),
            Change::ZoomIn => motion::zoom(&mut self.view, 1.0),
            Change::ZoomOut => motion::zoom(&mut self.view, -1.0),
            Change::MoreGain => self.amplify(4.0),
            Change::LessGain => self.amplify(0.25),
            Change::TogglePanel => self.panel ^= true,
            Change::ToggleHelp => self.help ^= true,
        }
    }

    fn next_orbit_speed(&mut self) {
        match self.view.motion {
            Motion::Rest => self.orbit_speed = (self.orbit_speed + 1) % ORBIT_SPEEDS.len(),
            Motion::Orbit => self.true_period ^= true,
            Motion::Fall | Motion::Velocity { .. } => (),
        }
    }

    fn amplify(&mut self, factor: f32) {
        self.gain = (self.gain * factor).clamp(*Self::GAINS.start(), *Self::GAINS.end());
    }

    /// Whether a divider can be dragged.
    pub fn is_split(&self) -> bool {
        self.deflection && self.comparison == Comparison::Split
    }

    /// Orbit speed as a multiple of 1×.
    pub fn orbit_speed(&self) -> f64 {
        ORBIT_SPEEDS[self.orbit_speed]
    }

    /// Frame-time target of the dynamic resolution.
    pub fn target(&self) -> Duration {
        Duration::from_secs_f64(1e-3 * self.target_ms)
    }
}

/// The element after `now` in `all`, cyclically.
pub fn next<T: PartialEq + Copy>(all: &[T], now: T) -> T {
    let at = all.iter().position(|&one| one == now).unwrap_or(0);
    all[(at + 1) % all.len()]
}

/// The settings of a camera at this radius in this motion, for tests.
#[cfg(test)]
pub(crate) fn at(radius: f64, motion: Motion) -> Settings {
    let view = View {
        radius,
        motion,
        ..View::default()
    };
    Settings::new(view, 0.05)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn without_deflection_nothing_is_compared() {
        let mut settings = Settings::new(View::default(), 0.05);
        settings.deflection = false;
        for comparison in Comparison::ALL {
            settings.comparison = comparison;
            assert_eq!(settings.method(), Deflection::Flat);
            assert_eq!(settings.show(100), FrameContent::Picture);
        }
    }

    #[test]
    fn comparisons_go_round() {
        let mut comparison = Comparison::Table;
        let mut seen = Vec::new();
        for _ in 0..5 {
            seen.push(comparison);
            comparison = next(&Comparison::ALL, comparison);
        }
        assert_eq!(seen[..4], Comparison::ALL);
        assert_eq!(seen[4], Comparison::Table);
    }
}
