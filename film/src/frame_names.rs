//! The files of the frames, named by a pattern.

use std::path::{Path, PathBuf};
use thiserror::Error;

/// A pattern of file names such as `frames/%05d.png`, as in ffmpeg: `%d` is the number of the frame, `%05d` the number
/// with at least five digits, `%%` a percent sign.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FrameNames {
    folder: PathBuf,
    before: String,
    after: String,
    digits: usize,
}

/// Why a path is not a pattern of file names.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum FrameNamesError {
    /// The name holds no `%d`.
    #[error("{}: the name of a frame needs its number, such as %05d.png", _0.display())]
    NoNumber(PathBuf),
    /// The name holds two numbers.
    #[error("{}: the name of a frame has its number once", _0.display())]
    TwoNumbers(PathBuf),
    /// A percent sign is followed by something else.
    #[error("{}: after % may follow d, 0 and a digit and d (%05d), or a second %", _0.display())]
    Percent(PathBuf),
    /// The name is not UTF-8.
    #[error("{}: the name of a frame must be UTF-8", _0.display())]
    NotText(PathBuf),
}

impl FrameNames {
    /// The pattern `path`. The number must be in the file's name; its folder is taken as it is.
    ///
    /// # Errors
    /// [`FrameNamesError`] names the path.
    pub fn new(path: &Path) -> Result<Self, FrameNamesError> {
        let of = |error: fn(PathBuf) -> FrameNamesError| error(path.to_owned());
        let name = path
            .file_name()
            .ok_or_else(|| of(FrameNamesError::NoNumber))?;
        let name = name.to_str().ok_or_else(|| of(FrameNamesError::NotText))?;
        let mut texts = vec![String::new()];
        let mut digits = 0;
        let mut rest = name;
        while let Some((text, more)) = rest.split_once('%') {
            let last = texts
                .last_mut()
                .ok_or_else(|| of(FrameNamesError::NoNumber))?;
            last.push_str(text);
            if let Some(more) = more.strip_prefix('%') {
                last.push('%');
                rest = more;
            } else {
                (digits, rest) = number(more).ok_or_else(|| of(FrameNamesError::Percent))?;
                texts.push(String::new());
            }
        }
        match &mut texts[..] {
            [before, after] => {
                after.push_str(rest);
                Ok(FrameNames {
                    folder: path.parent().unwrap_or(Path::new("")).to_owned(),
                    before: std::mem::take(before),
                    after: std::mem::take(after),
                    digits,
                })
            }
            [_] => Err(of(FrameNamesError::NoNumber)),
            _ => Err(of(FrameNamesError::TwoNumbers)),
        }
    }

    /// The file of `frame`.
    pub fn path(&self, frame: u32) -> PathBuf {
        let number = format!("{frame:0digits$}", digits = self.digits);
        self.folder
            .join(format!("{}{number}{}", self.before, self.after))
    }
}

/// The least number of digits that the text after a percent sign asks for, and what follows it.
fn number(text: &str) -> Option<(usize, &str)> {
    let (width, rest) = text.split_once('d')?;
    match width.as_bytes() {
        [] => Some((1, rest)),
        [b'0', digit @ b'1'..=b'9'] => Some((usize::from(digit - b'0'), rest)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(pattern: &str) -> Result<FrameNames, FrameNamesError> {
        FrameNames::new(Path::new(pattern))
    }

    #[test]
    fn the_number_is_filled_in() {
        for (pattern, frame, name) in [
            ("frames/%05d.png", 7, "frames/00007.png"),
            ("%d.exr", 123, "123.exr"),
            ("/a/shot-%03d-x.png", 12345, "/a/shot-12345-x.png"),
            ("50%% %02d.png", 3, "50% 03.png"),
            ("%05d/%d.png", 3, "%05d/3.png"),
        ] {
            assert_eq!(
                names(pattern).unwrap().path(frame),
                Path::new(name),
                "{pattern}"
            );
        }
    }

    #[test]
    fn what_names_no_frame_is_refused() {
        let of = |pattern: &str| names(pattern).unwrap_err();
        assert_eq!(
            of("frames/a.png"),
            FrameNamesError::NoNumber("frames/a.png".into())
        );
        assert_eq!(of("%d/a.png"), FrameNamesError::NoNumber("%d/a.png".into()));
        assert_eq!(of(".."), FrameNamesError::NoNumber("..".into()));
        assert_eq!(
            of("%d%d.png"),
            FrameNamesError::TwoNumbers("%d%d.png".into())
        );
        for pattern in [
            "%5d.png",
            "%s.png",
            "100%",
            "%00d.png",
            "%010d.png",
            "%-3d.png",
        ] {
            assert_eq!(of(pattern), FrameNamesError::Percent(pattern.into()));
        }
    }
}
