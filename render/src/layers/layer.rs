//! The layers by name.

/// A layer. All of its values are finite. Those of the sky do not depend on a disc, and are 0 where the ray through the
/// pixel's centre is captured, except for [`Layer::Captured`]. Those of the disc are 0 where that ray does not meet it,
/// except for [`Layer::DiscAlpha`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Layer {
    /// The unit direction on the sky that the ray through the pixel's centre comes from, in the sky frame: X, Y, Z.
    Direction,
    /// The frequency ratio ν_obs/ν_∞ of that light.
    Shift,
    /// The magnification: the pixel's solid angle divided by that of its source on the sky, negative where the image is
    /// mirrored; see [`crate::lens::Jacobian::magnification`].
    Magnification,
    /// The image order: how often the light crosses the axis through the camera and the hole; see
    /// [`half_windings`](crate::stars::images::ImageOrder::half_windings).
    Order,
    /// The place of that direction in a panorama: U, V; see [`panorama_uv`](super::panorama_uv).
    Uv,
    /// How much of the pixel shows no sky, because it lies in the shadow or outside the disc of a fisheye: the share of its
    /// area if the picture shows the mean over it, else 1 or 0 at its centre.
    Captured,
    /// The radius, in units of r_s, at which the ray through the pixel's centre meets the disc first, seen from the camera.
    DiscRadius,
    /// The image order of the disc there: how many half turns around the hole its light makes; see [`Hit::order`](crate::disc::Hit::order).
    DiscOrder,
    /// The frequency ratio ν_obs/ν_em of its light from there.
    DiscShift,
    /// How much of the light behind the disc the pixel does not show, both crossings included: the mean over its area if
    /// the picture shows that, else at its centre. An opaque disc has 1 where it fills the pixel.
    DiscAlpha,
}

impl Layer {
    /// All layers.
    pub const ALL: [Layer; 10] = [
        Layer::Direction,
        Layer::Shift,
        Layer::Magnification,
        Layer::Order,
        Layer::Uv,
        Layer::Captured,
        Layer::DiscRadius,
        Layer::DiscOrder,
        Layer::DiscShift,
        Layer::DiscAlpha,
    ];

    /// Whether it is a layer of the disc, which is 0 everywhere without one.
    pub fn is_of_disc(self) -> bool {
        match self {
            Layer::Direction
            | Layer::Shift
            | Layer::Magnification
            | Layer::Order
            | Layer::Uv
            | Layer::Captured => false,
            Layer::DiscRadius | Layer::DiscOrder | Layer::DiscShift | Layer::DiscAlpha => true,
        }
    }

    /// Its name, the first part of the names of its channels.
    pub fn name(self) -> &'static str {
        match self {
            Layer::Direction => "direction",
            Layer::Shift => "shift",
            Layer::Magnification => "magnification",
            Layer::Order => "order",
            Layer::Uv => "uv",
            Layer::Captured => "captured",
            Layer::DiscRadius => "disc_radius",
            Layer::DiscOrder => "disc_order",
            Layer::DiscShift => "disc_shift",
            Layer::DiscAlpha => "disc_alpha",
        }
    }

    /// Its components, the last part of the names of its channels. One letter each, because Blender takes no others; V
    /// for a single value; never R, G, B or A, which tinyexr would take for the picture.
    pub fn components(self) -> &'static [&'static str] {
        match self {
            Layer::Direction => &["X", "Y", "Z"],
            Layer::Uv => &["U", "V"],
            Layer::Shift
            | Layer::Magnification
            | Layer::Order
            | Layer::Captured
            | Layer::DiscRadius
            | Layer::DiscOrder
            | Layer::DiscShift
            | Layer::DiscAlpha => &["V"],
        }
    }
}
