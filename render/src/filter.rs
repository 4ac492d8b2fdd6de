//! Filtered sampling: the light of a pixel averaged over its area. Reference of `shaders/filter.wgsl`.
//!
//! Away from the shadow's edge (the critical curve of the lens) a pixel takes one ray and averages the sky over
//! its footprint. Near the edge the footprint changes within the pixel (at δ pixels from the edge it is 1/δ rad
//! long, at any picture size) and infinitely many images of the sky crowd together. The part of such a pixel outside
//! the shadow is divided into 7 strips along the edge, each with one ray and its own footprint: within the pixel the
//! edge is straight, and its distance gives the area of each strip.
//!
//! An edge that is too curved for that, of a shadow of few pixels, and a picture with a disc take 3 × 3 patches in place
//! of the strips. The distance to the edge gives the part of a patch that lies in the shadow, and the ray goes through
//! the middle of the other part.

use crate::disc::coverage::positive_share;
use crate::disc::{Disc, SeenDisc};
use crate::footprint::Patch;
use crate::lens::{Deflected, Deflector, Lens, RAYS};
use crate::shadow::Shadow;
use crate::shift::Rendition;
use crate::sky::Sky;
use glam::{DVec2, DVec3, Vec3, Vec4};
use lensbake_core::RayOutcome;
use rayon::prelude::*;

/// Strips of a pixel near the shadow's edge.
pub(crate) const STRIPS: u32 = 7;
/// Patches along each side of a pixel near the shadow's edge where the edge is not straight.
pub(crate) const SUB_RAYS: u32 = 3;
/// Most taps along the long axis of a footprint, for the only ray of a pixel.
pub(crate) const MAX_TAPS: u32 = 16;
/// Most taps along the long axis of a footprint, for each ray of a pixel near the shadow's edge.
pub(crate) const MAX_TAPS_BESIDE_EDGE: u32 = 8;
/// A pixel takes several rays up to this distance outside the shadow's edge, in pixels.
pub(crate) const NEAR_OUTSIDE: f64 = 3.0;
/// A pixel takes several rays up to this distance inside the shadow's edge, in pixels.
pub(crate) const NEAR_INSIDE: f64 = 1.0;
/// Smallest radius of the shadow, or of the window of sky below the photon sphere, whose edge counts as straight within
/// a pixel, in pixels.
pub(crate) const STRAIGHT_EDGE: f64 = 16.0;

/// The work of the most expensive pixel of a tile, in ascending order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum TileClass {
    /// None: the pixels are in the shadow.
    Shadow,
    /// One bilinear tap: the sky is magnified.
    OneTap,
    /// One ray per pixel, with taps in the first mip level along its footprint.
    FirstLevel,
    /// One ray per pixel, with taps along its footprint.
    OneRay,
    /// Several rays for some pixels, which are near the shadow's edge.
    ManyRays,
}

impl TileClass {
    /// All classes, in ascending order.
    pub const ALL: [TileClass; 5] = [
        TileClass::Shadow,
        TileClass::OneTap,
        TileClass::FirstLevel,
        TileClass::OneRay,
        TileClass::ManyRays,
    ];
}

/// How a pixel is sampled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    /// In the shadow: black.
    Shadow,
    /// Near the shadow's edge: several rays.
    Edge,
    /// One ray, filtered over its footprint.
    Sky,
}

/// A part of a pixel near the shadow's edge that lies outside the shadow, and its share of the pixel's area.
#[derive(Debug, Clone, Copy)]
struct EdgePart {
    patch: Patch,
    share: f64,
}

/// The filtered pixels of the picture through a lens.
#[derive(Debug, Clone, Copy)]
pub struct FilteredPixels<'a> {
    lens: &'a Lens,
    rendition: Rendition,
    shadow: Shadow,
    disc: Option<SeenDisc<'a>>,
}

impl<'a> FilteredPixels<'a> {
    /// The filtered pixels of the picture through `lens`, in this rendition.
    pub fn new(lens: &'a Lens, rendition: Rendition) -> Self {
        FilteredPixels {
            lens,
            rendition,
            shadow: Shadow::of(lens),
            disc: None,
        }
    }

    /// The same pixels with a disc around the hole.
    pub fn with_disc(self, disc: Option<Disc>) -> Self {
        FilteredPixels {
            disc: disc.map(|disc| SeenDisc::new(self.lens, disc, self.rendition)),
            ..self
        }
    }

    /// The light of pixel (column, row) from `sky` and the disc. RGB is linear and premultiplied by alpha, the share of the
    /// pixel's area that sees the sky or the disc.
    pub fn light(&self, sky: &Sky, column: u32, row: u32) -> Vec4 {
        self.light_before(Some(sky), column, row)
    }

    /// The light of the pixels of a row from `first` on: as [`FilteredPixels::light`] of each, their rays deflected together.
    /// Calls `each` with the index and the light of every one of `count` pixels, at most [`RAYS`].
    pub(crate) fn lights(
        &self,
        deflector: &Deflector,
        sky: &Sky,
        [first, row]: [u32; 2],
        count: u32,
        mut each: impl FnMut(usize, Vec4),
    ) {
        let at = |i: usize| self.lens.camera.position(first + i as u32, row);
        let mut patches = [self.patch(at(0), 1.0); RAYS];
        let mut angles = [patches[0].view_angle; RAYS];
        let rest = patches.iter_mut().zip(&mut angles).enumerate();
        for (i, (patch, angle)) in rest.take(count as usize).skip(1) {
            *patch = self.patch(at(i), 1.0);
            *angle = patch.view_angle;
        }
        deflector.deflect(&angles[..count as usize], |i, outcome| {
            let whole = &patches[i];
            let light = match self.kind(whole) {
                Kind::Shadow => self.behind_inward(whole, Vec4::ZERO),
                Kind::Sky => self.light_of_deflected(Some(sky), whole, outcome),
                Kind::Edge => self.edge_light(Some(sky), at(i)),
            };
            each(i, light);
        });
    }

    /// The share of the light behind the disc that pixel (column, row) gets, 0 to 1.
    pub fn through_disc(&self, column: u32, row: u32) -> f32 {
        1.0 - self.light_before(None, column, row).w
    }

    /// The light of a pixel from the sky, if any, and the disc.
    fn light_before(&self, sky: Option<&Sky>, column: u32, row: u32) -> Vec4 {
        let at = self.lens.camera.position(column, row);
        let whole = self.patch(at, 1.0);
        match self.kind(&whole) {
            Kind::Shadow => self.behind_inward(&whole, Vec4::ZERO),
            Kind::Sky => self.light_of(sky, &whole),
            Kind::Edge => self.edge_light(sky, at),
        }
    }

    /// The share of the area of pixel (column, row) that sees the sky, 0 to 1; a disc does not matter.
    pub fn sky_share(&self, column: u32, row: u32) -> f64 {
        let at = self.lens.camera.position(column, row);
        match self.kind(&self.patch(at, 1.0)) {
            Kind::Shadow => 0.0,
            Kind::Sky => 1.0,
            Kind::Edge => {
                let without_disc = FilteredPixels {
                    disc: None,
                    ..*self
                };
                let parts = without_disc.edge_parts(at);
                parts.iter().map(|part| part.share).sum()
            }
        }
    }

    /// Signed distance of the centre of pixel (column, row) from the shadow's edge, in pixels, positive outside.
    pub fn edge_distance(&self, column: u32, row: u32) -> f64 {
        let whole = self.patch(self.lens.camera.position(column, row), 1.0);
        self.shadow.distance(whole.view_angle) / whole.gradient()
    }

    /// Number of rays of pixel (column, row) beyond the first.
    pub fn extra_rays(&self, column: u32, row: u32) -> u32 {
        let at = self.lens.camera.position(column, row);
        let whole = self.patch(at, 1.0);
        match self.kind(&whole) {
            Kind::Edge if self.edge_is_straight(&whole) => STRIPS - 1,
            Kind::Edge => SUB_RAYS * SUB_RAYS - 1,
            Kind::Shadow | Kind::Sky => 0,
        }
    }

    /// Number of rays of all pixels of the picture beyond one per pixel.
    pub fn extra_rays_in_all(&self) -> u64 {
        let camera = &self.lens.camera;
        let of_row = |row| -> u64 {
            let pixels = (0..camera.width).map(|column| u64::from(self.extra_rays(column, row)));
            pixels.sum()
        };
        (0..camera.height).into_par_iter().map(of_row).sum()
    }

    /// The tile class that pixel (column, row) alone needs, with a sky of `face_texels`.
    #[cfg(test)]
    pub(crate) fn class_of(&self, column: u32, row: u32, face_texels: f64) -> TileClass {
        let patch = self.patch(self.lens.camera.position(column, row), 1.0);
        match (self.kind(&patch), self.lens.deflect(patch.view_angle)) {
            (Kind::Edge, _) => TileClass::ManyRays,
            (Kind::Sky, RayOutcome::Escapes(deflected)) => {
                let footprint = patch
                    .footprint(deflected)
                    .in_frame(&self.lens.camera.sky_from_hole);
                let taps = footprint.taps(face_texels, MAX_TAPS);
                match (taps.level, taps.count) {
                    (0.0, 1) => TileClass::OneTap,
                    (0.0, _) => TileClass::FirstLevel,
                    _ => TileClass::OneRay,
                }
            }
            _ => TileClass::Shadow,
        }
    }

    /// The square patch with sides of `side` pixels, centred on `at`, in pixels from the centre of the picture.
    fn patch(&self, at: DVec2, side: f64) -> Patch {
        Patch::seen_by(&self.lens.camera, at, side)
    }

    fn kind(&self, pixel: &Patch) -> Kind {
        let (distance, px) = (self.shadow.distance(pixel.view_angle), pixel.gradient());
        if distance < -NEAR_INSIDE * px {
            Kind::Shadow
        } else if distance < NEAR_OUTSIDE * px {
            Kind::Edge
        } else {
            Kind::Sky
        }
    }

    /// Whether the pixel is divided into strips along the shadow's edge. A disc needs patches: its own edges cross them.
    fn edge_is_straight(&self, whole: &Patch) -> bool {
        let radius = 2.0 * self.shadow.half_sin.min(self.shadow.half_cos);
        self.disc.is_none() && radius >= STRAIGHT_EDGE * whole.gradient()
    }

    /// The parts of the pixel at `at` outside the shadow.
    fn edge_parts(&self, at: DVec2) -> Vec<EdgePart> {
        let whole = self.patch(at, 1.0);
        let mut parts = if self.edge_is_straight(&whole) {
            self.strips(&whole)
        } else {
            self.squares(at)
        };
        parts.retain(|part| part.share > 0.0);
        parts
    }

    /// The strips along the edge, equally wide, of the part of a pixel outside it.
    fn strips(&self, whole: &Patch) -> Vec<EdgePart> {
        let px = whole.gradient();
        let across = DVec2::new(whole.right.x, whole.down.x) / px;
        let reach = 0.5 * (across.x.abs() + across.y.abs());
        let edge = (-self.shadow.distance(whole.view_angle) / px).clamp(-reach, reach);
        let width = (reach - edge) / f64::from(STRIPS);
        let strip = |i: u32| {
            let from = edge + f64::from(i) * width;
            let before = |distance| positive_share(distance, across.x, across.y);
            EdgePart {
                patch: whole.moved((from + 0.5 * width) * px, width),
                share: before(from + width) - before(from),
            }
        };
        (0..STRIPS).map(strip).collect()
    }

    /// The parts outside the shadow of the 3 × 3 patches of the pixel at `at`.
    fn squares(&self, at: DVec2) -> Vec<EdgePart> {
        let side = 1.0 / f64::from(SUB_RAYS);
        let offset = |i: u32| (f64::from(i) + 0.5) * side - 0.5;
        let square = |i: u32| {
            let offset = DVec2::new(offset(i % SUB_RAYS), offset(i / SUB_RAYS));
            let patch = self.patch(at + offset, side);
            let (distance, px) = (self.shadow.distance(patch.view_angle), patch.gradient());
            let part = self.shadow.sky_part(distance, px);
            EdgePart {
                patch: patch.moved(part.shift * px, part.extent),
                share: part.covered * side * side,
            }
        };
        (0..SUB_RAYS * SUB_RAYS).map(square).collect()
    }

    fn edge_light(&self, sky: Option<&Sky>, at: DVec2) -> Vec4 {
        let parts = self.edge_parts(at);
        let lights = parts
            .iter()
            .map(|part| part.share as f32 * self.outside_light(sky, &part.patch));
        // What is before the periapsis changes little within a pixel, also across the edge.
        self.behind_inward(&self.patch(at, 1.0), lights.sum())
    }

    /// `light` with what the disc adds and hides before the periapsis of the rays of `patch`.
    fn behind_inward(&self, patch: &Patch, light: Vec4) -> Vec4 {
        match &self.disc {
            Some(disc) => disc.in_front(disc.inward(patch), light),
            None => light,
        }
    }

    /// The mean light over a patch away from the shadow's edge.
    fn light_of(&self, sky: Option<&Sky>, patch: &Patch) -> Vec4 {
        self.light_of_deflected(sky, patch, self.lens.deflect(patch.view_angle))
    }

    /// As [`FilteredPixels::light_of`], with the outcome of the ray.
    fn light_of_deflected(
        &self,
        sky: Option<&Sky>,
        patch: &Patch,
        outcome: RayOutcome<Deflected>,
    ) -> Vec4 {
        let RayOutcome::Escapes(deflected) = outcome else {
            return Vec4::ZERO;
        };
        let light = self.sky_light(sky, patch, deflected, MAX_TAPS);
        match &self.disc {
            Some(disc) => {
                let hits = [disc.inward(patch), disc.outward(patch, deflected)];
                disc.both_in_front(hits, light)
            }
            None => light,
        }
    }

    /// The mean light that a patch beside the shadow's edge and outside the shadow gets from beyond the periapsis of its
    /// rays; 0 if its ray is captured.
    fn outside_light(&self, sky: Option<&Sky>, patch: &Patch) -> Vec4 {
        let RayOutcome::Escapes(deflected) = self.lens.deflect(patch.view_angle) else {
            return Vec4::ZERO;
        };
        let light = self.sky_light(sky, patch, deflected, MAX_TAPS_BESIDE_EDGE);
        match &self.disc {
            Some(disc) => disc.in_front(disc.outward(patch, deflected), light),
            None => light,
        }
    }

    /// The mean light of the sky over a patch that sees only sky, with alpha 1; 0 without a sky.
    fn sky_light(
        &self,
        sky: Option<&Sky>,
        patch: &Patch,
        deflected: Deflected,
        most_taps: u32,
    ) -> Vec4 {
        let Some(sky) = sky else {
            return Vec4::ZERO;
        };
        let sky_from_hole = &self.lens.camera.sky_from_hole;
        let (on_sky, face_texels) = (*sky_from_hole * patch.on_sky(deflected), sky.face_texels());
        let light = if patch.is_magnified(deflected, on_sky, face_texels.into()) {
            sky.sample(on_sky.as_vec3())
        } else {
            let footprint = patch.footprint(deflected).in_frame(sky_from_hole);
            let taps = footprint.taps(face_texels.into(), most_taps);
            let sample =
                |direction: DVec3| sky.sample_level(direction.as_vec3(), taps.level as f32);
            let sum: Vec3 = taps.directions(footprint.direction).map(sample).sum();
            sum / taps.count as f32
        };
        let shift = || self.lens.frequency_shift(patch.direction);
        self.rendition.seen(light, shift).extend(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::{Camera, View};
    use crate::lens::Deflection;
    use lensbake_tables::default_atlas;
    use std::f64::consts::PI;

    const SIDE: u32 = 41;

    fn lens(view: View, method: Deflection) -> Lens {
        Lens::new(Camera::new(&view).unwrap(), default_atlas(), method).unwrap()
    }

    /// A view of the smaller disc (the shadow, or the window of sky below the photon sphere): its radius is
    /// `pixels`, and it is off centre by a fraction of a pixel.
    fn disc_view(radius: f64, pixels: f64) -> View {
        let edge = Camera::new(&View {
            radius,
            ..View::default()
        })
        .unwrap()
        .observer
        .shadow_angle();
        let (disc, yaw_deg) = if edge < PI / 2.0 {
            (edge, 0.0)
        } else {
            (PI - edge, 180.0)
        };
        let px = disc.tan() / pixels;
        View {
            radius,
            yaw_deg: yaw_deg + (0.31 * px).to_degrees(),
            pitch_deg: (0.17 * px).to_degrees(),
            roll_deg: 30.0,
            fov_deg: 2.0 * (0.5 * f64::from(SIDE) * px).atan().to_degrees(),
            width: SIDE,
            height: SIDE,
            ..View::default()
        }
    }

    /// With a white sky, the dark area is the shadow's area to a fraction of a pixel, whatever its size. The
    /// bright area likewise is that of the window of a camera near the horizon.
    #[test]
    fn the_edge_covers_what_it_should() {
        let white = Sky::from_fn(1, |_| Vec3::ONE);
        let mut checked = 0;
        for radius in [1.000001, 1.0001, 1000.0, 1e6] {
            for pixels in [0.2, 0.5, 1.1, 4.3, 15.0] {
                let lens = lens(disc_view(radius, pixels), Deflection::Lut);
                let edge = lens.camera.observer.shadow_angle();
                let all = FilteredPixels::new(&lens, Rendition::default());
                let sum: f64 = (0..SIDE * SIDE)
                    .map(|i| (i % SIDE, i / SIDE))
                    .map(|(x, y)| {
                        let light = all.light(&white, x, y);
                        let share = all.sky_share(x, y) as f32;
                        assert!((light.x - light.w).abs() < 1e-5, "{light}");
                        assert!((light.w - share).abs() < 1e-5, "{light} {share}");
                        f64::from(if edge < PI / 2.0 {
                            1.0 - light.w
                        } else {
                            light.w
                        })
                    })
                    .sum();
                let area = PI * pixels * pixels;
                let allowed = 0.001 * area + 0.035;
                assert!(
                    (sum - area).abs() < allowed,
                    "r {radius}, {pixels} px: {sum} for {area}"
                );
                checked += 1;
            }
        }
        assert_eq!(checked, 20);
    }

    /// The dark area without deflection is that of the plain sphere.
    #[test]
    fn the_edge_of_the_plain_sphere_is_covered_too() {
        let view = View {
            radius: 4.0,
            fov_deg: 60.0,
            width: 64,
            height: 36,
            ..View::default()
        };
        let lens = lens(view, Deflection::Flat);
        let white = Sky::from_fn(1, |_| Vec3::ONE);
        let pixels = FilteredPixels::new(&lens, Rendition::default());
        let dark: f64 = (0..64 * 36)
            .map(|i| 1.0 - f64::from(pixels.light(&white, i % 64, i / 64).w))
            .sum();
        // sin θ = 1/4: tan θ = 1/√15, and 32 px are tan 30°.
        let radius = 32.0 * 3f64.sqrt() / 15f64.sqrt();
        assert!((dark - PI * radius * radius).abs() < 0.3, "{dark}");
    }
}
