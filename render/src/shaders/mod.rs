//! The WGSL of the renderer, assembled from modules.
//!
//! A module is a file of this folder, a file of `lensbake-tables`, or a text that is generated for one pipeline.
//! Its lines `// #import name` say which other modules it needs; [`wgsl`] includes each of them once.
//! WGSL allows declarations in any order, so concatenation is enough: no names are changed and nothing is parsed.
//! (naga_oil, the library for this, renames every identifier of a module, and its releases lag behind those of
//! naga.)

use crate::filter::{
    MAX_TAPS, MAX_TAPS_BESIDE_EDGE, NEAR_INSIDE, NEAR_OUTSIDE, STRAIGHT_EDGE, STRIPS, SUB_RAYS,
};
use crate::footprint::{ONE_TAP_LONG, ONE_TAP_SQ, SPACING};
use crate::shift;
use crate::stars::images::MIN_LIGHT;
use crate::stars::kernel::REACHES;
use crate::tone_map::KNEE;
use lensbake_tables::{inverse, lookup};
use std::borrow::Cow;
use std::collections::HashMap;

/// Side of a tile in pixels. A tile is a workgroup of the programs that draw, and is classified as a whole.
pub(crate) const TILE: u32 = 8;
/// Largest number of padding entries in a work queue: one less than the largest number of rows of workgroups in a
/// dispatch.
pub(crate) const PADDING: u32 = 64;

/// Prefix of a line that imports a module.
const IMPORT: &str = "// #import ";

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        &[$(($name, include_str!(concat!($name, ".wgsl")))),*]
    };
}

/// The modules of this folder.
const FILES: &[(&str, &str)] = files![
    "average_anisotropic",
    "average_taps",
    "camera",
    "camera_edge",
    "classify_disc",
    "classify_tiles",
    "compute",
    "compute_tiles",
    "coverage",
    "deflect_direct",
    "deflect_direct_patch",
    "deflect_flat",
    "deflect_lut",
    "deflect_row",
    "deflection",
    "difference",
    "disc_bent",
    "disc_block",
    "disc_flat",
    "disc_hits",
    "disc_leg",
    "disc_light",
    "disc_over",
    "disc_pattern_off",
    "disc_pattern_on",
    "disc_pixel",
    "filter",
    "filtered_disc",
    "filtered_pixel",
    "footprint",
    "fragment",
    "frequency_shift",
    "full_screen",
    "insert_light",
    "inverse_lens",
    "keep_behind_sky",
    "keep_behind_stars",
    "keep_shifted",
    "keep_sky",
    "keep_stars",
    "kernel",
    "link_overflow_sums",
    "list_pieces",
    "list_stars",
    "no_column",
    "observe_boosted",
    "observe_rest",
    "origin_band",
    "origin_texture",
    "output_buffer",
    "output_texture",
    "patch",
    "picture",
    "picture_disc",
    "present",
    "ray_equidistant",
    "ray_equirectangular",
    "ray_light",
    "ray_perspective",
    "region",
    "shadow",
    "shift_brightness",
    "shift_colour",
    "shift_off",
    "sky",
    "srgb",
    "star_images_bent",
    "star_images_flat",
    "star_light_of_column",
    "star_light_of_pixel",
    "star_list",
    "star_list_heads",
    "star_lists",
    "star_node",
    "start_moving",
    "start_rest",
    "storable_full",
    "storable_half",
    "sum_overflow_lists",
    "tone_map",
    "trace",
    "veil",
    "view_boosted",
    "view_rest",
    "work_queues",
];

/// The modules that a shader is assembled from.
#[derive(Debug, Clone)]
pub(crate) struct Modules(HashMap<&'static str, Cow<'static, str>>);

impl Modules {
    /// All files, and the constants that shaders and Rust share.
    pub(crate) fn new() -> Self {
        let files = FILES.iter().chain(&lookup::WGSL_MODULES);
        let files = files.map(|&(name, text)| (name, text.into()));
        let mut modules = Modules(files.collect());
        modules.define("inverse", inverse::WGSL);
        modules.define("constants", constants());
        modules
    }

    /// Adds the module `name`, generated for this shader.
    pub(crate) fn define(&mut self, name: &'static str, text: impl Into<Cow<'static, str>>) {
        self.0.insert(name, text.into());
    }

    /// The text of the modules `roots` and of all modules that they import, each once.
    ///
    /// # Panics
    /// If there is no such module: a test assembles every shader.
    pub(crate) fn assemble(&self, roots: &[&str]) -> String {
        let (mut included, mut waiting) = (roots.to_vec(), roots.to_vec());
        while let Some(name) = waiting.pop() {
            for import in imports(self.text(name)) {
                if !included.contains(&import) {
                    included.push(import);
                    waiting.push(import);
                }
            }
        }
        let texts: Vec<&str> = included.iter().map(|name| self.text(name)).collect();
        texts.join("\n")
    }

    fn text(&self, name: &str) -> &str {
        let text = self.0.get(name);
        text.unwrap_or_else(|| panic!("no shader module {name}"))
    }
}

/// The WGSL of these modules and of all that they import: `shadow`, `footprint`, `kernel`, `tone_map`, `srgb` and
/// others that import only files and shared constants.
///
/// # Panics
/// If there is no such module, or if it imports one that is generated for a pipeline (`row`, `deflect`, `keep`,
/// `output`).
pub fn wgsl(modules: &[&str]) -> String {
    Modules::new().assemble(modules)
}

/// The names of the modules that a text imports.
fn imports(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| line.strip_prefix(IMPORT))
}

/// The constants that shaders and Rust share, from their definitions in Rust.
fn constants() -> String {
    let [core, halos @ ..] = REACHES;
    let unsigned = [
        ("TILE", TILE),
        ("PADDING", PADDING),
        ("SUB_RAYS", SUB_RAYS),
        ("STRIPS", STRIPS),
        ("HALOS", halos.len() as u32),
    ];
    let floats = [
        ("MAX_TAPS", f64::from(MAX_TAPS)),
        ("MAX_TAPS_BESIDE_EDGE", f64::from(MAX_TAPS_BESIDE_EDGE)),
        ("NEAR_OUTSIDE", NEAR_OUTSIDE),
        ("NEAR_INSIDE", NEAR_INSIDE),
        ("SPACING", SPACING),
        ("ONE_TAP_SQ", ONE_TAP_SQ),
        ("ONE_TAP_LONG", ONE_TAP_LONG),
        ("STRAIGHT_EDGE", STRAIGHT_EDGE),
        ("KNEE", KNEE.into()),
        ("CORE", core),
        ("MIN_LIGHT", MIN_LIGHT.into()),
        ("DARKEST", shift::DARKEST),
        ("WHITE_BODY", 1.0 / shift::WHITE_KELVIN),
        ("GREEN_OVER_RED", shift::green_over_red()),
        ("BLUE_OVER_RED", shift::blue_over_red()),
        ("COLDEST", 1.0 / shift::KELVINS.start()),
        ("HOTTEST", 1.0 / shift::KELVINS.end()),
    ];
    let unsigned = unsigned.map(|(name, value)| format!("const {name}: u32 = {value}u;\n"));
    let floats = floats.map(|(name, value)| format!("const {name}: f32 = {:?};\n", value as f32));
    unsigned.into_iter().chain(floats).collect()
}

/// Struct layouts as naga computes them, for comparison with the Rust structs.
#[cfg(test)]
pub(crate) mod layouts {
    use naga::{Module, TypeInner};

    /// The layout of the struct `name` of an assembled shader: (name, offset) of each member, and the size of the
    /// struct, bytes.
    pub(crate) fn of(source: &str, name: &str) -> (Vec<(String, usize)>, usize) {
        let module = naga::front::wgsl::parse_str(source)
            .unwrap_or_else(|e| panic!("{}", e.emit_to_string(source)));
        find(&module, name).unwrap_or_else(|| panic!("no struct {name}"))
    }

    fn find(module: &Module, name: &str) -> Option<(Vec<(String, usize)>, usize)> {
        module.types.iter().find_map(|(_, of)| match &of.inner {
            TypeInner::Struct { members, span } if of.name.as_deref() == Some(name) => {
                let member = |m: &naga::StructMember| (m.name.clone().unwrap(), m.offset as usize);
                Some((members.iter().map(member).collect(), *span as usize))
            }
            _ => None,
        })
    }

    /// Checks that a Rust struct has the same layout as the struct of this name in a shader: the members in their
    /// order, their offsets, and the size.
    macro_rules! assert_layout {
        ($source:expr, $name:literal, $type:ty, $($member:ident),* $(,)?) => {
            let ours = vec![$((stringify!($member).to_owned(), std::mem::offset_of!($type, $member))),*];
            assert_eq!($crate::shaders::layouts::of($source, $name), (ours, size_of::<$type>()), $name);
        };
    }
    pub(crate) use assert_layout;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_import_is_included_once() {
        let mut modules = Modules::new();
        modules.define("a", "// #import b\n// #import c\nA");
        modules.define("b", "// #import c\nB");
        modules.define("c", "// #import a\nC");
        let text = modules.assemble(&["a"]);
        for letter in ["A", "B", "C"] {
            assert_eq!(text.matches(&format!("\n{letter}")).count(), 1, "{text}");
        }
    }

    #[test]
    fn constants_are_written_in_full() {
        let text = constants();
        for line in [
            "const SUB_RAYS: u32 = 3u;",
            "const KNEE: f32 = 0.8;",
            "const MAX_TAPS: f32 = 16.0;",
        ] {
            assert!(text.contains(line), "{text}");
        }
    }
}
