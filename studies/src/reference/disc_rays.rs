//! A scene with a disc, ray by ray. Nothing is shared with the renderer's disc but the description of it: every ray is
//! integrated, every crossing of the disc's plane is looked at, and the light there follows from its definition.

use super::disc_orbit::{End, Orbit};
use glam::{DVec3, Vec3};
use lensbake_core::accretion;
use lensbake_render::camera::{Camera, ViewAngle};
use lensbake_render::cpu;
use lensbake_render::disc::Disc;
use lensbake_render::picture::Picture;
use lensbake_render::scene::Scene;
use lensbake_render::shift::Shift;
use std::f64::consts::PI;

/// The rays of a scene with a disc.
#[derive(Debug, Clone, Copy)]
struct DiscRays<'a> {
    scene: &'a Scene,
    disc: &'a Disc,
    /// The disc's axis in the hole frame.
    normal: DVec3,
}

/// The light of a ray.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Traced {
    /// Linear RGB.
    light: Vec3,
    /// How often the ray meets the disc.
    hits: u32,
}

/// A pixel of the reference.
#[derive(Debug, Clone, Copy, PartialEq)]
struct ReferencePixel {
    /// Mean light of its rays, linear RGB.
    light: [f32; 3],
    /// Whether some of its rays meet the disc more often than others: it lies on a rim of the disc.
    on_rim: bool,
}

/// A picture of a scene with a disc by many rays per pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct DiscReference {
    /// The picture.
    pub picture: Picture,
    /// Whether a pixel lies on a rim of the disc, row-major.
    pub on_rim: Vec<bool>,
}

impl DiscReference {
    /// The reference of `scene` with `disc`, whatever disc it has itself, by `side` × `side` rays per pixel. `row_done` is
    /// called after each row of pixels.
    pub fn new(scene: &Scene, disc: &Disc, side: u32, row_done: impl Fn() + Sync) -> Self {
        let rays = DiscRays::new(scene, disc);
        let camera = &scene.lens.camera;
        let refined = camera.refined(side);
        let pixels = cpu::by_pixel(camera, row_done, |column, row| {
            rays.pixel(&refined, side, [column, row])
        });
        let light = pixels.iter().map(|pixel| pixel.light).collect();
        DiscReference {
            picture: Picture::new(camera.width, camera.height, light),
            on_rim: pixels.iter().map(|pixel| pixel.on_rim).collect(),
        }
    }
}

impl<'a> DiscRays<'a> {
    fn new(scene: &'a Scene, disc: &'a Disc) -> Self {
        let hole_from_sky = scene.lens.camera.sky_from_hole.transpose();
        DiscRays {
            scene,
            disc,
            normal: hole_from_sky * disc.orientation.axis(),
        }
    }

    /// The pixel (column, row) by `side` × `side` rays of the camera `refined` by `side`.
    fn pixel(&self, refined: &Camera, side: u32, [column, row]: [u32; 2]) -> ReferencePixel {
        let (mut sum, mut least, mut most) = (Vec3::ZERO, u32::MAX, 0);
        for ray in 0..side * side {
            let (right, down) = (ray % side, ray / side);
            let direction = refined.direction(column * side + right, row * side + down);
            let Traced { light, hits } = self.trace(direction);
            sum += light;
            (least, most) = (least.min(hits), most.max(hits));
        }
        ReferencePixel {
            light: (sum / (side * side) as f32).to_array(),
            on_rim: least < most,
        }
    }

    /// The ray with the unit view `direction` of the camera, in the hole frame.
    fn trace(&self, direction: DVec3) -> Traced {
        let mut traced = Traced {
            light: Vec3::ZERO,
            hits: 0,
        };
        let camera = &self.scene.lens.camera;
        let (seen, doppler) = camera.unboosted(direction);
        let theta = ViewAngle::of(seen).radians();
        let Some(orbit) = Orbit::of(&camera.observer, theta) else {
            return traced;
        };
        let across = DVec3::new(seen.x, seen.y, 0.0).normalize();
        let shift = doppler * camera.observer.frequency_shift(theta);
        let momentum = orbit.impact_parameter * across.cross(DVec3::Z).dot(self.normal);
        let mut transmission = 1.0;
        let end = orbit.follow(self.first_crossing(across), |radius| {
            if (self.disc.inner..=self.disc.outer).contains(&radius) {
                let emitted = emitted_frequency(radius, momentum);
                traced.light += transmission * self.light(radius, shift / emitted);
                traced.hits += 1;
                transmission *= (1.0 - self.disc.opacity) as f32;
            }
            transmission > 0.0
        });
        if let End::Infinity(phi) = end {
            traced.light +=
                transmission * self.sky(across * phi.sin() + DVec3::Z * phi.cos(), shift);
        }
        traced
    }

    /// The first orbital angle above 0 at which the ray that goes from the axis in the direction `across` crosses the
    /// plane of the disc, rad; ∞ if it lies in that plane.
    fn first_crossing(&self, across: DVec3) -> f64 {
        let (along, side) = (self.normal.z, self.normal.dot(across));
        if along == 0.0 && side == 0.0 {
            return f64::INFINITY;
        }
        // along cos φ + side sin φ = 0.
        let angle = (-along).atan2(side).rem_euclid(PI);
        if angle > 0.0 { angle } else { PI }
    }

    /// The light that the disc adds at `radius`, seen with the frequency shift `g`.
    fn light(&self, radius: f64, g: f64) -> Vec3 {
        let disc = self.disc;
        let flux = accretion::flux(radius);
        let kelvin = disc.peak_kelvin * flux.powf(0.25);
        let (brighter, kelvin) = match disc.shift {
            Shift::Off => (1.0, kelvin),
            Shift::Brightness => (g.powi(4), kelvin),
            Shift::Colour => (g.powi(4), kelvin * g),
        };
        let luminance = disc.brightness * flux * brighter * disc.opacity;
        self.scale() * black_body(kelvin) * luminance as f32
    }

    /// The light of the sky from `direction`, in the hole frame, seen with the frequency shift `g`.
    fn sky(&self, direction: DVec3, g: f64) -> Vec3 {
        let on_sky = self.scene.lens.camera.sky_from_hole * direction;
        let light = self.scene.sky.sample(on_sky.as_vec3());
        self.scene.rendition.seen(light, || g)
    }

    /// The factor of all light.
    fn scale(&self) -> f32 {
        match self.scene.rendition.shift {
            Shift::Off => 1.0,
            Shift::Brightness | Shift::Colour => self.scene.rendition.light_scale,
        }
    }
}

/// ν_em/ν_∞ of matter on the circular orbit at `r`, of light whose angular momentum about the axis over its energy is
/// `momentum`.
fn emitted_frequency(r: f64, momentum: f64) -> f64 {
    let angular_velocity = (2.0 * r * r * r).sqrt().recip();
    (1.0 - angular_velocity * momentum) / (1.0 - 1.5 / r).sqrt()
}

/// Linear RGB of a black body in Wien's approximation, of luminance 1; white is 6500 K. The temperature is clamped to 1000
/// to 40 000 K.
fn black_body(kelvin: f64) -> Vec3 {
    /// c₂/λ of the channels, K.
    const EXPONENTS: [f64; 3] = [
        1.438_777e7 / 610.0,
        1.438_777e7 / 550.0,
        1.438_777e7 / 465.0,
    ];
    const LUMINANCE: [f64; 3] = [0.2126, 0.7152, 0.0722];
    let colder = 1.0 / kelvin.clamp(1000.0, 40_000.0) - 1.0 / 6500.0;
    let light = EXPONENTS.map(|exponent| (-exponent * colder).exp());
    let luminance: f64 = (0..3).map(|i| LUMINANCE[i] * light[i]).sum();
    Vec3::from_array(light.map(|channel| (channel / luminance) as f32))
}

#[cfg(test)]
mod tests {
    use super::*;
    use lensbake_render::camera::View;
    use lensbake_render::disc::Orientation;
    use lensbake_render::lens::{Deflection, Lens};
    use lensbake_render::sky::Sky;
    use lensbake_tables::default_atlas;
    use std::sync::Arc;

    fn scene(view: View) -> Scene {
        let camera = Camera::new(&view).unwrap();
        let lens = Lens::new(camera, default_atlas(), Deflection::Lut).unwrap();
        Scene::new(lens, Arc::new(Sky::from_fn(8, |direction| direction.abs())))
    }

    fn small(radius: f64) -> View {
        View {
            radius,
            width: 48,
            height: 27,
            ..View::default()
        }
    }

    fn inclined(inclination_deg: f64) -> Disc {
        Disc {
            orientation: Orientation {
                inclination_deg,
                ..Disc::default().orientation
            },
            ..Disc::default()
        }
    }

    #[test]
    fn what_cannot_be_seen_leaves_the_sky() {
        let scene = scene(small(10.0));
        let sky = cpu::render(&scene, || ());
        let clear = Disc {
            opacity: 0.0,
            ..inclined(70.0)
        };
        // The observer is in the plane of a disc that is seen edge-on, and no row of pixels is.
        for disc in [clear, inclined(90.0)] {
            let found = DiscReference::new(&scene, &disc, 1, || ());
            let outside = found.picture.pixels().iter().zip(sky.pixels());
            let same = |(a, b): &(&[f32; 3], &[f32; 3])| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-3);
            let same = outside.filter(same).count();
            let hidden = if disc == clear { 0 } else { 200 };
            assert!(same >= 48 * 27 - hidden, "{same}");
        }
    }

    /// Face-on, every point at one radius has the same shift: that of the orbit and of the observer's place.
    #[test]
    fn a_disc_seen_face_on_has_the_light_of_its_radius() {
        let scene = scene(small(1000.0));
        let disc = inclined(0.0);
        let rays = DiscRays::new(&scene, &disc);
        for radius in [3.5, 4.775_464, 11.0] {
            let shift = ((1.0 - 1.5 / radius) / (1.0 - 1e-3f64)).sqrt();
            let light = rays.light(radius, shift);
            let luminance = light.dot(Vec3::new(0.2126, 0.7152, 0.0722));
            let known = accretion::flux(radius) * shift.powi(4);
            assert!((f64::from(luminance) / known - 1.0).abs() < 1e-5);
            let emitted = emitted_frequency(radius, 0.0);
            assert!((1.0 / emitted / (1.0 - 1.5 / radius).sqrt() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn matter_that_comes_nearer_is_brighter() {
        let scene = scene(small(25.0));
        let found = DiscReference::new(&scene, &inclined(80.0), 2, || ());
        let row = &found.picture.pixels()[48 * 13..48 * 14];
        let green = |columns: std::ops::Range<usize>| -> f32 {
            row[columns].iter().map(|light| light[1]).sum()
        };
        assert!(green(12..22) > 3.0 * green(26..36));
        assert!(found.on_rim.iter().any(|on_rim| *on_rim));
    }
}
