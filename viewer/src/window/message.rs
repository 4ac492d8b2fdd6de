//! What the window says for a while, at its lower edge.

use egui::{
    Align2, Area, Context, FontSelection, Frame, Id, Label, Order, RichText, ScrollArea,
    TextWrapMode, vec2,
};
use std::time::{Duration, Instant};

/// What egui knows the message by.
pub(super) const ID: &str = "message";
/// How long a message stays at the least.
const LEAST_TIME: Duration = Duration::from_secs(8);
/// How long at the most.
const MOST_TIME: Duration = Duration::from_secs(20);
/// How long it takes to read a character.
const READING_TIME: Duration = Duration::from_millis(60);
/// Points between a message and the edges of the window.
const MARGIN: f32 = 16.0;
/// Points across the lines of a message at the most: longer ones are hard to read.
const LINE: f32 = 720.0;

/// A message, and since when it is there.
#[derive(Debug, Clone)]
pub struct Message {
    text: String,
    since: Instant,
}

impl Message {
    /// A message from now on.
    pub fn new(text: String) -> Self {
        Message {
            text,
            since: Instant::now(),
        }
    }

    /// What it says.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// How long it is still to stay; nothing when its time is over.
    pub fn left(&self) -> Option<Duration> {
        let reading = READING_TIME * self.text.chars().count() as u32;
        let stays = reading.clamp(LEAST_TIME, MOST_TIME);
        stays.checked_sub(self.since.elapsed())
    }
}

/// Shows a message above all else: in as many lines as it takes, and where the window is too low for them,
/// with a scroll bar.
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
