//! The key of a pipeline, and its WGSL source.

use super::camera_key::CameraKey;
use super::lookup_shape::LookupShape;
use super::pass::Pass;
use super::stars::Group;
use crate::disc::Disc;
use crate::lens::{Deflection, Lens};
use crate::scene::Sampling;
use crate::shaders::Modules;
use crate::shift::Shift;

/// What a pass computes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Output {
    /// The light of each pixel.
    Picture(Sampling),
    /// Where the light of each pixel comes from: a direction on the sky.
    Trace,
    /// The difference between the light by the table and by direct integration, amplified. The deflection method
    /// of the lens does not matter.
    Difference,
}

impl Output {
    /// How a pixel samples the sky.
    pub(super) fn sampling(self) -> Sampling {
        match self {
            Output::Picture(sampling) => sampling,
            Output::Trace | Output::Difference => Sampling::Single,
        }
    }
}

/// Where a pass writes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Store {
    /// To a buffer of one region, in 32-bit floats, to be read back; a render pass draws to a texture that is copied to
    /// one.
    Buffer,
    /// To a texture of the whole picture, in 16-bit floats: to be shown.
    Texture,
}

/// [`Deflection`] as a hash key: the step is held as its bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum DeflectionKey {
    Lut,
    Direct { step_bits: u64 },
    Flat,
}

/// Defines the module `shift`.
pub(super) fn define_shift(modules: &mut Modules, shift: Shift) {
    let module = match shift {
        Shift::Off => "shift_off",
        Shift::Brightness => "shift_brightness",
        Shift::Colour => "shift_colour",
    };
    modules.define("shift", alias_module(module));
}

/// What a pipeline is specialised for. A shader contains no code for what its scene lacks.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct PipelineKey {
    /// In what kind of pass it draws.
    pub pass: Pass,
    deflection: DeflectionKey,
    /// What it computes.
    pub output: Output,
    /// Where it writes.
    pub store: Store,
    /// Shape of the row that it looks up.
    pub lookup: LookupShape,
    /// Whether it draws stars in front of the sky.
    pub stars: bool,
    /// The pixels that share a list of stars.
    pub(super) group: Group,
    /// The camera's motion and the projection.
    camera: CameraKey,
    /// What of the frequency shift is shown.
    shift: Shift,
    /// Whether it draws a disc in front of the sky.
    pub(super) disc: bool,
    /// Whether the disc has a pattern.
    pattern: bool,
}

/// Name of the module that [`PipelineKey::deflect`] writes.
const DEFLECT: &str = "deflect";

impl PipelineKey {
    /// The key of a pipeline that computes `output` by `deflection`, in a compute pass. `stars` is ignored unless
    /// `output` is a picture, `shift` if it is a trace.
    pub fn new(
        deflection: Deflection,
        output: Output,
        store: Store,
        lookup: LookupShape,
        stars: bool,
        camera: CameraKey,
        shift: Shift,
    ) -> Self {
        let integrates =
            matches!(deflection, Deflection::Direct { .. }) || output == Output::Difference;
        PipelineKey {
            pass: Pass::Compute,
            deflection: match deflection {
                Deflection::Lut => DeflectionKey::Lut,
                Deflection::Direct { step } => DeflectionKey::Direct {
                    step_bits: step.to_bits(),
                },
                Deflection::Flat => DeflectionKey::Flat,
            },
            output,
            store,
            lookup,
            stars: stars && matches!(output, Output::Picture(_)),
            group: Group::Rows,
            // Only direct integration starts differently for a radial motion; for the table it is in the row.
            camera: if integrates {
                camera
            } else {
                camera.without_radial_motion()
            },
            shift: match output {
                Output::Trace => Shift::Off,
                Output::Picture(_) | Output::Difference => shift,
            },
            disc: false,
            pattern: false,
        }
    }

    /// The same key with this disc or without one. Only pictures show one.
    pub fn with_disc(self, disc: Option<&Disc>) -> Self {
        let disc = disc.filter(|_| matches!(self.output, Output::Picture(_)));
        PipelineKey {
            disc: disc.is_some(),
            pattern: disc.is_some_and(|disc| disc.pattern > 0.0),
            ..self
        }
    }

    /// The index of the bind group of the disc: the one after all others.
    pub(super) fn disc_group(self) -> u32 {
        if self.stars { 3 } else { 2 }
    }

    /// The key of a pipeline that computes `output` through `lens`.
    pub(super) fn of(lens: &Lens, output: Output, store: Store, stars: bool, shift: Shift) -> Self {
        let (lookup, camera) = (LookupShape::of(lens), CameraKey::of(&lens.camera));
        PipelineKey::new(lens.deflection, output, store, lookup, stars, camera, shift)
    }

    /// The same key with a star list for each `group` of pixels.
    pub(super) fn with_group(self, group: Group) -> Self {
        PipelineKey { group, ..self }
    }

    /// Whether it draws by direct integration.
    pub(super) fn integrates(self) -> bool {
        matches!(self.deflection, DeflectionKey::Direct { .. })
    }

    /// The same key in another kind of pass.
    pub fn in_pass(self, pass: Pass) -> Self {
        PipelineKey { pass, ..self }
    }

    /// The key of the pipelines that classify tiles for this one; `None` if it does not draw by tiles.
    /// Classification uses the table in place of direct integration and does not depend on the store, the stars or
    /// the filter, so several keys share it.
    pub(super) fn classifier(self) -> Option<Self> {
        let by_tiles = self.pass == Pass::Compute && self.averages();
        by_tiles.then_some(PipelineKey {
            output: Output::Picture(Sampling::Filtered),
            deflection: match self.deflection {
                DeflectionKey::Direct { .. } => DeflectionKey::Lut,
                other => other,
            },
            store: Store::Buffer,
            stars: false,
            group: Group::Rows,
            camera: self.camera.without_radial_motion(),
            shift: Shift::Off,
            pattern: false,
            ..self
        })
    }

    /// How a pixel samples the sky.
    pub(super) fn sampling(self) -> Sampling {
        self.output.sampling()
    }

    /// Whether each pixel is averaged over its area.
    fn averages(self) -> bool {
        self.sampling().averages()
    }

    /// A name for labels and messages.
    pub fn name(self) -> &'static str {
        match self.output {
            Output::Picture(_) => "picture",
            Output::Trace => "trace",
            Output::Difference => "difference",
        }
    }

    /// Whether it reads the sky.
    pub fn reads_sky(self) -> bool {
        self.output != Output::Trace
    }

    /// The entry points. Of a compute pass: one, and if it draws by tiles, the overridable constant `CLASS` makes it a
    /// program for each [`crate::filter::TileClass`]. Of a render pass: that of the fragments and that of the vertices.
    pub fn entry_points(self) -> &'static [&'static str] {
        match self.pass {
            Pass::Compute if self.averages() => &["draw_tiles"],
            Pass::Compute => &["draw"],
            Pass::Fragment => &["draw", "corner"],
        }
    }

    /// The WGSL source.
    pub fn source(self) -> String {
        let mut modules = self.modules();
        let keep = match (self.stars, self.shift) {
            (true, _) => "keep_stars",
            (false, Shift::Off) => "keep_sky",
            (false, _) => "keep_shifted",
        };
        modules.define("keep", alias_module(keep));
        modules.define(
            "output",
            alias_module(match self.store {
                Store::Buffer => "output_buffer",
                Store::Texture => "output_texture",
            }),
        );
        modules.define(
            "origin",
            alias_module(match self.store {
                Store::Buffer => "origin_band",
                Store::Texture => "origin_texture",
            }),
        );
        modules.define(
            "storable",
            alias_module(match self.store {
                Store::Buffer => "storable_full",
                Store::Texture => "storable_half",
            }),
        );
        modules.define(
            "average",
            alias_module(match self.output {
                Output::Picture(Sampling::Anisotropic) => "average_anisotropic",
                _ => "average_taps",
            }),
        );
        modules.define(
            "pixel",
            alias_module(match self.output {
                Output::Picture(sampling) if sampling.averages() && self.disc => "filtered_disc",
                Output::Picture(sampling) if sampling.averages() => "filtered_pixel",
                Output::Picture(_) if self.disc => "picture_disc",
                Output::Picture(_) => "picture",
                Output::Trace => "trace",
                Output::Difference => "difference",
            }),
        );
        self.group.define(&mut modules);
        let (star_light, column) = match self.group {
            Group::Rows => ("star_light_of_pixel", "no_column"),
            Group::Tile => ("star_light_of_column", "star_light_of_column"),
        };
        modules.define("star_light", alias_module(star_light));
        modules.define(
            "column",
            alias_module(if self.stars { column } else { "no_column" }),
        );
        modules.assemble(&[match self.pass {
            Pass::Compute if self.averages() => "compute_tiles",
            Pass::Compute => "compute",
            Pass::Fragment => "fragment",
        }])
    }

    /// The WGSL source that classifies tiles.
    pub(super) fn classifier_source(self) -> String {
        self.modules().assemble(&[if self.disc {
            "classify_disc"
        } else {
            "classify_tiles"
        }])
    }

    /// The entry point that classifies tiles.
    pub(super) fn classifier_entry_point(self) -> &'static str {
        if self.disc {
            "classify_disc_tiles"
        } else {
            "classify_tiles"
        }
    }

    /// Defines the modules that a disc needs.
    fn define_disc(self, modules: &mut Modules) {
        let group = self.disc_group();
        modules.define(
            "disc",
            format!(
                "// #import disc_block\n@group({group}) @binding(0) var<uniform> disc: Disc;\n"
            ),
        );
        modules.define(
            "disc_orbit",
            alias_module(match self.deflection {
                DeflectionKey::Lut | DeflectionKey::Direct { .. } => "disc_bent",
                DeflectionKey::Flat => "disc_flat",
            }),
        );
        modules.define(
            "disc_pattern",
            alias_module(if self.pattern {
                "disc_pattern_on"
            } else {
                "disc_pattern_off"
            }),
        );
        modules.define(
            "keep_behind",
            alias_module(if self.stars {
                "keep_behind_stars"
            } else {
                "keep_behind_sky"
            }),
        );
    }

    fn modules(self) -> Modules {
        let mut modules = Modules::new();
        self.lookup.define(&mut modules);
        self.camera.define(&mut modules);
        define_shift(&mut modules, self.shift);
        modules.define("step", format!("const STEP: f32 = {:?};\n", self.step()));
        modules.define(DEFLECT, self.deflect());
        if self.disc {
            self.define_disc(&mut modules);
        }
        modules
    }

    fn step(self) -> f64 {
        match self.deflection {
            DeflectionKey::Direct { step_bits } => f64::from_bits(step_bits),
            DeflectionKey::Lut | DeflectionKey::Flat => Deflection::DEFAULT_STEP,
        }
    }

    /// The module `deflect`: it defines `deflect`, and `deflect_patch` for rays with a footprint.
    fn deflect(self) -> String {
        match self.deflection {
            DeflectionKey::Lut => calls("table", "deflect_lut", "deflect_lut_patch"),
            DeflectionKey::Flat => calls("deflect_flat", "deflect_flat", "deflect_flat"),
            DeflectionKey::Direct { .. } if matches!(self.output, Output::Picture(_)) => calls(
                "deflect_direct_patch",
                "deflect_direct",
                "deflect_direct_patch",
            ),
            DeflectionKey::Direct { .. } => {
                calls("deflect_direct", "deflect_direct", "deflect_direct")
            }
        }
    }
}

/// A module that only imports the module `of`.
pub(super) fn alias_module(of: &str) -> String {
    format!("// #import {of}\n")
}

fn calls(module: &str, ray: &str, patch: &str) -> String {
    format!(
        "// #import {module}\n\
         fn deflect(c: f32, p: f32) -> Deflected {{ return {ray}(c, p); }}\n\
         fn deflect_patch(c: f32, p: f32) -> Deflected {{ return {patch}(c, p); }}\n"
    )
}

#[cfg(test)]
#[path = "source_tests.rs"]
pub(super) mod tests;
