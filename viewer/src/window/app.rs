//! The window system's loop.

use super::WindowError;
use super::running::Running;
use super::settings::Settings;
use super::state::{NamedTable, Refusal, State};
use crate::camera::{Camera, View};
use crate::gpu::Gpu;
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

/// What the window starts with, after it was checked and the sky was read.
pub(super) struct Start {
    /// Settings and table.
    pub state: State,
    /// The window's size, in points.
    pub size: [u32; 2],
    /// Whether the window fills the screen.
    pub fullscreen: bool,
    /// The sky.
    pub sky: Sky,
    /// Where it comes from.
    pub source: SkySource,
    /// The stars.
    pub stars: StarField,
    /// Whether they stand before every sky.
    pub stars_everywhere: bool,
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
    Gpu::check_backend()?;
    Camera::new(&options.view).map_err(Refusal::View)?;
    let settings = Settings::new(options.view, options.step);
    let table = NamedTable::new(options.table, options.table_name);
    let state = State::new(settings, table)?;
    let sky = crate::sky::load(&options.sky)?;
    let events = EventLoop::with_user_event()
        .build()
        .map_err(|e| WindowError::no_screen(&e))?;
    let mut app = App {
        proxy: events.create_proxy(),
        start: Some(Start {
            state,
            size: [options.view.width, options.view.height],
            fullscreen: options.fullscreen,
            sky,
            source: options.sky,
            stars: options.stars,
            stars_everywhere: options.stars_everywhere,
        }),
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
    start: Option<Start>,
    running: Option<Running>,
    error: Option<WindowError>,
}

impl ApplicationHandler<Arrival> for App {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        let Some(start) = self.start.take() else {
            return;
        };
        match Running::new(events, start, self.proxy.clone()) {
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

    fn user_event(&mut self, _: &ActiveEventLoop, arrival: Arrival) {
        if let Some(running) = &mut self.running {
            running.arrival(arrival);
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
