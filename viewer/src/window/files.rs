//! Files dropped on the window: a table or a sky, distinguished by content, or a path of the camera (.json).

use super::event::AppEvent;
use lensbake_render::sky::{self, SkySource};
use lensbake_tables::container;
use std::path::PathBuf;
use winit::event_loop::EventLoopProxy;

/// Reads a dropped file on its own thread and sends the result to the event loop.
pub fn read(path: PathBuf, proxy: EventLoopProxy<AppEvent>) {
    std::thread::spawn(move || {
        // The window may have closed meanwhile.
        let _ = proxy.send_event(open(path));
    });
}

fn open(path: PathBuf) -> AppEvent {
    if path
        .extension()
        .is_some_and(|ending| ending.eq_ignore_ascii_case("json"))
    {
        return match lensbake_film::read(&path) {
            Ok((flight_path, _)) => AppEvent::Path(path, flight_path),
            Err(error) => AppEvent::Refused(error.to_string()),
        };
    }
    let error = match container::read(&path) {
        Ok(table) => return AppEvent::Table(path, Box::new(table)),
        Err(error) => error,
    };
    if error.problem.is_no_table() {
        let source = SkySource::Panorama(path);
        let sky = sky::load(&source).map(Box::new);
        return AppEvent::Sky(source, sky);
    }
    // A table, but a damaged one.
    AppEvent::Refused(error.to_string())
}
