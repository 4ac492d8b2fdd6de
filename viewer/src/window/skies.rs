//! The skies to choose from: the built-in ones and what the user brings. Each goes to the GPU when it
//! is first looked at, and stays there; a thread reads it, so that the window does not stand still.

use super::app::Arrival;
use crate::gpu::SkyOnDevice;
use crate::sky::{self, SkySource};
use winit::event_loop::EventLoopProxy;

/// A sky to choose.
#[derive(Debug)]
struct Choice {
    source: SkySource,
    on_device: Option<SkyOnDevice>,
    asked_for: bool,
}

/// All of them; one is looked at.
#[derive(Debug)]
pub struct Skies {
    choices: Vec<Choice>,
    shown: usize,
    proxy: EventLoopProxy<Arrival>,
}

impl Skies {
    /// The built-in ones, and `first` if it is none of them, on the device already.
    pub fn new(first: SkySource, sky: SkyOnDevice, proxy: EventLoopProxy<Arrival>) -> Self {
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

    /// Their names, in the order of the key.
    pub fn names(&self) -> impl Iterator<Item = String> {
        self.choices.iter().map(|choice| choice.source.name())
    }

    /// Which is looked at.
    pub fn shown(&self) -> usize {
        self.shown
    }

    /// The name of the one that is looked at.
    pub fn name(&self) -> String {
        self.choices[self.shown].source.name()
    }

    /// Whether what is looked at is nothing but stars.
    pub fn is_stars(&self) -> bool {
        self.choices[self.shown].source == SkySource::Stars
    }

    /// The one after it.
    pub fn next(&self) -> usize {
        (self.shown + 1) % self.choices.len()
    }

    /// The place of a source among the choices, a new one if need be. What the user brought before
    /// makes room: a sky is up to 400 MB.
    fn index(&mut self, source: SkySource) -> usize {
        if let Some(at) = self.choices.iter().position(|c| c.source == source) {
            return at;
        }
        self.choices.retain(|choice| choice.source.is_built_in());
        self.choices.push(Choice::new(source));
        self.choices.len() - 1
    }

    /// Looks at another: its sky if it is on the device, else it is on its way.
    pub fn choose(&mut self, index: usize) -> Option<SkyOnDevice> {
        self.shown = index;
        let choice = &mut self.choices[index];
        if choice.on_device.is_none() && !choice.asked_for {
            choice.asked_for = true;
            let (source, proxy) = (choice.source.clone(), self.proxy.clone());
            std::thread::spawn(move || {
                let sky = sky::load(&source).map(Box::new);
                // The window may have closed meanwhile.
                let _ = proxy.send_event(Arrival::Sky(source, sky));
            });
        }
        choice.on_device.clone()
    }

    /// Keeps a sky that has arrived; returns its place.
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
