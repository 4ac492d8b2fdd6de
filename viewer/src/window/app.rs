//! The window system's loop.

use super::WindowError;
use super::running::Running;
use super::settings::Settings;
use crate::camera::View;
use crate::sky::{Sky, SkyError, SkySource};
use crate::stars::StarField;
use lensbake_tables::Table;
use std::path::PathBuf;
use winit::application::ApplicationHandler;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::WindowId;

/// What the window starts with.
#[derive(Debug)]
pub struct Options {
    /// The view; its size is the window's, in points.
    pub view: View,
    /// Step of the direct integrator, rad.
    pub step: f64,
    /// Where the sky comes from.
    pub sky: SkySource,
    /// The stars.
    pub stars: StarField,
    /// Whether they stand before every sky, and not before the sky `stars` alone.
    pub stars_everywhere: bool,
    /// The table.
    pub table: Table,
    /// What it is called.
    pub table_name: String,
    /// Whether the window fills the screen.
    pub fullscreen: bool,
}

/// What a thread brings.
#[derive(Debug)]
pub enum Arrival {
    /// A sky.
    Sky(SkySource, Result<Box<Sky>, SkyError>),
    /// A table that was dropped.
    Table(PathBuf, Box<Table>),
    /// A dropped file that is of no use, and why.
    Refused(String),
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// [`WindowError`] in one line.
pub fn run(options: Options) -> Result<(), WindowError> {
    let sky = crate::sky::load(&options.sky)?;
    let settings = Settings::new(options.view, options.step);
    super::row(&settings, &options.table, &options.table_name)?;
    let events = EventLoop::with_user_event()
        .build()
        .map_err(|e| WindowError::no_screen(&e))?;
    let mut app = App {
        proxy: events.create_proxy(),
        start: Some((options, sky)),
        running: None,
        error: None,
    };
    events
        .run_app(&mut app)
        .map_err(|e| WindowError::WindowSystem(e.to_string()))?;
    app.error.map_or(Ok(()), Err)
}

struct App {
    proxy: EventLoopProxy<Arrival>,
    start: Option<(Options, Sky)>,
    running: Option<Running>,
    error: Option<WindowError>,
}

impl ApplicationHandler<Arrival> for App {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        let Some((options, sky)) = self.start.take() else {
            return;
        };
        match Running::new(events, options, &sky, self.proxy.clone()) {
            Ok(running) => self.running = Some(running),
            Err(error) => self.end(events, error),
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(running) = &mut self.running else {
            return;
        };
        if let Err(error) = running.event(events, event) {
            self.end(events, error);
        }
    }

    fn user_event(&mut self, events: &ActiveEventLoop, arrival: Arrival) {
        let Some(running) = &mut self.running else {
            return;
        };
        if let Err(error) = running.arrival(arrival) {
            self.end(events, error);
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if let (Some(running), StartCause::ResumeTimeReached { .. }) = (&self.running, cause) {
            running.redraw();
        }
    }

    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        let next = self.running.as_ref().and_then(Running::next_frame);
        events.set_control_flow(next.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
    }
}

impl App {
    fn end(&mut self, events: &ActiveEventLoop, error: WindowError) {
        self.error.get_or_insert(error);
        events.exit();
    }
}
