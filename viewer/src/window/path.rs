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
    if let Some(said) = session.obey_path(command) {
        return Ok(said);
    }
    let path = session.recording.path();
    if path.keyframes.is_empty() {
        return Ok("there is no path to save: K sets a keyframe".to_owned());
    }
    let file = saved::path(path)?;
    let file = file.display();
    Ok(format!("wrote {file}: viewer film {file} -o film.mp4"))
}
