//! A disc as a camera sees it: where the rays of a patch of the picture meet it, and the light that they bring.

use super::leg::{AxisInPlane, Crossing, End, Leg, Varying};
use super::pattern::{Pattern, Spot};
use super::{Disc, Rim};
use crate::camera::ViewAngle;
use crate::footprint::Patch;
use crate::lens::{Deflected, Deflection, Lens};
use crate::shadow::Shadow;
use crate::shift::{Rendition, Shift};
use glam::{DVec2, DVec3, Vec4};
use lensbake_core::accretion::emitted_frequency;
use lensbake_core::{RayOutcome, orbit};
use std::f64::consts::{PI, TAU};

/// A disc, seen through a lens.
#[derive(Debug, Clone, Copy)]
pub struct SeenDisc<'a> {
    lens: &'a Lens,
    disc: Disc,
    /// Unit vector of its axis in the hole frame.
    axis: DVec3,
    inner: Rim,
    outer: Rim,
    shadow: Shadow,
    /// Factor of its light.
    scale: f32,
    /// Its pattern, if it has one, and the unit vector towards its azimuth 0 in the hole frame.
    pattern: Option<(Pattern, DVec3)>,
}

/// Where rays meet the disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hit {
    /// The share of the patch in which they do.
    pub share: f64,
    /// Radius, units of r_s.
    pub radius: f64,
    /// ν_obs/ν_em.
    pub shift: f64,
    /// If the leg ends at the periapsis: the shares of the patch in which its other end and the periapsis are above the
    /// plane of the disc. There the two legs of a ray exclude each other in part.
    pub(crate) at_periapsis: Option<[f64; 2]>,
    /// Factor of the light by the pattern of the disc; 1 without one.
    pub pattern: f64,
    /// Image order: the number of half turns of the orbital angle between the observer and the disc, 0 for the direct
    /// image.
    pub order: u32,
}

/// What a ray needs to know of its orbit.
struct Orbit {
    /// 1/b² and its derivative by the view angle.
    inv_b_sq: Varying,
    /// Whether it leaves the observer inwards.
    inwards: bool,
    /// b/p = 1/(u z), with z the redshift factor and p = sin θ.
    by_sine: f64,
}

impl<'a> SeenDisc<'a> {
    /// The disc of a scene through `lens`, in this rendition of its sky.
    pub fn new(lens: &'a Lens, disc: Disc, rendition: Rendition) -> Self {
        let rim = |radius| rim_of(lens.deflection, radius);
        SeenDisc {
            lens,
            disc,
            axis: lens.camera.sky_from_hole.transpose() * disc.orientation.axis(),
            inner: rim(disc.inner),
            outer: rim(disc.outer),
            shadow: Shadow::of(lens),
            scale: match rendition.shift {
                Shift::Off => 1.0,
                Shift::Brightness | Shift::Colour => rendition.light_scale,
            },
            pattern: (disc.pattern > 0.0).then(|| {
                let hole_from_sky = lens.camera.sky_from_hole.transpose();
                (
                    Pattern::at(disc.pattern, disc.time),
                    hole_from_sky * disc.orientation.node(),
                )
            }),
        }
    }

    /// The pattern, if there is one, and the unit vector towards the azimuth 0 in the hole frame.
    pub(crate) fn pattern(&self) -> Option<(Pattern, DVec3)> {
        self.pattern
    }

    /// Unit vector of its axis in the hole frame.
    pub fn axis(&self) -> DVec3 {
        self.axis
    }

    /// Factor of its light.
    pub(crate) fn scale(&self) -> f32 {
        self.scale
    }

    /// The circle on which the observer is, as a rim; `None` within the inner rim.
    pub(crate) fn observer_circle(&self) -> Option<Rim> {
        let u = self.lens.camera.observer.inverse_radius();
        (u < self.inner.u).then(|| rim_of(self.lens.deflection, 1.0 / u))
    }

    /// The inner and the outer rim.
    pub fn rims(&self) -> [Rim; 2] {
        [self.inner, self.outer]
    }

    /// The light `behind` with the light of `hit` in front of it, both premultiplied by their alpha.
    pub fn in_front(&self, hit: Option<Hit>, behind: Vec4) -> Vec4 {
        self.both_in_front([hit, None], behind)
    }

    /// The light `behind` with the light of the two `hits` of a patch in front of it, the nearer first.
    pub fn both_in_front(&self, [inward, outward]: [Option<Hit>; 2], behind: Vec4) -> Vec4 {
        let opacity = self.disc.opacity;
        let share = |hit: Option<Hit>| hit.map_or(0.0, |hit| hit.share);
        // The share of the patch in which the outward hit is seen, and the share of what is behind both.
        let (seen, through) = match [inward, outward].map(|hit| hit?.at_periapsis) {
            [Some([above_in, above]), Some([above_out, _])] => {
                // Where the periapsis is above the plane, a leg crosses it whose far end is below, and the reverse.
                let part = |share: f64, inward: f64, outward: f64| {
                    let left = share * (1.0 - opacity * inward);
                    (left * outward, left * (1.0 - opacity * outward))
                };
                let (one, other) = (
                    part(above, 1.0 - above_in, 1.0 - above_out),
                    part(1.0 - above, above_in, above_out),
                );
                (one.0 + other.0, one.1 + other.1)
            }
            _ => {
                let left = 1.0 - opacity * share(inward);
                (
                    left * share(outward),
                    left * (1.0 - opacity * share(outward)),
                )
            }
        };
        let light = |hit: Option<Hit>, share: f64| {
            hit.map_or(Vec4::ZERO, |hit| {
                let light =
                    self.disc.light(hit.radius, hit.shift) * self.scale * hit.pattern as f32;
                light.extend(1.0) * (opacity * share) as f32
            })
        };
        light(inward, share(inward)) + light(outward, seen) + behind * through as f32
    }

    /// The light `behind` with the disc in front of it, in the unit view `direction` of the camera.
    pub fn before(&self, direction: DVec3, behind: Vec4) -> Vec4 {
        self.both_in_front(self.hits(&self.ray(direction)), behind)
    }

    /// Where the ray in the unit view `direction` of the camera meets the disc first.
    pub fn nearest_hit(&self, direction: DVec3) -> Option<Hit> {
        self.hits(&self.ray(direction)).into_iter().flatten().next()
    }

    /// Where the rays of `patch` meet the disc, the nearer place first.
    pub fn hits(&self, patch: &Patch) -> [Option<Hit>; 2] {
        let outward = match self.lens.deflect(patch.view_angle) {
            RayOutcome::Escapes(deflected) => self.outward(patch, deflected),
            RayOutcome::Captured => None,
        };
        [self.inward(patch), outward]
    }

    /// The patch without extent in the unit view `direction` of the camera.
    fn ray(&self, direction: DVec3) -> Patch {
        let (seen, _) = self.lens.camera.unboosted(direction);
        Patch::new(seen, DVec3::ZERO, DVec3::ZERO)
    }

    /// Where the rays of `patch` meet the disc on their way towards the hole, before their periapsis; also those that the
    /// hole captures.
    pub fn inward(&self, patch: &Patch) -> Option<Hit> {
        let u = self.lens.camera.observer.inverse_radius();
        let orbit = self.orbit(patch.view_angle);
        if !orbit.inwards || u >= self.inner.u {
            return None;
        }
        let least = self.least_speed_sq(&orbit, patch);
        let behind = self.opposite(patch.view_angle)?;
        let far = if u >= self.outer.u {
            self.at_observer(&behind, patch)
        } else {
            self.at_rim(&self.outer, &orbit, least)?
        };
        let near = match self.at_rim(&self.inner, &orbit, least) {
            Some(rim) => rim,
            None => End::Periapsis(periapsis(&self.leaving(patch.view_angle)?, &behind)),
        };
        let axis = self.axis_in_plane(patch);
        let leg = Leg {
            sky: behind.sky,
            turn: behind.turn,
            axis: AxisInPlane {
                aside: -axis.aside,
                across: -axis.across,
                ..axis
            },
            far,
            near,
        };
        let crossing = leg.crossing(patch, None)?;
        let angle = (crossing.phase - behind.phase()).max(0.0);
        Some(self.hit(crossing, &leg, &orbit, patch, (-1.0, angle)))
    }

    /// Where the rays of `patch` meet the disc on their way out to the sky, after their periapsis. `deflected` is where
    /// they come from.
    pub fn outward(&self, patch: &Patch, deflected: Deflected) -> Option<Hit> {
        let u = self.lens.camera.observer.inverse_radius();
        let orbit = self.orbit(patch.view_angle);
        if !orbit.inwards && u <= self.outer.u {
            return None;
        }
        let least = self.least_speed_sq(&orbit, patch);
        let ray = leaving(deflected);
        let far = self.at_rim(&self.outer, &orbit, least)?;
        let near = if !orbit.inwards && u <= self.inner.u {
            self.at_observer(&ray, patch)
        } else {
            match self.at_rim(&self.inner, &orbit, least) {
                Some(rim) => rim,
                None => End::Periapsis(periapsis(&ray, &self.opposite(patch.view_angle)?)),
            }
        };
        let leg = Leg {
            sky: ray.sky,
            turn: ray.turn,
            axis: self.axis_in_plane(patch),
            far,
            near,
        };
        let from_shadow = self
            .shadow
            .distance(patch.view_angle)
            .max(f64::MIN_POSITIVE);
        let crossing = leg.crossing(patch, Some(from_shadow))?;
        let total = PI - patch.view_angle.radians() + deflected.bend;
        let angle = (total - crossing.phase).max(0.0);
        Some(self.hit(crossing, &leg, &orbit, patch, (1.0, angle)))
    }

    /// u of the ray with 1/b = `inv_b` at `phase`.
    fn inverse_radius(&self, inv_b: f64, phase: f64) -> f64 {
        match self.lens.deflection {
            Deflection::Lut | Deflection::Direct { .. } => orbit::inverse_radius(inv_b, phase),
            Deflection::Flat => inv_b * phase.sin(),
        }
    }

    /// The hit at the orbital angle `angle` from the observer. The leg's unit vector e is `side` times that towards the view
    /// direction.
    fn hit(
        &self,
        crossing: Crossing,
        leg: &Leg,
        orbit: &Orbit,
        patch: &Patch,
        (side, angle): (f64, f64),
    ) -> Hit {
        let u = self.inverse_radius(orbit.inv_b_sq.value.sqrt(), crossing.phase);
        let radius = 1.0 / u.clamp(self.outer.u, self.inner.u);
        // b (e × Z) · axis.
        let momentum =
            (patch.direction.y * self.axis.x - patch.direction.x * self.axis.y) * orbit.by_sine;
        Hit {
            share: crossing.share,
            at_periapsis: matches!(leg.near, End::Periapsis(_)).then_some(crossing.above),
            radius,
            shift: self.lens.frequency_shift(patch.direction) / emitted_frequency(radius, momentum),
            pattern: self.pattern.map_or(1.0, |(pattern, node)| {
                let at = leg.direction(crossing.phase);
                let e = DVec2::new(patch.tangential.y, -patch.tangential.x) * side;
                let point = (e * at.y).extend(at.x);
                let ahead = self.axis.cross(node);
                pattern.factor(&Spot {
                    radius,
                    azimuth: point.dot(ahead).atan2(point.dot(node)),
                    steps: self.steps(crossing.phase, leg, orbit, patch),
                })
            }),
            order: (angle / PI) as u32,
        }
    }

    /// How (ln r, azimuth) on the disc change across `patch`, to the right and downwards.
    ///
    /// The angle φ at which a ray's plane meets the disc depends on the azimuth χ of that plane alone: out cos φ + aside
    /// sin φ = 0 gives dφ/dχ, and the azimuth on the disc changes by −sin φ dχ/(aside cos φ − out sin φ). The phase changes
    /// with φ_∞, and ln r with the phase and 1/b; these two by differences of 1 %.
    fn steps(&self, phase: f64, leg: &Leg, orbit: &Orbit, patch: &Patch) -> [DVec2; 2] {
        let at = leg.direction(phase);
        let AxisInPlane { out, aside, across } = leg.axis;
        let speed = aside * at.x - out * at.y;
        let speed = speed.abs().max(1e-6).copysign(speed);
        let inv_b = orbit.inv_b_sq.value.sqrt();
        let u = self.inverse_radius(inv_b, phase);
        let by_inv_b = (self.inverse_radius(1.01 * inv_b, phase) / u - 1.0) / 0.01;
        let by_phase = (1.0 - self.inverse_radius(inv_b, 0.99 * phase) / u) / (0.01 * phase);
        let relative = 0.5 * orbit.inv_b_sq.slope / orbit.inv_b_sq.value;
        let radial = DVec2::new(-(by_inv_b * relative + by_phase * leg.turn), 0.0);
        let tangential = DVec2::new(-by_phase * across, -1.0)
            * (at.y / (speed * patch.view_angle.sin.max(1e-12)));
        [patch.right, patch.down].map(|step| radial * step.x + tangential * step.y)
    }

    /// The redshift factors of the observer, in the direction of the hole and straight away; 1 without bending.
    fn redshifts(&self) -> [f64; 2] {
        match self.lens.deflection {
            Deflection::Lut | Deflection::Direct { .. } => self.lens.camera.observer.redshifts(),
            Deflection::Flat => [1.0; 2],
        }
    }

    fn orbit(&self, angle: ViewAngle) -> Orbit {
        let observer = &self.lens.camera.observer;
        let u = observer.inverse_radius();
        let (cos, sin) = (angle.cos, angle.sin.max(1e-12));
        let [z_in, z_out] = self.redshifts();
        // z = z_in cos²(θ/2) + z_out sin²(θ/2), and 1/b = u z / sin θ.
        let (towards, away) = (0.5 * z_in * (1.0 + cos), 0.5 * z_out * (1.0 - cos));
        let redshift = towards + away;
        let inv_b = u * redshift / sin;
        let slope = u * (0.5 * (z_out - z_in) - redshift * cos / (sin * sin));
        Orbit {
            inv_b_sq: Varying {
                value: inv_b * inv_b,
                slope: 2.0 * inv_b * slope,
            },
            inwards: towards > away,
            by_sine: 1.0 / (u * redshift),
        }
    }

    /// The least m² of the slope of a rim's phase: where a ray has its periapsis at a rim, the phase changes like a square
    /// root, which a patch does not resolve.
    fn least_speed_sq(&self, orbit: &Orbit, patch: &Patch) -> f64 {
        0.25 * orbit.inv_b_sq.slope.abs() * patch.gradient()
    }

    fn at_rim(&self, rim: &Rim, orbit: &Orbit, least_speed_sq: f64) -> Option<End> {
        let reached = rim.reached(orbit.inv_b_sq.value, least_speed_sq)?;
        Some(End::Rim(Varying {
            value: reached.phase,
            slope: reached.slope * orbit.inv_b_sq.slope,
        }))
    }

    /// The end of a leg at the observer, from where `ray` leaves for the sky.
    fn at_observer(&self, ray: &Leaving, patch: &Patch) -> End {
        End::Observer {
            phase: ray.phase(),
            ahead: self.axis_in_plane(patch).aside,
        }
    }

    /// The axis of the disc in the plane of the ray through the middle of `patch`.
    fn axis_in_plane(&self, patch: &Patch) -> AxisInPlane {
        let e = DVec2::new(patch.tangential.y, -patch.tangential.x);
        AxisInPlane {
            out: self.axis.z,
            aside: self.axis.truncate().dot(e),
            across: self.axis.dot(patch.tangential),
        }
    }

    /// The ray at this view angle, if it escapes.
    fn leaving(&self, angle: ViewAngle) -> Option<Leaving> {
        self.lens.deflect(angle).escaped().map(leaving)
    }

    /// The ray that leaves the observer opposite to the one at this view angle, in the frame of the observer at rest.
    fn opposite(&self, angle: ViewAngle) -> Option<Leaving> {
        let [z_in, z_out] = self.redshifts();
        // tan(θ′/2) = (z_in/z_out) cot(θ/2).
        let ratio = z_in / z_out;
        let (ahead, behind) = (ratio * ratio * (1.0 + angle.cos), 1.0 - angle.cos);
        let opposite = ViewAngle {
            cos: (behind - ahead) / (ahead + behind),
            sin: 2.0 * ratio * angle.sin / (ahead + behind),
        };
        let RayOutcome::Escapes(deflected) = self.lens.deflect(opposite) else {
            return None;
        };
        let ray = leaving(deflected);
        // dθ′/dθ = −sin θ′/sin θ.
        Some(Leaving {
            turn: -ray.turn * opposite.sin / angle.sin.max(1e-12),
            ..ray
        })
    }
}

/// A ray that leaves the observer for the sky.
struct Leaving {
    /// (cos φ_∞, sin φ_∞).
    sky: DVec2,
    /// dφ_∞/dθ.
    turn: f64,
}

/// The rim of radius `radius` as this deflection method bends the rays that reach it.
fn rim_of(deflection: Deflection, radius: f64) -> Rim {
    match deflection {
        Deflection::Lut | Deflection::Direct { .. } => Rim::bent(radius),
        Deflection::Flat => Rim::straight(radius),
    }
}

impl Leaving {
    /// φ_∞ in [0, 2π), rad: the phase of the observer.
    fn phase(&self) -> f64 {
        self.sky.y.atan2(self.sky.x).rem_euclid(TAU)
    }
}

/// φ_∞ = π − θ_sky.
fn leaving(deflected: Deflected) -> Leaving {
    Leaving {
        sky: DVec2::new(-deflected.sky.cos, deflected.sky.sin),
        turn: -deflected.radial,
    }
}

/// The phase of the periapsis: half of the angle between the two ends of the path.
fn periapsis(ray: &Leaving, opposite: &Leaving) -> Varying {
    let whole = DVec2::new(
        ray.sky.x * opposite.sky.x - ray.sky.y * opposite.sky.y,
        ray.sky.y * opposite.sky.x + ray.sky.x * opposite.sky.y,
    );
    Varying {
        value: 0.5 * whole.y.atan2(whole.x).rem_euclid(TAU),
        slope: 0.5 * (ray.turn + opposite.turn),
    }
}
