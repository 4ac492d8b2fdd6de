//! Keyframes, as a user writes them and a program records them.

use lensbake_core::Motion;
use serde::{Deserialize, Deserializer, Serialize};

/// A path: keyframes at growing times. Its text is JSON; `docs/film.md` describes it.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FlightPath {
    /// How the camera starts and stops.
    #[serde(default, skip_serializing_if = "Ends::is_gentle")]
    pub ends: Ends,
    /// The keyframes.
    pub keyframes: Vec<Keyframe>,
}

/// How what is interpolated starts at the first keyframe and stops at the last one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Ends {
    /// It speeds up from a standstill, and slows down to one.
    #[default]
    Gentle,
    /// It moves at the rate between the two keyframes at that end, for films that are cut or loop there.
    Steady,
}

impl Ends {
    fn is_gentle(&self) -> bool {
        *self == Ends::Gentle
    }
}

/// A keyframe. What it leaves out is interpolated between the keyframes that name it. Lengths are in units of r_s, angles
/// in degrees as in [`View`](lensbake_render::camera::View), and may go on beyond 360.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Keyframe {
    /// Time since the beginning of the film, s.
    pub time: f64,
    /// Motion from this keyframe until one that names another.
    #[serde(
        default,
        deserialize_with = "named",
        skip_serializing_if = "Option::is_none"
    )]
    pub motion: Option<KeyframeMotion>,
    /// Radius.
    #[serde(
        default,
        deserialize_with = "named",
        skip_serializing_if = "Option::is_none"
    )]
    pub radius: Option<f64>,
    /// Longitude around the hole.
    #[serde(
        default,
        deserialize_with = "named",
        skip_serializing_if = "Option::is_none"
    )]
    pub orbit: Option<f64>,
    /// Latitude around the hole.
    #[serde(
        default,
        deserialize_with = "named",
        skip_serializing_if = "Option::is_none"
    )]
    pub latitude: Option<f64>,
    /// Heading of the motion `orbit`, from east (growing longitude) towards north.
    #[serde(
        default,
        deserialize_with = "named",
        skip_serializing_if = "Option::is_none"
    )]
    pub heading: Option<f64>,
    /// Rotation of the view to the right, away from the hole.
    #[serde(
        default,
        deserialize_with = "named",
        skip_serializing_if = "Option::is_none"
    )]
    pub yaw: Option<f64>,
    /// Rotation of the view upwards, away from the hole.
    #[serde(
        default,
        deserialize_with = "named",
        skip_serializing_if = "Option::is_none"
    )]
    pub pitch: Option<f64>,
    /// Clockwise roll of the camera.
    #[serde(
        default,
        deserialize_with = "named",
        skip_serializing_if = "Option::is_none"
    )]
    pub roll: Option<f64>,
    /// Horizontal field of view.
    #[serde(
        default,
        deserialize_with = "named",
        skip_serializing_if = "Option::is_none"
    )]
    pub fov: Option<f64>,
    /// Exposure, stops.
    #[serde(
        default,
        deserialize_with = "named",
        skip_serializing_if = "Option::is_none"
    )]
    pub exposure: Option<f64>,
    /// Eastward turn of the sky around its poles.
    #[serde(
        default,
        deserialize_with = "named",
        skip_serializing_if = "Option::is_none"
    )]
    pub sky_turn: Option<f64>,
    /// Proper time of the motions `orbit` and `fall` that passes per second of film, r_s/c.
    #[serde(
        default,
        deserialize_with = "named",
        skip_serializing_if = "Option::is_none"
    )]
    pub clock_rate: Option<f64>,
}

/// How the camera moves from a keyframe on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum KeyframeMotion {
    /// At rest at every moment; carried from keyframe to keyframe.
    #[default]
    Rest,
    /// On the circular orbit at the radius of the keyframe, by proper time.
    Orbit,
    /// In free fall (from rest at infinity) from the radius of the keyframe, by proper time.
    Fall,
}

/// A field that is named must have a value. Some programs write `null` for a number that is not finite; it is not a value.
fn named<'de, T: Deserialize<'de>, D: Deserializer<'de>>(text: D) -> Result<Option<T>, D::Error> {
    T::deserialize(text).map(Some)
}

impl KeyframeMotion {
    /// Name in JSON.
    pub fn name(self) -> &'static str {
        match self {
            KeyframeMotion::Rest => "rest",
            KeyframeMotion::Orbit => "orbit",
            KeyframeMotion::Fall => "fall",
        }
    }
}

impl From<KeyframeMotion> for Motion {
    fn from(motion: KeyframeMotion) -> Self {
        match motion {
            KeyframeMotion::Rest => Motion::Rest,
            KeyframeMotion::Orbit => Motion::Orbit,
            KeyframeMotion::Fall => Motion::Fall,
        }
    }
}

impl FlightPath {
    /// The path as JSON, one keyframe a line.
    pub fn to_json(&self) -> String {
        let lines = self.keyframes.iter().map(|keyframe| {
            // Numbers and names always have a JSON text; that of a number that is not finite is refused when it is read.
            let json = serde_json::to_string(keyframe).unwrap_or_default();
            format!("    {json}")
        });
        let ends = match self.ends {
            Ends::Gentle => "",
            Ends::Steady => "  \"ends\": \"steady\",\n",
        };
        let lines: Vec<String> = lines.collect();
        format!(
            "{{\n{ends}  \"keyframes\": [\n{}\n  ]\n}}\n",
            lines.join(",\n")
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Channel;

    /// A keyframe that names everything.
    pub(crate) fn full() -> Keyframe {
        let mut keyframe = Keyframe {
            time: 1.5,
            motion: Some(KeyframeMotion::Fall),
            ..Keyframe::default()
        };
        for (i, channel) in Channel::ALL.into_iter().enumerate() {
            channel.set(&mut keyframe, 2.0 + 0.1 * i as f64);
        }
        keyframe
    }

    #[test]
    fn a_path_is_read_back_from_its_text() {
        for ends in [Ends::Gentle, Ends::Steady] {
            let path = FlightPath {
                ends,
                keyframes: vec![Keyframe::default(), full()],
            };
            assert_eq!(path.to_json().parse(), Ok(path.clone()));
            let text = serde_json::to_string(&path).unwrap();
            assert_eq!(text.parse(), Ok(path));
        }
    }

    #[test]
    fn the_motions_have_their_names() {
        for motion in [
            KeyframeMotion::Rest,
            KeyframeMotion::Orbit,
            KeyframeMotion::Fall,
        ] {
            assert_eq!(serde_json::to_value(motion).unwrap(), motion.name());
            assert_eq!(motion.name().parse::<Motion>(), Ok(motion.into()));
        }
    }

    #[test]
    fn the_channels_have_the_names_of_the_fields() {
        let serde_json::Value::Object(fields) = serde_json::to_value(full()).unwrap() else {
            panic!("an object")
        };
        let mut names: Vec<&str> = Channel::ALL.iter().map(|channel| channel.name()).collect();
        names.extend(["time", "motion"]);
        names.sort_unstable();
        assert_eq!(fields.keys().collect::<Vec<_>>(), names);
        for channel in Channel::ALL {
            assert_eq!(fields[channel.name()].as_f64(), channel.of(&full()));
        }
    }
}
