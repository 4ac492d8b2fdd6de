//! The lookup as one text of WGSL functions: those of the renderer's own shaders, and the few that only the exported
//! texts have. Which of them a text needs depends on where its numbers are.

use super::dialect::Dialect;
use super::numbers::{Numbers, float};
use lensbake_tables::lookup::{HorizonSide, ShadowEdge, WGSL_MODULES};

/// Name of the constant array of numbers, if the text has one.
pub const CONSTANT_ARRAY: &str = "$function_numbers";

/// Where the numbers are that the text looks up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// The row of one observer, as an array in the text.
    Array,
    /// The row of one observer, as a texture or an array that the caller fills.
    Row,
    /// All rows, as an array; the four rows around the observer are mixed for each ray.
    Atlas,
    /// All rows, as a texture with linear filtering.
    Filtered,
}

/// What the functions of a text are specialised for.
#[derive(Debug, Clone, Copy)]
pub struct Shape {
    /// Where the numbers are.
    pub place: Place,
    /// Texels of a row.
    pub texels: u32,
    /// Rows of the atlas.
    pub rows: u32,
    /// The edge of the shadow of the one observer; all others compute it from r.
    pub edge: Option<ShadowEdge>,
    /// The side of the horizon, on which the row coordinate depends.
    pub side: HorizonSide,
}

/// What the functions are passed besides directions: the text of the parameters and that of the arguments. Both are empty
/// if a function does not need it.
struct Passed {
    /// The radius, from which the edge of the shadow is computed.
    observer: [&'static str; 2],
    /// The radius, for the lookup itself.
    radius: [&'static str; 2],
    /// The table.
    data: [&'static str; 2],
}

impl Shape {
    /// The source of the functions in WGSL, each declared before its use. Parameters, arguments and texture access are
    /// already those of `dialect`; `rewrite` translates the rest.
    pub fn functions(&self, numbers: &Numbers, dialect: &Dialect) -> String {
        let edge = include_str!("wgsl/edge_struct.wgsl");
        let edge = match (self.side, self.edge) {
            (HorizonSide::Below, _) => [
                include_str!("wgsl/edge_struct_below.wgsl"),
                include_str!("wgsl/edge_of_one_below.wgsl"),
            ],
            (HorizonSide::Above, Some(_)) => [edge, include_str!("wgsl/edge_of_one.wgsl")],
            (HorizonSide::Above, None) => [edge, include_str!("wgsl/edge_of_all.wgsl")],
        };
        let mut parts = edge.map(str::to_owned).to_vec();
        let row_coordinate = self.side.row_coordinate();
        parts.push(of_the_renderer(row_coordinate, "row_coordinate"));
        parts.push(of_the_renderer(row_coordinate, "row_position"));
        if self.place == Place::Filtered {
            parts.push(include_str!("wgsl/filtered.wgsl").to_owned());
        } else {
            parts.push(of_the_renderer("arithmetic", "cubic"));
            parts.push(self.texel(dialect).to_owned());
            parts.push(include_str!("wgsl/hermite.wgsl").to_owned());
        }
        parts.push(include_str!("wgsl/bend.wgsl").to_owned());
        parts.push(of_the_renderer("arithmetic", "cos_sin"));
        parts.push(of_the_renderer("lookup", "turned"));
        parts.push(include_str!("wgsl/direction.wgsl").to_owned());
        let text = self.filled(&parts.join("\n"), dialect);
        match (self.place, dialect.texture) {
            (Place::Row | Place::Filtered, Some(_)) => numbers.decode_texture(&text),
            _ => numbers.decode_array(&text),
        }
    }

    fn texel(&self, dialect: &Dialect) -> &'static str {
        match (self.place, dialect.texture) {
            (Place::Row, Some(_)) => include_str!("wgsl/texel_of_texture.wgsl"),
            (Place::Atlas, _) => include_str!("wgsl/texel_of_atlas.wgsl"),
            _ => include_str!("wgsl/texel_of_array.wgsl"),
        }
    }

    /// `text` with its markers replaced: capital words stand for numbers, parameters and arguments.
    fn filled(&self, text: &str, dialect: &Dialect) -> String {
        let passed = self.passed(dialect);
        let mut lines = Vec::new();
        for line in text.lines() {
            // Parameters in a declaration, arguments everywhere else.
            let which = usize::from(!line.trim_start().starts_with("fn "));
            let mut line = line.to_owned();
            for (marker, texts) in [
                ("OBSERVER", passed.observer),
                ("RADIUS", passed.radius),
                ("DATA", passed.data),
            ] {
                line = match texts[which] {
                    "" => line.replace(&format!(", {marker}"), "").replace(marker, ""),
                    text => line.replace(marker, text),
                };
            }
            lines.push(line);
        }
        let number = |of: fn(&ShadowEdge) -> f32| {
            self.edge
                .map_or(String::new(), |edge| float(of(&edge).into()))
        };
        let (texture_load, texture_sample) = dialect
            .texture
            .map_or(("", ""), |texture| (texture.load, texture.sample));
        let text = lines.join("\n") + "\n";
        text.replace("TAN_HALF", &number(|edge| edge.tan_half))
            .replace("LOG_WEIGHT", &number(|edge| edge.log_weight))
            .replace("EDGE_SCALE", &number(|edge| edge.scale))
            .replace("BEFORE_LAST", &format!("{}.0", self.texels - 2))
            .replace("LAST_ROW", &format!("{}.0", self.rows - 1))
            .replace("LAST", &format!("{}.0", self.texels - 1))
            .replace("TEXEL_COUNT", &self.texels.to_string())
            .replace("TEXELS", &format!("{}.0", self.texels))
            .replace("ROWS", &format!("{}.0", self.rows))
            .replace("ROW", self.array_name(dialect))
            .replace("LOADED", texture_load)
            .replace("SAMPLED", texture_sample)
    }

    /// Name of the array of numbers in the functions.
    fn array_name(&self, dialect: &Dialect) -> &'static str {
        match (self.place, dialect.has_constants) {
            (Place::Array | Place::Atlas, true) => CONSTANT_ARRAY,
            _ => "row",
        }
    }

    fn passed(&self, dialect: &Dialect) -> Passed {
        const NONE: [&str; 2] = ["", ""];
        const R: [&str; 2] = ["r: f32", "r"];
        let data = match (self.place, dialect.texture) {
            (Place::Row, Some(texture)) => texture.row,
            (Place::Filtered, Some(texture)) => texture.atlas,
            (Place::Row, None) => dialect.array_parameter,
            (Place::Array | Place::Atlas, None) if !dialect.has_constants => {
                dialect.array_parameter
            }
            _ => NONE,
        };
        Passed {
            observer: if self.edge.is_some() { NONE } else { R },
            radius: match self.place {
                Place::Atlas | Place::Filtered => R,
                Place::Array | Place::Row => NONE,
            },
            data,
        }
    }
}

/// The function `name` of a module of the renderer's shaders, with its comment.
fn of_the_renderer(module: &str, name: &str) -> String {
    let source = WGSL_MODULES.iter().find(|(own, _)| *own == module);
    let source = source.expect("a module of the renderer").1;
    let start = source
        .find(&format!("fn {name}("))
        .expect("a function of that module");
    let length = source[start..].find("\n}\n").expect("a function ends") + 3;
    let comment = source[..start]
        .lines()
        .rev()
        .take_while(|line| line.starts_with("//"));
    let comment = start - comment.map(|line| line.len() + 1).sum::<usize>();
    source[comment..start + length].to_owned()
}
