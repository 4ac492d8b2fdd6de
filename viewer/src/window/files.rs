//! Files that are dropped on the window: a table or a sky, told apart by content.

use super::app::Arrival;
use crate::sky::{self, SkySource};
use lensbake_tables::{Problem, container};
use std::path::PathBuf;
use winit::event_loop::EventLoopProxy;

/// Reads a dropped file on a thread of its own and sends what it is.
pub fn read(path: PathBuf, proxy: EventLoopProxy<Arrival>) {
    std::thread::spawn(move || {
        // The window may have closed meanwhile.
        let _ = proxy.send_event(open(path));
    });
}

fn open(path: PathBuf) -> Arrival {
    let error = match container::read(&path) {
        Ok(table) => return Arrival::Table(path, Box::new(table)),
        Err(error) => error,
    };
    match error.problem {
        Problem::Io(_)
        | Problem::NotATable
        | Problem::TooLarge { .. }
        | Problem::Missing(_)
        | Problem::Exr(_) => {
            let source = SkySource::Panorama(path);
            let sky = sky::load(&source).map(Box::new);
            Arrival::Sky(source, sky)
        }
        // A table, but a damaged one.
        _ => Arrival::Refused(error.to_string()),
    }
}
