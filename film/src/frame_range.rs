//! A range of frames, as a user names it.

use std::str::FromStr;
use thiserror::Error;

/// The frames `A..B:STEP`: from A to before B, every STEP-th.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FrameRange {
    first: u32,
    /// The first frame that is not in it; `None` for the end of the film.
    end: Option<u32>,
    step: u32,
}

/// Why a range names no frames of a film.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum FrameRangeError {
    /// The text is not a range.
    #[error("must be A..B or A..B:STEP, from frame A to before frame B; A or B may be left out")]
    Malformed,
    /// The range ends where it begins, or before.
    #[error("{first}..{end} has no frames")]
    Empty {
        /// The first frame.
        first: u32,
        /// The end.
        end: u32,
    },
    /// The range reaches beyond the film.
    #[error("frame {frame} is beyond the film, whose frames are 0..{frames}")]
    Beyond {
        /// The last frame of the range.
        frame: u32,
        /// Number of frames of the film.
        frames: u32,
    },
}

impl FrameRange {
    /// All frames.
    pub const ALL: FrameRange = FrameRange {
        first: 0,
        end: None,
        step: 1,
    };

    /// Its frames in a film of `frames`.
    ///
    /// # Errors
    /// [`FrameRangeError::Beyond`] if the film does not have them all.
    pub fn within(self, frames: u32) -> Result<impl Iterator<Item = u32> + Clone, FrameRangeError> {
        let end = self.end.unwrap_or(frames);
        let last = end.saturating_sub(1).max(self.first);
        if last >= frames {
            return Err(FrameRangeError::Beyond {
                frame: last,
                frames,
            });
        }
        Ok((self.first..end).step_by(self.step as usize))
    }
}

impl FromStr for FrameRange {
    type Err = FrameRangeError;

    fn from_str(text: &str) -> Result<Self, FrameRangeError> {
        let number = |text: &str| {
            let digits = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
            let number = text.parse::<u32>().ok().filter(|_| digits);
            number.ok_or(FrameRangeError::Malformed)
        };
        let (range, step) = text.split_once(':').unwrap_or((text, "1"));
        let (first, end) = range.split_once("..").ok_or(FrameRangeError::Malformed)?;
        let first = if first.is_empty() { 0 } else { number(first)? };
        let end = if end.is_empty() {
            None
        } else {
            Some(number(end)?)
        };
        let step = number(step)?;
        if step == 0 {
            return Err(FrameRangeError::Malformed);
        }
        match end {
            Some(end) if end <= first => Err(FrameRangeError::Empty { first, end }),
            _ => Ok(FrameRange { first, end, step }),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frames(text: &str, of: u32) -> Result<Vec<u32>, FrameRangeError> {
        Ok(text.parse::<FrameRange>()?.within(of)?.collect())
    }

    #[test]
    fn ranges_name_frames() {
        assert_eq!(frames("0..3", 5), Ok(vec![0, 1, 2]));
        assert_eq!(frames("1..5:2", 5), Ok(vec![1, 3]));
        assert_eq!(frames("3..", 5), Ok(vec![3, 4]));
        assert_eq!(frames("..2", 5), Ok(vec![0, 1]));
        assert_eq!(frames("1..:3", 5), Ok(vec![1, 4]));
        assert_eq!(
            FrameRange::ALL.within(3).unwrap().collect::<Vec<_>>(),
            [0, 1, 2]
        );
    }

    #[test]
    fn other_texts_and_other_frames_are_refused() {
        for text in [
            "",
            "3",
            "1-5",
            "a..b",
            "1..5:0",
            "1..5:",
            "-1..5",
            "+1..5",
            "1...5",
            "1..5..6",
            "1..9999999999",
        ] {
            assert_eq!(frames(text, 5), Err(FrameRangeError::Malformed), "{text}");
        }
        assert_eq!(
            frames("3..3", 5),
            Err(FrameRangeError::Empty { first: 3, end: 3 })
        );
        let beyond = |frame| Err(FrameRangeError::Beyond { frame, frames: 5 });
        assert_eq!(frames("0..6", 5), beyond(5));
        assert_eq!(frames("5..", 5), beyond(5));
        assert_eq!(frames("7..", 5), beyond(7));
    }
}
