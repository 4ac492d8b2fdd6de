//! The event loop of the window.

use super::coming::Coming;
use super::error::WindowError;
use super::event::AppEvent;
use super::open_window::{OpenWindow, Start};
use lensbake_film::FlightPath;
use lensbake_interactive::settings::Settings;
use lensbake_interactive::state::{NamedTable, Refusal, State};
use lensbake_render::camera::{Camera, View};
use lensbake_render::disc::Disc;
use lensbake_render::gpu::{Gpu, Pass};
use lensbake_render::shift::Shift;
use lensbake_render::sky::{self, SkySource};
use lensbake_render::stars::StarField;
use lensbake_tables::Table;
use winit::application::ApplicationHandler;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::WindowId;

/// Initial state of the window.
#[derive(Debug)]
pub struct Options {
    /// The view; its size is that of the window in logical pixels.
    pub view: View,
    /// Step of the direct integrator, rad.
    pub step: f64,
    /// What of the frequency shift of the sky is shown.
    pub shift: Shift,
    /// Source of the sky.
    pub sky: SkySource,
    /// The stars.
    pub stars: Coming<StarField>,
    /// Whether the stars are drawn in front of every sky, not only of the sky `stars`.
    pub stars_everywhere: bool,
    /// The disc around the hole, if there is one.
    pub disc: Option<Disc>,
    /// A path of the camera, which plays at once.
    pub path: Option<FlightPath>,
    /// The bending table.
    pub table: Table,
    /// Name of the table.
    pub table_name: String,
    /// Whether the window fills the screen.
    pub fullscreen: bool,
    /// The kind of passes that draw the picture; `None` for the device's default.
    pub pass: Option<Pass>,
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// [`WindowError`] if the window cannot be opened, its contents cannot be drawn, or the GPU fails.
pub fn run(options: Options) -> Result<(), WindowError> {
    Gpu::check_backend()?;
    Camera::new(&options.view).map_err(Refusal::View)?;
    let settings = Settings {
        shift: options.shift,
        disc_shown: options.disc.is_some(),
        disc: options.disc.unwrap_or_default(),
        ..Settings::new(options.view, options.step)
    };
    let table = NamedTable::new(options.table, options.table_name);
    let state = State::new(settings, table)?;
    // Created before the sky is made, which is not needed without a screen.
    let events = EventLoop::with_user_event()
        .build()
        .map_err(|e| WindowError::no_screen(&e))?;
    let source = options.sky.clone();
    let sky = match source.is_built_in() {
        // It cannot fail, so that the window may be opened meanwhile.
        true => Coming::soon(move || sky::load(&source)),
        false => Coming::Here(Ok(sky::load(&source)?)),
    };
    let mut app = App {
        proxy: events.create_proxy(),
        start: Some(Start {
            state,
            size: [options.view.width, options.view.height],
            fullscreen: options.fullscreen,
            pass: options.pass,
            sky,
            source: options.sky,
            stars: options.stars,
            stars_everywhere: options.stars_everywhere,
            path: options.path,
        }),
        open: None,
        error: None,
    };
    events
        .run_app(&mut app)
        .map_err(|e| WindowError::WindowSystem(e.to_string()))?;
    app.error.map_or(Ok(()), Err)
}

struct App {
    proxy: EventLoopProxy<AppEvent>,
    start: Option<Start>,
    open: Option<OpenWindow>,
    error: Option<WindowError>,
}

impl ApplicationHandler<AppEvent> for App {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        let Some(start) = self.start.take() else {
            return;
        };
        match OpenWindow::new(events, start, self.proxy.clone()) {
            Ok(open) => self.open = Some(open),
            Err(error) => self.end(events, error),
        }
    }

    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(open) = &mut self.open else {
            return;
        };
        if let Err(error) = open.event(events, event) {
            self.end(events, error);
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, app_event: AppEvent) {
        if let Some(open) = &mut self.open {
            open.app_event(app_event);
        }
    }

    fn new_events(&mut self, _: &ActiveEventLoop, cause: StartCause) {
        if let (Some(open), StartCause::ResumeTimeReached { .. }) = (&self.open, cause) {
            open.redraw();
        }
    }

    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        let next = self.open.as_ref().and_then(OpenWindow::next_frame);
        events.set_control_flow(next.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
    }
}

impl App {
    fn end(&mut self, events: &ActiveEventLoop, error: WindowError) {
        self.error.get_or_insert(error);
        events.exit();
    }
}
