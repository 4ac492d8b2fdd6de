//! Reads a path from JSON. If it is none, finds the field to blame.

use crate::{Channel, FlightPath, Keyframe, PathError};
use lensbake_tables::text::on_one_line;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value, json};
use std::str::FromStr;

impl FromStr for FlightPath {
    type Err = PathError;

    /// Reads a path from its JSON. The result is not yet checked: see [`Flight::new`](crate::Flight::new).
    fn from_str(text: &str) -> Result<Self, PathError> {
        serde_json::from_str(text).map_err(|error| blame(text, &error))
    }
}

/// Similarity of two names (Jaro–Winkler) from which one is taken for a typo of the other.
const SIMILAR: f64 = 0.75;

/// The error of a `text` that serde_json refuses with `error`, with the name of the field if there is one to blame.
fn blame(text: &str, error: &serde_json::Error) -> PathError {
    let problem = error.to_string();
    let Ok(value) = serde_json::from_str::<Value>(text) else {
        return match field_before(text, error.line(), error.column()) {
            // Where the text ends too early, the last field is not to blame.
            Some(field) if !error.is_eof() => blamed(field, &problem),
            _ => unblamed(&problem),
        };
    };
    in_path(&value).unwrap_or_else(|| unblamed(&problem))
}

/// The error `problem` of the field `field`. Both may repeat strings of the file, in which a line break can be escaped.
fn blamed(field: &str, problem: &str) -> PathError {
    PathError::Field {
        field: on_one_line(field),
        problem: on_one_line(problem),
    }
}

/// The error `problem`, for which no field is to blame.
fn unblamed(problem: &str) -> PathError {
    PathError::Json(on_one_line(problem))
}

/// The error in the fields of a path.
fn in_path(path: &Value) -> Option<PathError> {
    let Some(fields) = path.as_object() else {
        let shape = r#"a path is an object: {"keyframes": [{"time": 0, …}, …]}"#;
        return Some(unblamed(shape));
    };
    let names = ["ends", "keyframes"];
    let others = fields.iter().filter(|(name, _)| *name != "keyframes");
    let whole = json!({"keyframes": []});
    let in_fields = others
        .filter_map(|(name, value)| in_field::<FlightPath>("", &names, &whole, name, value))
        .next();
    in_fields.or_else(|| {
        let keyframes = fields.get("keyframes")?.as_array()?;
        let mut numbered = keyframes.iter().enumerate();
        numbered.find_map(|(index, keyframe)| in_keyframe(index, keyframe))
    })
}

/// The error in a keyframe.
fn in_keyframe(index: usize, keyframe: &Value) -> Option<PathError> {
    let place = format!("keyframes[{index}]");
    let names: Vec<&str> = ["time", "motion"]
        .into_iter()
        .chain(Channel::ALL.map(Channel::name))
        .collect();
    let whole = json!({"time": 0});
    let no_fields = Map::new();
    let fields = keyframe.as_object().unwrap_or(&no_fields);
    let in_fields = fields.iter().find_map(|(name, value)| {
        in_field::<Keyframe>(&format!("{place}."), &names, &whole, name, value)
    });
    in_fields.or_else(|| {
        let error = serde_json::from_value::<Keyframe>(keyframe.clone()).err()?;
        Some(blamed(&place, &error.to_string()))
    })
}

/// The error in the field `name`: unknown, or with a value that a `T`, otherwise `whole`, cannot have.
fn in_field<T: DeserializeOwned>(
    place: &str,
    names: &[&str],
    whole: &Value,
    name: &str,
    value: &Value,
) -> Option<PathError> {
    let mut alone = whole.clone();
    alone[name] = value.clone();
    let error = serde_json::from_value::<T>(alone).err()?;
    let problem = match names.contains(&name) {
        true => error.to_string(),
        false => unknown(name, names),
    };
    Some(blamed(&format!("{place}{name}"), &problem))
}

fn unknown(name: &str, names: &[&str]) -> String {
    let similarity = |other: &str| strsim::jaro_winkler(&name.to_lowercase(), other);
    let nearest = names
        .iter()
        .max_by(|a, b| similarity(a).total_cmp(&similarity(b)));
    match nearest {
        Some(nearest) if similarity(nearest) >= SIMILAR => {
            format!("unknown field; did you mean `{nearest}`?")
        }
        _ => format!("unknown field; the fields are {}", names.join(", ")),
    }
}

/// The name of the field whose value begins before this place of `text`, where its syntax is wrong: the last text in
/// quotation marks before a colon.
fn field_before(text: &str, line: usize, column: usize) -> Option<&str> {
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let before: usize = lines
        .iter()
        .take(line.saturating_sub(1))
        .map(|l| l.len())
        .sum();
    let upto = text.get(..before + column).unwrap_or(text);
    let name = upto.rsplit_once(':')?.0.trim_end().strip_suffix('"')?;
    name.rsplit_once('"').map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[track_caller]
    fn refused(text: &str, words: &[&str]) {
        let said = text.parse::<FlightPath>().unwrap_err().to_string();
        for word in words {
            assert!(said.contains(word), "no '{word}' in: {said}");
        }
        assert_eq!(said.lines().count(), 1, "{said}");
    }

    #[test]
    fn the_field_to_blame_is_named() {
        let keyframes = |fields: &str| format!(r#"{{"keyframes": [{{"time": 0}}, {{{fields}}}]}}"#);
        for (fields, words) in [
            (
                r#""time": 1, "radus": 3"#,
                &["keyframes[1].radus", "did you mean `radius`"][..],
            ),
            (
                r#""time": 1, "Sky": 3"#,
                &["keyframes[1].Sky", "unknown field", "sky_turn"],
            ),
            (
                r#""time": 1, "colour": 3"#,
                &["keyframes[1].colour", "the fields are time, motion"],
            ),
            (
                r#""time": 1, "yaw": "3""#,
                &["keyframes[1].yaw", "expected f64"],
            ),
            (r#""time": 1, "yaw": null"#, &["keyframes[1].yaw", "null"]),
            (
                r#""time": 1, "motion": "fal""#,
                &["keyframes[1].motion", "`rest`, `orbit`, `fall`"],
            ),
            (
                r#""time": 1, "a\nb": 1"#,
                &[r"keyframes[1].a\nb", "unknown field"],
            ),
            (
                r#""time": 1, "motion": "fal\n""#,
                &["keyframes[1].motion", r"`fal\n`"],
            ),
            (r#""radius": 1"#, &["keyframes[1]", "missing field `time`"]),
            (
                r#""time": 1, "yaw": 1, "yaw": 2"#,
                &["duplicate field `yaw`", "line 1"],
            ),
            (r#""time": 1, "yaw": NaN"#, &["yaw: ", "line 1 column"]),
            (
                r#""time": 1, "yaw": -Infinity"#,
                &["yaw: ", "line 1 column"],
            ),
            (
                "\"time\": 1,\n\"yaw\": 1e999",
                &["yaw: ", "number out of range", "line 2"],
            ),
        ] {
            refused(&keyframes(fields), words);
        }
        for (text, words) in [
            ("", &["EOF"][..]),
            ("[]", &["a path is an object"]),
            ("{}", &["missing field `keyframes`"]),
            (
                r#"{"keyframe": []}"#,
                &["keyframe: ", "did you mean `keyframes`"],
            ),
            (
                r#"{"keyframes": [], "ends": "soft"}"#,
                &["ends: ", "`gentle` or `steady`"],
            ),
            (
                r#"{"keyframes": [3]}"#,
                &["keyframes[0]", "expected struct Keyframe"],
            ),
            (r#"{"keyframes": 3}"#, &["expected a sequence"]),
            (
                r#"{"keyframes": [{"time": 0}"#,
                &["EOF while parsing a list"],
            ),
            (r#"{"keyframes": [}"#, &["keyframes", "line 1 column"]),
        ] {
            refused(text, words);
        }
    }

    proptest! {
        #[test]
        fn no_string_of_the_file_breaks_the_line(name in ".*|[\0-\u{1f}]+", text in ".*|[\0-\u{1f}]+") {
            for path in [
                json!({&name: &text}),
                json!({"keyframes": &text}),
                json!({"keyframes": [], "ends": &text}),
                json!({"keyframes": [{"time": 0, &name: &text}]}),
                json!({"keyframes": [{"time": 0, "motion": &text}]}),
            ] {
                if let Err(error) = path.to_string().parse::<FlightPath>() {
                    let said = error.to_string();
                    prop_assert!(!said.contains(char::is_control), "{:?}", said);
                }
            }
        }
    }
}
