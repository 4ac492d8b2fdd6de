//! `bake export`: writes the lookup as a text in another language, and its table.

use super::CommandError;
use crate::cli::{ExportArgs, Frame};
use ::bake::export::{DataFormat, ExportError, Mode, Precision, Request, export};
use lensbake_core::Observer;
use lensbake_program::output::Output;
use lensbake_program::{Outcome, message};
use std::path::{Path, PathBuf};

pub fn run(args: &ExportArgs) -> Result<Outcome, CommandError> {
    let path = match &args.output {
        Some(path) => path.clone(),
        None => PathBuf::from(format!("{}.{}", args.function, args.to.extension())),
    };
    let output = Output::new(&path)?;
    let precision = args.precision.unwrap_or(match args.mode {
        Mode::Row => Precision::F32,
        Mode::Simple => Precision::F16,
    });
    let mut request = Request {
        language: args.to,
        observer: observer(args)?,
        mode: args.mode,
        texels: args.texels,
        precision,
        function: args.function.clone(),
        data: None,
        flip: args.flip,
    };
    let mut data_output = None;
    if request.has_data_file()? {
        let path = match &args.data {
            Some(path) => path.clone(),
            None => beside(&path, &request),
        };
        let format = DataFormat::of(&path, &request)?;
        let data = Output::binary(&path)?;
        output.is_apart(&data, ["--output", "--data"])?;
        request.data = Some((path, format));
        data_output = Some(data);
    }
    let for_file = [("--data", args.data.is_some()), ("--flip", args.flip)];
    if let Some((option, _)) = for_file.iter().find(|(_, given)| *given)
        && data_output.is_none()
    {
        return Err(ExportError::NoDataFile {
            option,
            language: args.to,
        }
        .into());
    }
    let exported = export(&request)?;
    if let (Some(output), Some(bytes)) = (&data_output, &exported.data) {
        output.write(bytes)?;
        message!("wrote {}", output.name());
    }
    output.write(exported.text.as_bytes())?;
    message!("wrote {}", output.name());
    message!(
        "largest error of the numbers {:.1e} rad, {:.1e} px in a picture 1920 wide and 90 degrees across",
        exported.errors.radians,
        exported.errors.pixels
    );
    Ok(Outcome::Done)
}

/// The observer of `args`.
fn observer(args: &ExportArgs) -> Result<Option<Observer>, CommandError> {
    /// Smallest radius of the atlas.
    const R_MIN: f64 = 0.01;
    let Some(radius) = args.observer else {
        return Ok(None);
    };
    let observer = match args.motion {
        Frame::Rest if radius > 1.0 => Observer::at(radius).ok(),
        Frame::Fall if radius >= R_MIN => Observer::falling(radius).ok(),
        _ => None,
    };
    let wanted = match args.motion {
        Frame::Rest => {
            "must be above 1 for an observer at rest; at the horizon and below, add --motion fall"
        }
        Frame::Fall => "must be 0.01 or more",
    };
    observer
        .map(Some)
        .ok_or(CommandError::ExportRadius { radius, wanted })
}

/// The path of the table's file beside a text at `path`.
fn beside(path: &Path, request: &Request) -> PathBuf {
    let extension = DataFormat::that_hold(request)[0].extension();
    match path == Path::new("-") {
        true => PathBuf::from(format!("{}.{extension}", request.function)),
        false => path.with_extension(extension),
    }
}
