//! The keys of the path of the camera.

use super::saved;
use lensbake_interactive::keys::Command;
use lensbake_interactive::session::Session;
use lensbake_program::output::OutputError;

/// Runs a command of the path of the camera, and returns a message.
///
/// # Errors
/// [`OutputError`] if the path cannot be saved.
pub fn obey(session: &mut Session, command: Command) -> Result<String, OutputError> {
    let recording = &mut session.recording;
    Ok(match command {
        Command::SetKeyframe => session.set_keyframe(),
        Command::TakeKeyframeBack => recording.take_back(),
        Command::PlayPath => recording.play_or_stop(),
        _ if recording.path().keyframes.is_empty() => {
            "there is no path to save: K sets a keyframe".to_owned()
        }
        _ => {
            let file = saved::path(recording.path())?;
            let file = file.display();
            format!("wrote {file}: viewer film {file} -o film.mp4")
        }
    })
}
