//! The panel, the help and the messages, drawn by egui.

use super::controls::{PanelAction, controls};
use super::message::{self, Message};
use egui::{ClippedPrimitive, Context, TexturesDelta};
use egui_wgpu::{RendererOptions, ScreenDescriptor};
use lensbake_interactive::panel_info::PanelInfo;
use lensbake_interactive::settings::Settings;
use lensbake_interactive::stage::Overlay;
use lensbake_render::gpu::Gpu;
use std::time::Duration;
use wgpu::{CommandBuffer, CommandEncoder, RenderPass, TextureFormat};
use winit::event::WindowEvent;
use winit::window::Window;

/// The egui state of one window.
pub struct Panel {
    context: Context,
    state: egui_winit::State,
    renderer: egui_wgpu::Renderer,
    message: Option<Message>,
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

    /// Shows a message for a while. Returns whether the message differs from the one shown before.
    pub fn say(&mut self, text: impl Into<String>) -> bool {
        let message = Message::new(text.into());
        let said = self.message.replace(message.clone());
        said.is_none_or(|said| said.text() != message.text())
    }

    /// Passes an event to the panel; true if the panel consumes it.
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

    /// Lays out the panel in a frame of `size` pixels; the user may change the settings in it. Returns what to
    /// paint, the panel's action, and the time until the panel wants a repaint.
    pub fn lay_out(
        &mut self,
        window: &Window,
        size: [u32; 2],
        settings: &mut Settings,
        facts: &PanelInfo,
    ) -> (Paint<'_>, PanelAction, Duration) {
        let mut action = PanelAction::default();
        self.message.take_if(|message| message.left().is_none());
        let message_left = self.message.as_ref().and_then(Message::left);
        let input = self.state.take_egui_input(window);
        let output = self.context.run_ui(input, |ui| {
            let context = ui.ctx();
            action = controls(context, settings, facts);
            if let Some(message) = &self.message {
                message::show(context, message.text());
            }
        });
        // Without this, a slider that was used would keep the focus, and with it the arrow keys.
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
        (paint, action, again.unwrap_or(Duration::MAX))
    }
}

impl Paint<'_> {
    /// Uploads egui's new textures. This is needed even if the frame is not shown, because egui sends each only
    /// once.
    pub fn upload(&mut self, gpu: &Gpu) {
        let Gpu { device, queue, .. } = gpu;
        for (id, deltas) in &self.textures.set {
            for delta in deltas {
                self.renderer.update_texture(device, queue, *id, delta);
            }
        }
    }

    /// Frees textures that are no longer needed. Call this whether or not the frame was drawn.
    pub fn finish(&mut self) {
        for id in &self.textures.free {
            self.renderer.free_texture(id);
        }
        self.textures.clear();
    }
}

impl Overlay for Paint<'_> {
    fn prepare(&mut self, gpu: &Gpu, encoder: &mut CommandEncoder) -> Vec<CommandBuffer> {
        let Gpu { device, queue, .. } = gpu;
        let (primitives, screen) = (&self.primitives, &self.screen);
        self.renderer
            .update_buffers(device, queue, encoder, primitives, screen)
    }

    fn draw(&self, pass: &mut RenderPass<'static>) {
        self.renderer.render(pass, &self.primitives, &self.screen);
    }
}
