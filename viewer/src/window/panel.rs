//! The panel, the help and the messages, drawn by egui.

use super::controls::{Facts, Wish, controls};
use super::message::{self, Message};
use super::settings::Settings;
use crate::gpu::Gpu;
use egui::{ClippedPrimitive, Context, TexturesDelta};
use egui_wgpu::{RendererOptions, ScreenDescriptor};
use std::time::Duration;
use wgpu::{CommandBuffer, CommandEncoder, RenderPass, TextureFormat};
use winit::event::WindowEvent;
use winit::window::Window;

/// egui for one window.
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

    /// Lays the panel out in a frame of `size` pixels, in which the user may change the settings. Returns
    /// what to paint, what else is wanted, and when the panel wants to be painted next.
    pub fn lay_out(
        &mut self,
        window: &Window,
        size: [u32; 2],
        settings: &mut Settings,
        facts: &Facts,
    ) -> (Paint<'_>, Wish, Duration) {
        let mut wish = Wish::default();
        self.message.take_if(|message| message.left().is_none());
        let message_left = self.message.as_ref().and_then(Message::left);
        let input = self.state.take_egui_input(window);
        let output = self.context.run_ui(input, |ui| {
            let context = ui.ctx();
            wish = controls(context, settings, facts);
            if let Some(message) = &self.message {
                message::show(context, message.text());
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
