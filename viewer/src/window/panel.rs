//! The panel, the help and the messages, drawn by egui.

use super::keys::{BINDINGS, MOUSE};
use super::motion::{FIELDS_OF_VIEW, MAX_WINDOW_RADIUS, MIN_RADIUS, ORBIT_SPEEDS};
use super::resolution::Resolution;
use super::settings::{Comparison, Settings};
use crate::gpu::Gpu;
use crate::scene::Sampling;
use egui::{
    Align2, ClippedPrimitive, ComboBox, Context, Grid, RichText, Slider, TexturesDelta, Ui,
};
use egui_wgpu::{RendererOptions, ScreenDescriptor};
use std::time::{Duration, Instant};
use wgpu::{CommandBuffer, CommandEncoder, RenderPass, TextureFormat};
use winit::event::WindowEvent;
use winit::window::Window;

/// How long a message stays.
const MESSAGE_TIME: Duration = Duration::from_secs(8);

/// What the panel shows besides the settings.
#[derive(Debug, Clone)]
pub struct Facts {
    /// Names of the skies, and which is shown.
    pub skies: (Vec<String>, usize),
    /// From frame to frame, while something moves.
    pub interval: Option<Duration>,
    /// The GPU's time of the picture.
    pub picture_time: Option<Duration>,
    /// The GPU's time of the whole frame, window and panel included.
    pub frame_time: Option<Duration>,
    /// Pixels drawn, `[width, height]`.
    pub picture: [u32; 2],
    /// The table in use.
    pub table: String,
    /// Its largest measured error, rad.
    pub table_error: f64,
    /// The adapter.
    pub adapter: String,
}

/// What the panel wants that settings do not say.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Wish {
    /// Another sky.
    pub sky: Option<usize>,
    /// Everything as at the start.
    pub reset: bool,
}

/// egui for one window.
pub struct Panel {
    context: Context,
    state: egui_winit::State,
    renderer: egui_wgpu::Renderer,
    message: Option<(String, Instant)>,
}

/// What egui wants drawn in a frame.
pub struct Paint<'a> {
    renderer: &'a mut egui_wgpu::Renderer,
    primitives: Vec<ClippedPrimitive>,
    textures: TexturesDelta,
    screen: ScreenDescriptor,
}

impl Panel {
    /// A panel for `window`, drawn by `gpu` to surfaces of `format`.
    pub fn new(window: &Window, gpu: &Gpu, format: TextureFormat) -> Self {
        let context = Context::default();
        context.set_visuals(egui::Visuals::dark());
        let most = gpu.device.limits().max_texture_dimension_2d as usize;
        let state = egui_winit::State::new(
            context.clone(),
            egui::ViewportId::ROOT,
            window,
            Some(window.scale_factor() as f32),
            None,
            Some(most),
        );
        Panel {
            context,
            state,
            renderer: egui_wgpu::Renderer::new(&gpu.device, format, RendererOptions::default()),
            message: None,
        }
    }

    /// Says something for a while.
    pub fn say(&mut self, message: impl Into<String>) {
        self.message = Some((message.into(), Instant::now()));
    }

    /// Tells the panel what happened; true if that was for the panel alone.
    pub fn takes(&mut self, window: &Window, event: &WindowEvent) -> bool {
        if matches!(event, WindowEvent::KeyboardInput { .. }) && !self.context.text_edit_focused() {
            return false;
        }
        let response = self.state.on_window_event(window, event);
        if response.repaint {
            window.request_redraw();
        }
        response.consumed
    }

    /// Lays the panel out in a frame of `size` pixels, in which the user may change the settings. Returns what to paint, what else
    /// is wanted, and when the panel wants to be painted next.
    pub fn lay_out(
        &mut self,
        window: &Window,
        size: [u32; 2],
        settings: &mut Settings,
        facts: &Facts,
    ) -> (Paint<'_>, Wish, Duration) {
        let mut wish = Wish::default();
        let left = |(_, since): &(String, Instant)| MESSAGE_TIME.checked_sub(since.elapsed());
        let message_left = self.message.as_ref().and_then(left);
        if message_left.is_none() {
            self.message = None;
        }
        let message = self.message.as_ref().map(|(text, _)| text.as_str());
        let input = self.state.take_egui_input(window);
        let output = self.context.run_ui(input, |ui| {
            let context = ui.ctx();
            if settings.panel {
                wish = panel(context, settings, facts);
            }
            if settings.help {
                help(context, &mut settings.help);
            }
            if let Some(message) = message {
                say(context, message);
            }
        });
        // A slider that was used must not keep the arrow keys.
        if !self.context.text_edit_focused() && !self.context.egui_is_using_pointer() {
            self.context.memory_mut(|memory| {
                if let Some(id) = memory.focused() {
                    memory.surrender_focus(id);
                }
            });
        }
        self.state
            .handle_platform_output(window, output.platform_output);
        let scale = output.pixels_per_point;
        let paint = Paint {
            renderer: &mut self.renderer,
            primitives: self.context.tessellate(output.shapes, scale),
            textures: output.textures_delta,
            screen: ScreenDescriptor {
                size_in_pixels: size,
                pixels_per_point: scale,
            },
        };
        let again = output.viewport_output.values().map(|v| v.repaint_delay);
        let again = again.chain(message_left).min();
        (paint, wish, again.unwrap_or(Duration::MAX))
    }
}

impl Paint<'_> {
    /// Sends new textures to the device: needed even if the frame is not shown, for they come once.
    pub fn upload(&mut self, gpu: &Gpu) {
        let Gpu { device, queue, .. } = gpu;
        for (id, deltas) in &self.textures.set {
            for delta in deltas {
                self.renderer.update_texture(device, queue, *id, delta);
            }
        }
    }

    /// Sends what is drawn to the device.
    pub fn prepare(&mut self, gpu: &Gpu, encoder: &mut CommandEncoder) -> Vec<CommandBuffer> {
        let Gpu { device, queue, .. } = gpu;
        let (primitives, screen) = (&self.primitives, &self.screen);
        self.renderer
            .update_buffers(device, queue, encoder, primitives, screen)
    }

    /// Draws.
    pub fn draw(&self, pass: &mut RenderPass<'static>) {
        self.renderer.render(pass, &self.primitives, &self.screen);
    }

    /// Lets go of what is no longer needed, after the frame was drawn or not.
    pub fn finish(&mut self) {
        for id in &self.textures.free {
            self.renderer.free_texture(id);
        }
        self.textures.clear();
    }
}

fn panel(context: &Context, settings: &mut Settings, facts: &Facts) -> Wish {
    let mut wish = Wish::default();
    egui::Window::new("lensbake")
        .anchor(Align2::LEFT_TOP, [12.0, 12.0])
        .resizable(false)
        .show(context, |ui| {
            Grid::new("settings").num_columns(2).show(ui, |ui| {
                wish.sky = controls(ui, settings, facts);
            });
            ui.separator();
            costs(ui, facts);
            ui.separator();
            ui.horizontal(|ui| {
                wish.reset = ui.button("Reset").clicked();
                ui.toggle_value(&mut settings.help, "Keys (H)");
                ui.weak("Tab hides this");
            });
        });
    wish
}

/// The settings; returns another sky if one was chosen.
fn controls(ui: &mut Ui, settings: &mut Settings, facts: &Facts) -> Option<usize> {
    let view = &mut settings.view;
    ui.label("radius");
    let radii = MIN_RADIUS..=MAX_WINDOW_RADIUS;
    ui.add(
        Slider::new(&mut view.radius, radii)
            .logarithmic(true)
            .suffix(" r_s"),
    );
    ui.end_row();

    ui.label("field of view");
    ui.add(Slider::new(&mut view.fov_deg, FIELDS_OF_VIEW).suffix("°"));
    ui.end_row();

    ui.label("orbit speed");
    ui.horizontal(|ui| {
        for (i, speed) in ORBIT_SPEEDS.iter().enumerate() {
            ui.selectable_value(&mut settings.orbit_speed, i, format!("{speed}×"));
        }
    });
    ui.end_row();

    ui.label("sky");
    let (names, shown) = &facts.skies;
    let mut chosen = *shown;
    ComboBox::from_id_salt("sky").show_index(ui, &mut chosen, names.len(), |i| names[i].as_str());
    ui.end_row();

    ui.label("exposure");
    ui.add(Slider::new(&mut settings.exposure, Settings::EXPOSURES).suffix(" EV"));
    ui.end_row();

    ui.label("deflection");
    ui.checkbox(&mut settings.deflection, "");
    ui.end_row();

    ui.label("method");
    ui.add_enabled_ui(settings.deflection, |ui| {
        ComboBox::from_id_salt("method")
            .selected_text(settings.comparison.name())
            .show_ui(ui, |ui| {
                for one in Comparison::ALL {
                    ui.selectable_value(&mut settings.comparison, one, one.name());
                }
            });
    });
    ui.end_row();

    if settings.deflection && settings.comparison == Comparison::Difference {
        ui.label("amplified");
        ui.add(
            Slider::new(&mut settings.gain, Settings::GAINS)
                .logarithmic(true)
                .suffix("×"),
        );
        ui.end_row();
    }

    ui.label("a pixel is");
    ui.horizontal(|ui| {
        let mut choice = |sampling, name| {
            ui.selectable_value(&mut settings.sampling, sampling, name);
        };
        choice(Sampling::Filtered, "its mean");
        choice(Sampling::Single, "one ray");
    });
    ui.end_row();

    ui.label("resolution");
    ComboBox::from_id_salt("resolution")
        .selected_text(settings.resolution.name())
        .show_ui(ui, |ui| {
            for one in Resolution::ALL {
                ui.selectable_value(&mut settings.resolution, one, one.name());
            }
        });
    ui.end_row();

    if settings.resolution == Resolution::Auto {
        ui.label("frame time");
        ui.add(
            Slider::new(&mut settings.target_ms, 4.0..=200.0)
                .logarithmic(true)
                .suffix(" ms"),
        );
        ui.end_row();
    }
    (chosen != *shown).then_some(chosen)
}

/// What the picture costs, and how wrong it is.
fn costs(ui: &mut Ui, facts: &Facts) {
    let [width, height] = facts.picture;
    let rays = f64::from(width) * f64::from(height);
    let shown = |time: Option<Duration>, text: fn(f64) -> String, parts: f64| {
        time.map_or("–".into(), |time| text(time.as_secs_f64() / parts))
    };
    let ms = |s: f64| format!("{:.2} ms", 1e3 * s);
    let rows = [
        (
            "frames a second",
            shown(facts.interval, |s| format!("{:.1}", 1.0 / s), 1.0),
        ),
        ("frame on the GPU", shown(facts.frame_time, ms, 1.0)),
        ("picture", format!("{width} × {height}")),
        ("picture on the GPU", shown(facts.picture_time, ms, 1.0)),
        (
            "a ray (T_ray)",
            shown(facts.picture_time, |s| format!("{:.2} ns", 1e9 * s), rays),
        ),
        ("table", facts.table.clone()),
        ("its error", format!("≤ {:.1e} rad", facts.table_error)),
    ];
    ui.weak(RichText::new(&facts.adapter).small());
    Grid::new("costs").num_columns(2).show(ui, |ui| {
        for (what, value) in rows {
            ui.label(what);
            ui.label(RichText::new(value).monospace());
            ui.end_row();
        }
    });
}

fn help(context: &Context, open: &mut bool) {
    egui::Window::new("Keys and mouse")
        .anchor(Align2::CENTER_CENTER, [0.0, 0.0])
        .resizable(false)
        .collapsible(false)
        .open(open)
        .show(context, |ui| {
            Grid::new("keys")
                .num_columns(2)
                .striped(true)
                .show(ui, |ui| {
                    let keys = BINDINGS.iter().map(|b| (b.names, b.does));
                    for (names, does) in keys.chain(MOUSE.iter().copied()) {
                        ui.label(RichText::new(names).monospace().strong());
                        ui.label(does);
                        ui.end_row();
                    }
                });
        });
}

fn say(context: &Context, message: &str) {
    egui::Area::new(egui::Id::unique("message"))
        .anchor(Align2::CENTER_BOTTOM, [0.0, -16.0])
        .interactable(false)
        .show(context, |ui| {
            egui::Frame::popup(ui.style()).show(ui, |ui| {
                ui.set_max_width(0.8 * context.content_rect().width());
                ui.label(message);
            });
        });
}
