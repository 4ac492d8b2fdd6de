//! Messages that the window shows for a while at its lower edge.

use egui::{
    Align2, Area, Context, FontSelection, Frame, Id, Label, Order, RichText, ScrollArea,
    TextWrapMode, vec2,
};
use std::time::{Duration, Instant};

/// egui id of the message.
pub(super) const ID: &str = "message";
/// Shortest time for which a message is shown.
const MIN_TIME: Duration = Duration::from_secs(8);
/// Longest time for which a message is shown.
const MAX_TIME: Duration = Duration::from_secs(20);
/// Reading time per character.
const READING_TIME: Duration = Duration::from_millis(60);
/// Distance between a message and the edges of the window, points.
const MARGIN: f32 = 16.0;
/// Largest width of a message's lines, points: longer lines are hard to read.
const LINE: f32 = 720.0;

/// A message, and the time from which it is shown.
#[derive(Debug, Clone)]
pub struct Message {
    text: String,
    since: Instant,
}

impl Message {
    /// A message that is shown from now on.
    pub fn new(text: String) -> Self {
        Message {
            text,
            since: Instant::now(),
        }
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Remaining time for which it is shown; `None` if that is over.
    pub fn left(&self) -> Option<Duration> {
        let reading = READING_TIME * self.text.chars().count() as u32;
        let stays = reading.clamp(MIN_TIME, MAX_TIME);
        stays.checked_sub(self.since.elapsed())
    }
}

/// Shows a message above everything else, wrapped into lines, with a scroll bar if the window is too low for them.
pub fn show(context: &Context, text: &str) {
    let screen = context.content_rect().size() - 2.0 * vec2(MARGIN, MARGIN);
    let frame = Frame::popup(&context.global_style());
    let room = (screen - frame.total_margin().sum()).max(vec2(1.0, 1.0));
    let font = FontSelection::Default.resolve(&context.global_style());
    let width = room.x.min(LINE);
    let height = context.fonts_mut(|fonts| {
        let colour = egui::Color32::WHITE;
        fonts.layout(text.to_owned(), font, colour, width).size().y
    });
    let fits = height <= room.y;
    Area::new(Id::unique(ID))
        .order(Order::Foreground)
        .anchor(Align2::CENTER_BOTTOM, [0.0, -MARGIN])
        .interactable(!fits)
        .show(context, |ui| {
            frame.show(ui, |ui| {
                ui.set_max_width(width);
                let label = Label::new(RichText::new(text)).wrap_mode(TextWrapMode::Wrap);
                if fits {
                    ui.add(label);
                } else {
                    ScrollArea::vertical()
                        .max_height(room.y)
                        .show(ui, |ui| ui.add(label));
                }
            });
        });
}
