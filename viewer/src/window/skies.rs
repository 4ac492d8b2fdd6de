//! The skies to choose from: the built-in ones and those that the user drops. A thread loads a sky when it is
//! first selected, so that the window does not freeze; then the sky stays on the GPU.

use super::event::AppEvent;
use lensbake_render::gpu::SkyOnDevice;
use lensbake_render::sky::{self, SkySource};
use winit::event_loop::EventLoopProxy;

/// A sky in the list.
#[derive(Debug)]
struct Choice {
    source: SkySource,
    on_device: Option<SkyOnDevice>,
    asked_for: bool,
}

/// All skies, of which one is selected.
#[derive(Debug)]
pub struct Skies {
    choices: Vec<Choice>,
    shown: usize,
    proxy: EventLoopProxy<AppEvent>,
}

impl Skies {
    /// The built-in skies, and `first` if it is not one of them. `sky` is `first` on the device.
    pub fn new(first: SkySource, sky: SkyOnDevice, proxy: EventLoopProxy<AppEvent>) -> Self {
        let built_in = [
            SkySource::Nebula,
            SkySource::Starmap,
            SkySource::Grid,
            SkySource::Stars,
        ];
        let mut skies = Skies {
            choices: built_in.map(Choice::new).into(),
            shown: 0,
            proxy,
        };
        skies.shown = skies.index(first);
        skies.choices[skies.shown].on_device = Some(sky);
        skies
    }

    /// Names of the skies, in the order in which the key cycles through them.
    pub fn names(&self) -> impl Iterator<Item = String> {
        self.choices.iter().map(|choice| choice.source.name())
    }

    /// Index of the selected sky.
    pub fn shown(&self) -> usize {
        self.shown
    }

    /// Name of the selected sky.
    pub fn name(&self) -> String {
        self.choices[self.shown].source.name()
    }

    /// Whether the sky `stars` is selected.
    pub fn is_stars(&self) -> bool {
        self.choices[self.shown].source == SkySource::Stars
    }

    /// Index of the next sky.
    pub fn next(&self) -> usize {
        (self.shown + 1) % self.choices.len()
    }

    /// Index of a source, which is added if it is new. It then replaces the skies that the user dropped earlier: a
    /// sky takes up to 400 MB.
    fn index(&mut self, source: SkySource) -> usize {
        if let Some(at) = self.choices.iter().position(|c| c.source == source) {
            return at;
        }
        self.choices.retain(|choice| choice.source.is_built_in());
        self.choices.push(Choice::new(source));
        self.choices.len() - 1
    }

    /// Selects a sky. Returns it if it is on the device; otherwise a thread loads it and sends an `AppEvent::Sky`.
    pub fn choose(&mut self, index: usize) -> Option<SkyOnDevice> {
        self.shown = index;
        let choice = &mut self.choices[index];
        if choice.on_device.is_none() && !choice.asked_for {
            choice.asked_for = true;
            let (source, proxy) = (choice.source.clone(), self.proxy.clone());
            std::thread::spawn(move || {
                let sky = sky::load(&source).map(Box::new);
                // The window may have closed meanwhile.
                let _ = proxy.send_event(AppEvent::Sky(source, sky));
            });
        }
        choice.on_device.clone()
    }

    /// Keeps a sky that is on the device now; returns its index.
    pub fn keep(&mut self, source: SkySource, sky: SkyOnDevice) -> usize {
        let at = self.index(source);
        self.choices[at].on_device = Some(sky);
        at
    }
}

impl Choice {
    fn new(source: SkySource) -> Self {
        Choice {
            source,
            on_device: None,
            asked_for: false,
        }
    }
}
