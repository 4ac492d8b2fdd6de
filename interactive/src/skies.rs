//! The skies to choose from: the built-in ones and those that the user drops. A sky is loaded when it is first
//! selected; then it stays on the GPU.

use lensbake_render::gpu::SkyOnDevice;
use lensbake_render::sky::SkySource;

/// The built-in skies, in the order in which the key cycles through them.
pub const BUILT_IN: [SkySource; 4] = [
    SkySource::Nebula,
    SkySource::Starmap,
    SkySource::Grid,
    SkySource::Stars,
];

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
}

/// What the caller must do after a sky was selected.
#[derive(Debug, Clone, PartialEq)]
pub enum Selected {
    /// Show it: it is on the device.
    Ready(SkyOnDevice),
    /// Load it, and then call [`Skies::keep`].
    Load(SkySource),
    /// Wait: it is being loaded.
    Loading,
}

impl Skies {
    /// The built-in skies, and `first` if it is not one of them, which is selected. `sky` is `first` on the device.
    pub fn new(first: SkySource, sky: SkyOnDevice) -> Self {
        let mut skies = Skies {
            choices: BUILT_IN.map(Choice::new).into(),
            shown: 0,
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

    /// Selects a sky.
    pub fn select(&mut self, index: usize) -> Selected {
        self.shown = index;
        let choice = &mut self.choices[index];
        match &choice.on_device {
            Some(sky) => Selected::Ready(sky.clone()),
            None if choice.asked_for => Selected::Loading,
            None => {
                choice.asked_for = true;
                Selected::Load(choice.source.clone())
            }
        }
    }

    /// Forgets that a sky is being loaded, because that failed: it is loaded when it is selected again.
    pub fn forget(&mut self, source: &SkySource) {
        for choice in self.choices.iter_mut().filter(|one| one.source == *source) {
            choice.asked_for = false;
        }
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
