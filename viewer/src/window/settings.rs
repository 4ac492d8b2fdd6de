//! What the window is told to show; keys and panel change it, a frame reads it.

use super::keys::Change;
use super::motion::{self, ORBIT_SPEEDS};
use super::resolution::Resolution;
use crate::camera::View;
use crate::gpu::{Edge, Show, Showing};
use crate::scene::{Method, Sampling};
use std::ops::RangeInclusive;
use std::time::Duration;
use thiserror::Error;

/// Table against direct integration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Comparison {
    /// The table alone.
    Table,
    /// Direct integration alone.
    Direct,
    /// The table on the left, direct integration on the right of a divider.
    Split,
    /// How far their pictures are apart, amplified.
    Difference,
}

impl Comparison {
    /// All of them, in the order of the key.
    pub const ALL: [Comparison; 4] = [
        Comparison::Table,
        Comparison::Direct,
        Comparison::Split,
        Comparison::Difference,
    ];

    /// Its name.
    pub fn name(self) -> &'static str {
        match self {
            Comparison::Table => "table",
            Comparison::Direct => "direct",
            Comparison::Split => "split",
            Comparison::Difference => "difference",
        }
    }
}

/// All of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Where the camera is and looks; its size is the window's.
    pub view: View,
    /// Which of [`ORBIT_SPEEDS`].
    pub orbit_speed: usize,
    /// Whether the light is bent.
    pub deflection: bool,
    /// By whom.
    pub comparison: Comparison,
    /// Step of the direct integrator, rad.
    pub step: f64,
    /// What of its area a pixel shows.
    pub sampling: Sampling,
    /// Where the divider stands, as a part of the window's width.
    pub divider: f64,
    /// What a difference is multiplied by.
    pub gain: f32,
    /// How much brighter the sky is shown, in stops.
    pub exposure: f32,
    /// How many pixels are drawn for each of the window's.
    pub resolution: Resolution,
    /// The frame time that the automatic resolution holds, ms.
    pub target_ms: f64,
    /// Whether the panel is there.
    pub panel: bool,
    /// Whether the help is there.
    pub help: bool,
}

/// A number among the settings that makes no sense.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error("{what} {value} is not from {least} to {most}")]
pub struct OutOfRange {
    /// Which.
    pub what: &'static str,
    /// What it is.
    pub value: f64,
    /// The least that it may be.
    pub least: f64,
    /// The most.
    pub most: f64,
}

impl Settings {
    /// Gains that make sense: with 1 nothing is amplified.
    pub const GAINS: RangeInclusive<f32> = 1.0..=1048576.0;

    /// Exposures to choose from, stops.
    pub const EXPOSURES: RangeInclusive<f32> = -8.0..=8.0;

    /// Frame times for the automatic resolution to hold, ms.
    pub const TARGETS_MS: RangeInclusive<f64> = 4.0..=200.0;

    /// The settings at the start, in a view.
    pub fn new(view: View, step: f64) -> Self {
        Settings {
            view: motion::unwound(&view),
            orbit_speed: 0,
            deflection: true,
            comparison: Comparison::Table,
            step,
            sampling: Sampling::Filtered,
            divider: 0.5,
            gain: 256.0,
            exposure: 0.0,
            resolution: Resolution::Full,
            target_ms: 1000.0 / 60.0,
            panel: true,
            help: false,
        }
    }

    /// All numbers, each as a function that copies it from the second settings to the first. With them a
    /// change can be taken over in part.
    pub(super) const PARTS: [fn(&mut Settings, &Settings); 11] = [
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
    ];

    /// Checks the numbers that are not the camera's.
    ///
    /// # Errors
    /// [`OutOfRange`] names the first that is not in its range.
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

    /// Who turns the light.
    pub fn method(&self) -> Method {
        match self.comparison {
            _ if !self.deflection => Method::Flat,
            Comparison::Table => Method::Lut,
            _ => Method::Direct { step: self.step },
        }
    }

    /// What a frame of `width` pixels across shows.
    pub fn show(&self, width: u32) -> Show {
        match self.comparison {
            Comparison::Split if self.is_split() => Show::Split {
                divider: self.divider_column(width),
            },
            Comparison::Difference if self.deflection => Show::Difference { gain: self.gain },
            _ => Show::Picture,
        }
    }

    /// How it is shown in a window of `width` pixels across.
    pub fn showing(&self, width: u32) -> Showing {
        let edge = match self.show(width) {
            // The direct integrator draws an edge of its own, which is to be seen as it is.
            Show::Picture if self.method() == Method::Lut => Edge::Shadow,
            Show::Picture if self.method() == Method::Flat => Edge::Sphere,
            _ => Edge::AsDrawn,
        };
        Showing {
            edge,
            divider: self.is_split().then(|| self.divider_column(width)),
            exposure: self.exposure,
        }
    }

    /// The column in which the divider stands.
    pub fn divider_column(&self, width: u32) -> u32 {
        (self.divider * f64::from(width)).round() as u32
    }

    /// Changes them as a key does.
    pub fn change(&mut self, change: Change) {
        match change {
            Change::NextOrbitSpeed => {
                self.orbit_speed = (self.orbit_speed + 1) % ORBIT_SPEEDS.len();
            }
            Change::ToggleDeflection => self.deflection ^= true,
            Change::ToggleFilter => {
                let all = [Sampling::Filtered, Sampling::Single];
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

    /// The frame time that the automatic resolution holds.
    pub fn target(&self) -> Duration {
        Duration::from_secs_f64(1e-3 * self.target_ms)
    }
}

/// The one after `now` in `all`, round and round.
pub fn next<T: PartialEq + Copy>(all: &[T], now: T) -> T {
    let at = all.iter().position(|&one| one == now).unwrap_or(0);
    all[(at + 1) % all.len()]
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
            assert_eq!(settings.method(), Method::Flat);
            assert_eq!(settings.show(100), Show::Picture);
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
