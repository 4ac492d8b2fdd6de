//! The lookup on a GPU: its WGSL source, and a row as it is uploaded.
//!
//! [`crate::mirror`] has the same functions in Rust, in f32 and with the same operations. The reference in f64 is
//! [`crate::Row::bend`].

use crate::{Axis, Interpolation, Row, RowFormat, Texel};
use lensbake_core::Observer;

/// WGSL source of the lookup above the horizon. The text of [`RowShape::wgsl`] must precede it.
pub const WGSL: &str = concat!(
    include_str!("wgsl/arithmetic.wgsl"),
    include_str!("wgsl/shadow_edge.wgsl"),
    include_str!("wgsl/row_coordinate_above.wgsl"),
    include_str!("wgsl/lookup.wgsl")
);

/// WGSL source of the lookup below the horizon: as [`WGSL`], with another row coordinate.
pub const WGSL_BELOW: &str = concat!(
    include_str!("wgsl/arithmetic.wgsl"),
    include_str!("wgsl/shadow_edge.wgsl"),
    include_str!("wgsl/row_coordinate_below.wgsl"),
    include_str!("wgsl/lookup.wgsl")
);

/// The WGSL files by name, for programs that assemble shaders from modules. Each file names the modules that it
/// needs in `// #import` lines. The module `row` is [`RowShape::wgsl`] for `lookup` and
/// [`StereographicRow::wgsl`](crate::StereographicRow::wgsl) for `stereographic`, and `row_coordinate` is the one that
/// [`HorizonSide::row_coordinate`] names.
pub const WGSL_MODULES: [(&str, &str); 6] = [
    ("arithmetic", include_str!("wgsl/arithmetic.wgsl")),
    (
        "row_coordinate_above",
        include_str!("wgsl/row_coordinate_above.wgsl"),
    ),
    (
        "row_coordinate_below",
        include_str!("wgsl/row_coordinate_below.wgsl"),
    ),
    ("shadow_edge", include_str!("wgsl/shadow_edge.wgsl")),
    ("lookup", include_str!("wgsl/lookup.wgsl")),
    ("stereographic", include_str!("wgsl/stereographic.wgsl")),
];

/// Largest width in texels of the texture that holds a row: WebGPU guarantees this width on every device. A longer
/// row continues on the next line.
pub const ROW_LINE: u32 = 8192;

/// The side of the horizon that an observer is on. The row coordinate differs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum HorizonSide {
    /// Above the horizon.
    #[default]
    Above,
    /// At the horizon or below.
    Below,
}

impl HorizonSide {
    /// The side of the horizon that `observer` is on.
    pub fn of(observer: &Observer) -> Self {
        match observer.is_inside() {
            true => HorizonSide::Below,
            false => HorizonSide::Above,
        }
    }

    /// Name of the module of [`WGSL_MODULES`] that has the row coordinate.
    pub fn row_coordinate(self) -> &'static str {
        match self {
            HorizonSide::Above => "row_coordinate_above",
            HorizonSide::Below => "row_coordinate_below",
        }
    }
}

/// The properties of a row that a shader is specialised for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct RowShape {
    /// Number of texels.
    pub texels: u32,
    /// Interpolation between two texels.
    pub interpolation: Interpolation,
    /// The side of the horizon that its observer is on.
    pub side: HorizonSide,
    /// Format of the texels.
    pub format: RowFormat,
}

impl RowShape {
    /// The lookup for rows of this shape: [`WGSL`] or [`WGSL_BELOW`].
    pub fn lookup_wgsl(self) -> &'static str {
        match self.side {
            HorizonSide::Above => WGSL,
            HorizonSide::Below => WGSL_BELOW,
        }
    }

    /// Width and height of the texture that holds the row. The texels fill it line by line; the rest of the last
    /// line is unused.
    pub fn texture_size(self) -> [u32; 2] {
        [self.texels.min(ROW_LINE), self.texels.div_ceil(ROW_LINE)]
    }

    /// WGSL source that declares the row as a texture of [`RowShape::texture_size`] at the given binding, loads
    /// from it, and interpolates between two texels. The shader does not use hardware filters, whose weights have
    /// only 8 bits.
    pub fn wgsl(self, group: u32, binding: u32) -> String {
        let texel = if self.texels <= ROW_LINE {
            "vec2(i, 0u)".to_owned()
        } else {
            format!("vec2(i % {ROW_LINE}u, i / {ROW_LINE}u)")
        };
        format!(
            "const ROW_LAST: u32 = {}u;\n\
             @group({group}) @binding({binding}) var row: texture_2d<f32>;\n\
             {}",
            self.texels - 1,
            self.format.wgsl(&texel, self.interpolation),
        )
    }
}

/// The shadow boundary (critical curve) as an observer sees it, in the layout of the WGSL struct.
#[derive(Debug, Clone, Copy, PartialEq)]
#[repr(C)]
pub struct ShadowEdge {
    /// tan(θ_c/2)/σ: the factor between the row coordinate and cot(θ/2) straight away from the hole.
    pub tan_half: f32,
    /// (5/18) C/σ, the coefficient of (1−X) ln(1−X) relative to that of ln(1−X).
    pub log_weight: f32,
    /// dΔ/dX at X = 0, in the direction away from the hole.
    pub away_slope: f32,
    /// σ, which is 1 above the horizon.
    pub scale: f32,
}

impl ShadowEdge {
    /// The shadow boundary that `observer` sees.
    pub fn of(observer: &Observer) -> Self {
        let axis = Axis::Residual.of(observer);
        let scale = axis.edge_scale(observer);
        ShadowEdge {
            tan_half: (observer.tan_half_shadow() / scale) as f32,
            log_weight: axis.log_weight(observer) as f32,
            away_slope: (observer.bend_slope_away() * scale) as f32,
            scale: scale as f32,
        }
    }
}

/// A row in the form that is uploaded to a GPU.
///
/// ```
/// use lensbake_core::Observer;
/// use lensbake_tables::default_atlas;
/// use lensbake_tables::lookup::{self, GpuRow};
///
/// let observer = Observer::at(10.0).unwrap();
/// let row = GpuRow::new(&default_atlas().row(observer).unwrap());
/// assert_eq!(row.texture_bytes().len(), 512);
/// let shader = row.shape().wgsl(0, 1) + lookup::WGSL;
/// assert!(shader.contains("fn bending(c: f32, p: f32, edge: ShadowEdge) -> Bending"));
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct GpuRow {
    /// The shadow boundary, from which positions along the row are measured.
    pub edge: ShadowEdge,
    /// The texels as the shader reads them, rounded to the format; array of shape `[texels]`.
    pub texels: Vec<Texel>,
    /// Interpolation between the texels.
    pub interpolation: Interpolation,
    /// The side of the horizon that the observer is on.
    pub side: HorizonSide,
    /// Format of the texels.
    pub format: RowFormat,
}

impl GpuRow {
    /// `row` rounded to its format. The shader supports the residual axis only. Below the horizon the texels are in the order of
    /// falling q.
    pub fn new(row: &Row) -> Self {
        let mut texels = row.gpu_texels();
        let side = HorizonSide::of(row.observer());
        if side == HorizonSide::Below {
            texels.reverse();
            for texel in &mut texels {
                texel[1] = -texel[1];
            }
        }
        let format = row.format();
        GpuRow {
            edge: ShadowEdge::of(row.observer()),
            texels: texels.into_iter().map(|t| format.rounded(t)).collect(),
            interpolation: row.interpolation(),
            side,
            format,
        }
    }

    /// The shape that the shader must be specialised for.
    pub fn shape(&self) -> RowShape {
        RowShape {
            texels: self.texels.len() as u32,
            interpolation: self.interpolation,
            side: self.side,
            format: self.format,
        }
    }

    /// The bytes of the row's texture, line by line: values and slopes (`rg32float`), or the values alone
    /// (`r32float`) if the interpolation uses no slopes; in other formats as [`RowFormat`] says.
    pub fn texture_bytes(&self) -> Vec<u8> {
        let [width, height] = self.shape().texture_size();
        let texel = self.format.texel_bytes(self.interpolation);
        let mut bytes = self.format.bytes(&self.texels, self.interpolation);
        bytes.resize((width * height) as usize * texel, 0);
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_of_any_length_fits_into_its_texture() {
        for texels in [4, 64, ROW_LINE, ROW_LINE + 1, 1 << 16] {
            crate::header::check_texels(texels).unwrap();
            let shape = RowShape {
                texels,
                interpolation: Interpolation::Hermite,
                side: HorizonSide::Above,
                format: RowFormat::Float32,
            };
            let [width, height] = shape.texture_size();
            assert!(width <= ROW_LINE && height <= ROW_LINE);
            assert!(width * height >= texels && width * (height - 1) < texels);
        }
    }

    #[test]
    fn the_usual_row_is_loaded_as_it_is() {
        let shape = RowShape {
            texels: 64,
            interpolation: Interpolation::Hermite,
            side: HorizonSide::Above,
            format: RowFormat::Float32,
        };
        assert_eq!(
            shape.wgsl(0, 2),
            "const ROW_LAST: u32 = 63u;\n\
             @group(0) @binding(2) var row: texture_2d<f32>;\n\
             fn row_texel(i: u32) -> vec2<f32> { return textureLoad(row, vec2(i, 0u), 0).xy; }\n\
             fn interpolate(position: f32) -> vec2<f32> { return hermite(position); }\n"
        );
    }
}
