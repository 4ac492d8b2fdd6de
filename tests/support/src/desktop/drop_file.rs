//! Dropping files on a window.

use super::WindowedProgram;
use std::path::Path;
use x11rb::connection::Connection;
use x11rb::protocol::Event;
use x11rb::protocol::xproto::{
    Atom, ClientMessageEvent, ConnectionExt, EventMask, PropMode, SELECTION_NOTIFY_EVENT,
    SelectionNotifyEvent, SelectionRequestEvent,
};
use x11rb::wrapper::ConnectionExt as _;

impl WindowedProgram {
    fn atom(&self, name: &str) -> Atom {
        let reply = self.x.intern_atom(false, name.as_bytes()).unwrap();
        reply.reply().unwrap().atom
    }

    /// Drops a file on the window as a file manager does: as the source in the XDND protocol, version 5.
    ///
    /// # Panics
    /// If the window does not answer.
    pub fn drop_file(&mut self, path: &Path) {
        let path = path.canonicalize().unwrap();
        let uri = format!("file://{}\r\n", path.display());
        let selection = self.atom("XdndSelection");
        self.x
            .set_selection_owner(self.source, selection, x11rb::CURRENT_TIME)
            .unwrap();
        let here = self.x.translate_coordinates(self.window, self.root, 5, 5);
        let here = here.unwrap().reply().unwrap();
        let place = (u32::from(here.dst_x as u16) << 16) | u32::from(here.dst_y as u16);
        let copy = self.atom("XdndActionCopy");
        let list = self.atom("text/uri-list");
        self.send("XdndEnter", [self.source, 5 << 24, list, 0, 0]);
        self.send("XdndPosition", [self.source, 0, place, 0, copy]);
        self.serve(&uri, "XdndStatus");
        self.send("XdndDrop", [self.source, 0, 0, 0, 0]);
        self.serve(&uri, "XdndFinished");
    }

    fn send(&self, message: &str, data: [u32; 5]) {
        let event = ClientMessageEvent::new(32, self.window, self.atom(message), data);
        self.x
            .send_event(false, self.window, EventMask::NO_EVENT, event)
            .unwrap();
        self.x.flush().unwrap();
    }

    /// Answers requests for the list of files until the window sends `message`.
    fn serve(&mut self, uri: &str, message: &str) {
        let wanted = self.atom(message);
        self.until(message, |program| {
            while let Some(event) = program.x.poll_for_event().unwrap() {
                match event {
                    Event::SelectionRequest(request) => program.hand_out(uri, &request),
                    Event::ClientMessage(m) if m.type_ == wanted => return Some(()),
                    _ => (),
                }
            }
            None
        });
    }

    fn hand_out(&self, uri: &str, request: &SelectionRequestEvent) {
        self.x
            .change_property8(
                PropMode::REPLACE,
                request.requestor,
                request.property,
                request.target,
                uri.as_bytes(),
            )
            .unwrap();
        let notify = SelectionNotifyEvent {
            response_type: SELECTION_NOTIFY_EVENT,
            sequence: 0,
            time: request.time,
            requestor: request.requestor,
            selection: request.selection,
            target: request.target,
            property: request.property,
        };
        self.x
            .send_event(false, request.requestor, EventMask::NO_EVENT, notify)
            .unwrap();
        self.x.flush().unwrap();
    }
}
